// SPDX-License-Identifier: Apache-2.0
#include "core/field/groom_field.h"
#include "core/hair/generate.h"
#include "core/hair/lod.h"
#include "core/io/image.h"
#include "core/lic/live_texture.h"
#include "editor/cli/cli.h"
#include "render/offscreen.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    std::string output;
    std::string size = "1280x720";
    std::string view = "hair";
    std::string shading = "kajiya-kay";
    std::string shadows = "voxel";
    std::string camera = "front";
    std::string map;
    int texture = 2048;
    float lod = 1.0f;
    bool field = false;
    bool lodForSize = false;
    std::optional<std::uint32_t> count;
};

// What the mesh is seen at; hair that stands far out only makes it smaller.
float lodAtSize(const Groom& groom, const Surface& surface, const std::string& name, glm::vec2 viewport) {
    const auto camera = Camera::named(name, surface.bounds, viewport);
    if (!camera) return 1.0f;
    return lodForScreen({.radius = 0.5f * glm::length(surface.bounds.size()),
                         .distance = camera->distance,
                         .fieldOfView = camera->fieldOfView,
                         .imageHeight = viewport.y},
                        static_cast<std::uint32_t>(std::max(groom.counts->hairs, 0)));
}

Outcome render(const Options& options) {
    const std::size_t cross = options.size.find('x');
    const auto width = wholeNumber(options.size.substr(0, cross), 1, 8192);
    const auto height =
        cross == std::string::npos ? std::nullopt : wholeNumber(options.size.substr(cross + 1), 1, 8192);
    if (!width || !height)
        return badUsage("--size: write WIDTHxHEIGHT, each from 1 to 8192, not \"" + options.size + "\".");
    const glm::vec2 viewport(static_cast<float>(*width), static_cast<float>(*height));
    // A wrong camera is refused before anything slow happens.
    if (auto named = Camera::named(options.camera, {{-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}}, viewport); !named) {
        return badUsage("--camera: " + named.error().message);
    }

    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    if (!options.map.empty() && groom->maps.find(options.map) == nullptr) {
        return badInput({options.file + ": there is no map \"" + options.map + "\" to show."});
    }
    const auto surface = std::make_shared<const Surface>(groom->mesh);
    ViewSettings settings;
    settings.shadows = options.shadows == "none" ? ShadowMode::None : ShadowMode::Voxel;
    settings.showHair = options.view == "hair" || options.view == "both";
    settings.showLic = options.view == "lic" || options.view == "both";
    settings.showGuides = options.view == "guides";
    const bool showField = options.field || options.view == "field";
    settings.showStrokes = settings.showGuides || showField;
    settings.overlayMap = options.map;

    std::shared_ptr<const LicImage> texture;
    if (settings.showLic) {
        auto made = LiveTexture().update(*groom, surface, options.texture, progress());
        if (!made) return badInput(made.error());
        texture = LicImage::make(std::move(*made));
    }
    std::vector<FieldSingularity> singularities;
    if (showField) {
        const auto field = groomField(*groom, surface, progress());
        if (!field) return badInput(field.error());
        singularities = field->singularities();
    }
    Bounds bounds = surface->bounds;
    std::shared_ptr<Strands> strands;
    if (settings.showHair) {
        Generator generator;
        generator.setSurface(surface);
        GenerateOptions generateOptions;
        if (options.count) groom->setHairs(*options.count);
        generateOptions.lod = options.lodForSize ? lodAtSize(*groom, *surface, options.camera, viewport) : options.lod;
        auto made = generator.generate(*groom, generateOptions, progress());
        if (!made) return badInput(made.error());
        strands = std::make_shared<Strands>(std::move(*made));
        if (strands->count() > 0) bounds.add(strands->bounds());
    } else if (settings.showGuides) {
        for (std::size_t i = 0; i < groom->guides.count(); ++i) {
            for (const glm::vec3& p : groom->guides.points(i)) bounds.add(p);
        }
    }
    const auto camera = Camera::named(options.camera, bounds, viewport);
    if (!camera) return badUsage("--camera: " + camera.error().message);
    auto renderer = OffscreenRenderer::create();
    if (!renderer) return badInput(renderer.error());
    renderer->renderer().setGroom(*groom, surface);
    renderer->renderer().setStrands(strands);
    renderer->renderer().setLicImage(texture);
    renderer->renderer().setSingularities(singularities);
    const Picture picture = renderer->draw(*camera, settings, {}, static_cast<int>(*width), static_cast<int>(*height));
    if (picture.pixels.empty())
        return badInput({"The picture could not be drawn; is it too large for the graphics card?"});
    if (auto written = writePixels(picture.pixels, picture.width, picture.height, 4, options.output); !written) {
        return badInput(written.error());
    }
    return done();
}

}  // namespace

void addRender(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program =
        addProgram(app, "render", "Draws a picture; needs no display", [options] { return render(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program->add_option("-o,--output", options->output, "Image to write: png, jpg, tif, exr or tga")->required();
    program->add_option("--size", options->size, "WIDTHxHEIGHT in pixels; 1280x720 without it");
    program
        ->add_option(
            "--view", options->view,
            "hair; lic: texture painted on the model; both: hair over its texture; guides: with the strokes; or field: "
            "strokes, and stars where directions turn (red a whorl or a star, blue a saddle)")
        ->check(CLI::IsMember({"hair", "lic", "both", "guides", "field"}));
    program->add_flag("--field", options->field, "Strokes and stars over any view");
    program->add_option("--shading", options->shading, "kajiya-kay")->check(CLI::IsMember({"kajiya-kay"}));
    program->add_option("--shadows", options->shadows, "none or voxel")->check(CLI::IsMember({"none", "voxel"}));
    program->add_option("--camera", options->camera,
                        "front, back, left, right, side, top, three-quarter or AZIMUTH,ELEVATION in degrees");
    program->add_option("--texture", options->texture, "Texels a side of hair texture; 2048 without it")
        ->check(CLI::Range(1, LicPainter::maxSize));
    program->add_option("--map", options->map, "Map to show in colour over the mesh");
    CLI::Option* share = addLod(*program, options->lod);
    program
        ->add_flag("--lod-for-size", options->lodForSize,
                   "The level of detail that the size of the picture asks for: two hairs a pixel")
        ->excludes(share);
    program->add_option("--count", options->count, "Hairs instead of the groom's number")
        ->check(CLI::Range(0u, 10000000u));
}

}  // namespace whorl::cli
