// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/orbit_view.h"
#include "core/commands/command_list.h"

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

constexpr const char* viewUsage = "view front|back|left|right|top|AZIMUTH,ELEVATION [WIDTHxHEIGHT]";
constexpr const char* strokeUsage = "stroke BRUSH X,Y[,PRESSURE]...";

Result<std::string> view(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.empty() || arguments.size() > 2) return usageError(viewUsage);
    if (!context.hasGroom) return noGroomError();
    glm::vec2 size(1280.0f, 720.0f);
    if (arguments.size() == 2) {
        const std::string_view text = arguments[1];
        const std::size_t cross = text.find('x');
        const auto width = numberFrom<int>(text.substr(0, cross), 1, 16384);
        const auto height =
            cross == std::string_view::npos ? std::nullopt : numberFrom<int>(text.substr(cross + 1), 1, 16384);
        if (!width || !height)
            return Error{"The size of a view is WIDTHxHEIGHT in pixels, not \"" + arguments[1] + "\"."};
        size = {static_cast<float>(*width), static_cast<float>(*height)};
    }
    const auto made = namedOrbitView(arguments[0], context.surfaces.get(context.groom.mesh)->bounds, size);
    if (!made) return made.error();
    context.view = *made;
    return std::string();
}

/// "X,Y" or "X,Y,PRESSURE". Numbers with a point (0.5,0.25) from 0 to 1 are shares of the view, others are pixels.
std::optional<StrokePoint> strokePoint(std::string_view text, glm::vec2 viewport) {
    std::string_view words[3];
    std::size_t count = 0;
    for (std::string_view rest = text;;) {
        if (count == 3) return std::nullopt;
        const std::size_t comma = rest.find(',');
        words[count++] = rest.substr(0, comma);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (count < 2) return std::nullopt;
    StrokePoint point;
    bool shares = true;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto number = numberFrom<float>(words[k], -100000.0f, 100000.0f);
        if (!number) return std::nullopt;
        shares = shares && *number >= 0.0f && *number <= 1.0f && words[k].find('.') != std::string_view::npos;
        point.pixel[static_cast<int>(k)] = *number;
    }
    if (shares) point.pixel *= viewport;
    if (count == 3) {
        const auto pressure = numberFrom<float>(words[2], 0.0f, 1.0f);
        if (!pressure) return std::nullopt;
        point.pressure = *pressure;
    }
    return point;
}

Result<std::string> stroke(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() < 2) return usageError(strokeUsage);
    if (!context.hasGroom) return noGroomError();
    const BrushInfo* brush = findBrush(arguments[0]);
    if (brush == nullptr) {
        std::string names;
        for (const BrushInfo& known : brushes()) names += (names.empty() ? "" : ", ") + std::string(known.id);
        return Error{"There is no brush \"" + arguments[0] + "\"; brushes are " + names + "."};
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    if (context.view.viewportPixels == glm::vec2(1.0f)) {
        context.view = orbitView(surface->bounds, 0.0f, 0.0f, {1280.0f, 720.0f});
    }
    std::vector<StrokePoint> points;
    for (const std::string& text : arguments.subspan(1)) {
        const auto point = strokePoint(text, context.view.viewportPixels);
        if (!point) return Error{"A place of a stroke is X,Y or X,Y,PRESSURE, not \"" + text + "\"."};
        points.push_back(*point);
    }
    auto begun = Stroke::begin(*brush, context.groom, surface, context.view, context.brush);
    if (!begun) return begun.error();
    for (const StrokePoint& point : points) {
        if (progress.cancelled()) return cancelledError();
        begun->moveTo(point);
    }
    context.groom = begun->finish();
    return std::string();
}

Result<std::string> brush(CommandContext& context, Arguments arguments, Progress&) {
    constexpr const char* usage =
        "brush radius|strength|value NUMBER, brush reach projected|spherical, brush map NAME, or brush "
        "mirror|front-only|keep-length|keep-outside|partings|invert on|off";
    if (arguments.size() != 2) return usageError(usage);
    const std::string& name = arguments[0];
    const std::string& value = arguments[1];
    BrushSettings& settings = context.brush;
    const auto setNumber = [&](float& target, float low, float high) -> Result<std::string> {
        const auto number = numberFrom<float>(value, low, high);
        if (!number) {
            return Error{"The brush's " + name + " must be from " + std::to_string(static_cast<int>(low)) + " to " +
                         std::to_string(static_cast<int>(high)) + ", not \"" + value + "\"."};
        }
        target = *number;
        return std::string();
    };
    if (name == "radius") return setNumber(settings.radiusPixels, 1.0f, 2000.0f);
    if (name == "strength") return setNumber(settings.strength, 0.0f, 1.0f);
    if (name == "value") return setNumber(settings.value, 0.0f, 1.0f);
    if (name == "map") {
        settings.map = value;
        return std::string();
    }
    if (name == "reach" && (value == "projected" || value == "spherical")) {
        settings.reach = value == "projected" ? Reach::Projected : Reach::Spherical;
        return std::string();
    }
    bool* const target = name == "mirror"         ? &settings.mirrorX
                         : name == "front-only"   ? &settings.frontOnly
                         : name == "keep-length"  ? &settings.keepLength
                         : name == "keep-outside" ? &settings.keepOutside
                         : name == "partings"     ? &settings.respectPartings
                         : name == "invert"       ? &settings.invert
                                                  : nullptr;
    const auto wish = switchFrom(value);
    if (target == nullptr || !wish) return usageError(usage);
    *target = *wish;
    return std::string();
}

}  // namespace

void addStrokeCommands(std::vector<Command>& list) {
    list.push_back({"view", viewUsage, "Sets the view that strokes are drawn through; front and 1280x720 without it.",
                    false, view});
    list.push_back(
        {"brush", "brush SETTING VALUE", "Sets the brush for strokes: radius, strength, map and so on.", false, brush});
    list.push_back({"stroke", strokeUsage,
                    "Draws a stroke through pixels of the view, or through shares of it (0.5,0.5 is the middle).", true,
                    stroke});
}

}  // namespace whorl
