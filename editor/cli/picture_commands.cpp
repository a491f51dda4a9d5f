// SPDX-License-Identifier: Apache-2.0
#include "editor/cli/picture_commands.h"

#include "core/commands/command_list.h"
#include "core/field/groom_field.h"
#include "core/field/grow_guides.h"
#include "core/hair/generate.h"
#include "core/io/image.h"
#include "core/lic/live_texture.h"
#include "core/param/path.h"
#include "render/offscreen.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>

namespace whorl::cli {
namespace {

using Arguments = std::span<const std::string>;

/// Rows of pixels at the bottom of a picture that hold its text.
constexpr int textHeight = 26;
/// Where less than this share of the pixels differs clearly, two pictures show the same.
constexpr double leastDifference = 0.002;
/// Texels a side of hair texture.
constexpr int textureSize = 2048;
constexpr const char* showUsage = "show hair|lic|both|guides|field [field]";

class Studio {
public:
    Result<std::string> camera(CommandContext&, Arguments arguments, Progress&) {
        if (arguments.empty() || arguments.size() > 3) return usageError("camera CAMERA [NEARER] [WIDTHxHEIGHT]");
        if (auto named = Camera::named(arguments[0], {{-1, -1, -1}, {1, 1, 1}}, {1, 1}); !named) return named.error();
        m_camera = arguments[0];
        if (arguments.size() > 1) {
            const auto nearer = numberFrom<float>(arguments[1], 0.01f, 100.0f);
            if (!nearer) return Error{"A camera comes 0.01 to 100 times nearer, not \"" + arguments[1] + "\"."};
            m_nearer = *nearer;
        }
        if (arguments.size() > 2) {
            const std::size_t cross = arguments[2].find('x');
            const auto width = numberFrom<int>(arguments[2].substr(0, cross), 1, 8192);
            const auto height =
                cross == std::string::npos ? std::nullopt : numberFrom<int>(arguments[2].substr(cross + 1), 1, 8192);
            if (!width || !height)
                return Error{"A size is WIDTHxHEIGHT, each from 1 to 8192, not \"" + arguments[2] + "\"."};
            m_width = *width;
            m_height = *height;
        }
        return std::string();
    }

    Result<std::string> show(CommandContext&, Arguments arguments, Progress&) {
        const bool two = arguments.size() == 2 && arguments[1] == "field";
        const std::string what = arguments.size() == 1 || two ? arguments[0] : std::string();
        if (what != "hair" && what != "lic" && what != "both" && what != "guides" && what != "field")
            return usageError(showUsage);
        m_settings.showHair = what == "hair" || what == "both";
        m_settings.showLic = what == "lic" || what == "both";
        m_settings.showGuides = what == "guides";
        m_showField = two || what == "field";
        m_settings.showStrokes = m_settings.showGuides || m_showField;
        return std::string();
    }

    Result<std::string> lookAt(CommandContext&, Arguments arguments, Progress&) {
        if (arguments.size() != 1) return usageError("look-at X,Y,Z|model");
        m_target.reset();
        if (arguments[0] == "model") return std::string();
        m_target = pointFrom(arguments[0]);
        if (!m_target) return usageError("look-at X,Y,Z|model");
        return std::string();
    }

    Result<std::string> light(CommandContext&, Arguments arguments, Progress&) {
        const std::size_t comma = arguments.size() == 1 ? arguments[0].find(',') : std::string::npos;
        if (comma == std::string::npos) return usageError("light AZIMUTH,ELEVATION");
        const auto azimuth = numberFrom<float>(arguments[0].substr(0, comma), -360.0f, 360.0f);
        const auto elevation = numberFrom<float>(arguments[0].substr(comma + 1), -90.0f, 90.0f);
        if (!azimuth || !elevation)
            return Error{"A light is at AZIMUTH,ELEVATION in degrees, not \"" + arguments[0] + "\"."};
        const float a = glm::radians(*azimuth), e = glm::radians(*elevation);
        m_settings.lightDirection = {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
        return std::string();
    }

    Result<std::string> time(CommandContext&, Arguments arguments, Progress&) {
        if (arguments.size() != 1) return usageError("time SECONDS");
        const auto seconds = numberFrom<float>(arguments[0], -1e6f, 1e6f);
        if (!seconds) return Error{"A time is a number of seconds, not \"" + arguments[0] + "\"."};
        m_time = *seconds;
        return std::string();
    }

    Result<std::string> render(CommandContext& context, Arguments arguments, Progress& progress) {
        if (arguments.size() != 1) return usageError("render IMAGE");
        if (!context.hasGroom) return noGroomError();
        auto picture = draw(context, context.groom, {}, progress);
        if (!picture) return picture.error();
        return write(*picture, arguments[0]);
    }

    Result<std::string> row(CommandContext&, Arguments arguments, Progress&) {
        if (!arguments.empty()) return usageError("row");
        m_rows.emplace_back();
        return std::string();
    }

    Result<std::string> frame(CommandContext& context, Arguments arguments, Progress& progress) {
        if (!context.hasGroom) return noGroomError();
        std::string label;
        for (const std::string& word : arguments) label += (label.empty() ? "" : " ") + word;
        auto picture = draw(context, context.groom, label, progress);
        if (!picture) return picture.error();
        if (m_rows.empty()) m_rows.emplace_back();
        m_rows.back().push_back(std::move(*picture));
        return std::string();
    }

    Result<std::string> compare(CommandContext& context, Arguments arguments, Progress& progress) {
        if (arguments.size() < 3) return usageError("compare PATH VALUE VALUE...");
        if (!context.hasGroom) return noGroomError();
        m_rows.emplace_back();
        for (const std::string& value : arguments.subspan(1)) {
            Groom groom = context.groom;
            const bool noMap = arguments[0].ends_with("/map") && value == "none";
            if (auto done = setGroomValue(groom, arguments[0], noMap ? std::string() : value); !done)
                return done.error();
            // What guides are grown by shows when they are grown.
            if (m_settings.showHair && arguments[0].starts_with("field/")) {
                const auto surface = context.surfaces.get(groom.mesh);
                const auto field = groomField(groom, surface, progress);
                if (!field) return field.error();
                const auto grown = growGuidesAlong(groom, *surface, *field, growAlong(*groom.field), progress);
                if (!grown) return grown.error();
            }
            auto picture =
                draw(context, groom, arguments[0].substr(arguments[0].find('/') + 1) + " " + value, progress);
            if (!picture) return picture.error();
            if (!m_rows.back().empty() && !differ(m_rows.back().back(), *picture)) {
                return Error{arguments[0] + ": " + value + " shows the same as the value before."};
            }
            m_rows.back().push_back(std::move(*picture));
        }
        return std::string();
    }

    Result<std::string> sheet(CommandContext&, Arguments arguments, Progress&) {
        if (arguments.size() != 1) return usageError("sheet IMAGE");
        Picture all;
        for (const auto& row : m_rows) {
            int width = 0, height = 0;
            for (const Picture& picture : row) {
                width += picture.width;
                height = std::max(height, picture.height);
            }
            all.width = std::max(all.width, width);
            all.height += height;
        }
        if (all.width == 0) return Error{"There are no pictures for a sheet yet; add some with frame or compare."};
        all.pixels.assign(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height) * 4, 24);
        for (std::size_t i = 3; i < all.pixels.size(); i += 4) all.pixels[i] = 255;
        int top = 0;
        for (const auto& row : m_rows) {
            int left = 0, height = 0;
            for (const Picture& picture : row) {
                const auto bytes = static_cast<std::size_t>(picture.width) * 4;
                for (int y = 0; y < picture.height; ++y) {
                    const auto to = (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(all.width) +
                                     static_cast<std::size_t>(left)) *
                                    4;
                    std::copy_n(picture.pixels.begin() + static_cast<std::ptrdiff_t>(bytes) * y, bytes,
                                all.pixels.begin() + static_cast<std::ptrdiff_t>(to));
                }
                left += picture.width;
                height = std::max(height, picture.height);
            }
            top += height;
        }
        m_rows.clear();
        return write(all, arguments[0]);
    }

private:
    static Result<std::string> write(const Picture& picture, const std::string& file) {
        if (auto done = writePixels(picture.pixels, picture.width, picture.height, 4, file); !done) return done.error();
        return std::string();
    }

    static bool differ(const Picture& a, const Picture& b) {
        if (a.width != b.width || a.height != b.height) return true;
        const auto end =
            static_cast<std::size_t>(a.width) * static_cast<std::size_t>(std::max(a.height - textHeight, 1));
        std::size_t differing = 0;
        for (std::size_t i = 0; i < end; ++i) {
            int change = 0;
            for (std::size_t c = 0; c < 3; ++c) change += std::abs(a.pixels[i * 4 + c] - b.pixels[i * 4 + c]);
            differing += change > 24;
        }
        return static_cast<double>(differing) >= leastDifference * static_cast<double>(end);
    }

    Result<Picture> draw(CommandContext& context, const Groom& groom, const std::string& label, Progress& progress) {
        if (!m_renderer) {
            auto made = OffscreenRenderer::create();
            if (!made) return made.error();
            m_renderer.emplace(std::move(*made));
        }
        const std::shared_ptr<const Surface> surface = context.surfaces.get(groom.mesh);
        m_generator.setSurface(surface);
        std::shared_ptr<const Strands> strands;
        if (m_settings.showHair) {
            GenerateOptions options;
            options.time = m_time;
            auto made = m_generator.generateShared(groom, options, progress);
            if (!made) return made.error();
            strands = std::move(*made);
        }
        if (m_settings.showLic) {
            auto made = m_texture.update(groom, surface, textureSize, progress);
            if (!made) return made.error();
            m_image = LicImage::make(std::move(*made), m_image);
        }
        std::vector<FieldSingularity> singularities;
        if (m_showField) {
            const auto field = groomField(groom, surface, progress);
            if (!field) return field.error();
            singularities = field->singularities();
        }
        const glm::vec2 size(static_cast<float>(m_width), static_cast<float>(m_height));
        auto camera = Camera::named(m_camera, surface->bounds, size);
        if (!camera) return camera.error();
        if (m_target) camera->target = *m_target;
        camera->zoom(m_nearer);
        m_renderer->renderer().setGroom(groom, surface);
        m_renderer->renderer().setStrands(strands);
        m_renderer->renderer().setLicImage(m_settings.showLic ? m_image : nullptr);
        m_renderer->renderer().setSingularities(singularities);
        OverlayState overlay;
        overlay.text = label;
        Picture picture = m_renderer->draw(*camera, m_settings, overlay, m_width, m_height);
        if (picture.pixels.empty())
            return Error{"The picture could not be drawn; is it too large for the graphics card?"};
        return picture;
    }

    std::string m_camera = "three-quarter";
    std::optional<glm::vec3> m_target;
    float m_nearer = 1.0f;
    int m_width = 480;
    int m_height = 360;
    float m_time = 0.0f;
    std::vector<std::vector<Picture>> m_rows;
    ViewSettings m_settings;
    bool m_showField = false;
    Generator m_generator;
    LiveTexture m_texture;
    std::shared_ptr<const LicImage> m_image;
    std::optional<OffscreenRenderer> m_renderer;
};

}  // namespace

std::vector<Command> pictureCommands() {
    const auto studio = std::make_shared<Studio>();
    std::vector<Command> list;
    const auto add = [&](const char* name, const char* usage, const char* help,
                         Result<std::string> (Studio::*run)(CommandContext&, Arguments, Progress&)) {
        list.push_back(
            {name, usage, help, false, [studio, run](CommandContext& context, Arguments arguments, Progress& progress) {
                 return ((*studio).*run)(context, arguments, progress);
             }});
    };
    add("camera", "camera CAMERA [NEARER] [WIDTHxHEIGHT]",
        "For pictures: front, back, left, right, side, top, three-quarter or AZIMUTH,ELEVATION in degrees; a factor.",
        &Studio::camera);
    add("look-at", "look-at X,Y,Z|model", "The middle of pictures: a place in metres, or that of the model.",
        &Studio::lookAt);
    add("show", showUsage,
        "What pictures show: hair, the texture of it on the model (lic), hair over its texture, guides with the "
        "strokes, "
        "or strokes with stars where directions turn (field), which also come over the others.",
        &Studio::show);
    add("light", "light AZIMUTH,ELEVATION",
        "Where the light of pictures comes from, in degrees; it turns with the camera.", &Studio::light);
    add("time", "time SECONDS", "The time of pictures, for animated frizz.", &Studio::time);
    add("render", "render IMAGE", "Draws the model with its hair into a picture.", &Studio::render);
    add("row", "row", "Begins a row of a sheet.", &Studio::row);
    add("frame", "frame [LABEL]", "Adds a picture to the row.", &Studio::frame);
    add("compare", "compare PATH VALUE VALUE...",
        "Adds a row with a picture for each value of a parameter (maps: none is no map), which then is as before. "
        "Fails "
        "when neighbours show the same.",
        &Studio::compare);
    add("sheet", "sheet IMAGE", "Writes all rows as one picture.", &Studio::sheet);
    return list;
}

}  // namespace whorl::cli
