// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/commands/facts.h"
#include "core/commands/strokes.h"
#include "core/field/groom_field.h"
#include "core/field/grow_guides.h"

#include <algorithm>

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

constexpr const char* addUsage =
    "add-stroke [along|attract|repel|whorl|clockwise-whorl] [weight NUMBER] [radius METRES] X,Y,Z...";
constexpr const char* setUsage =
    "set-stroke ID weight NUMBER|radius METRES|kind along|attract|repel|whorl|clockwise-whorl";
constexpr const char* moveUsage = "move-stroke ID X,Y,Z";

std::optional<StrokeKind> kindFrom(std::string_view name) {
    const auto found = std::ranges::find(strokeKindNames, name);
    if (found == strokeKindNames.end()) return std::nullopt;
    return static_cast<StrokeKind>(found - strokeKindNames.begin());
}

Result<std::uint32_t> idFrom(const std::string& text) {
    const auto id = numberFrom<std::uint32_t>(text, 0, UINT32_MAX);
    if (!id) return Error{"A stroke is named by its number, not \"" + text + "\"."};
    return *id;
}

Result<float> amountFrom(const std::string& name, const std::string& text) {
    const bool weight = name == "weight";
    const auto number = weight ? numberFrom<float>(text, FieldStroke::minWeight, FieldStroke::maxWeight)
                               : numberFrom<float>(text, 0.0f, FieldStroke::maxRadius);
    if (!number)
        return Error{"The " + name + " of a stroke must be from " + (weight ? "0.01 to 100" : "0 to 1000 metres") +
                     ", not \"" + text + "\"."};
    return *number;
}

Result<std::string> add(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.empty()) return usageError(addUsage);
    if (!context.hasGroom) return noGroomError();
    StrokeKind kind = StrokeKind::Along;
    if (const auto named = kindFrom(arguments[0])) {
        kind = *named;
        arguments = arguments.subspan(1);
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    float weight = 1.0f;
    // A tenth of the mesh, where a radius is wanted and none is given.
    const glm::vec3 size = surface->bounds.size();
    float radius = kind == StrokeKind::Along ? 0.0f : 0.1f * std::max({size.x, size.y, size.z});
    while (arguments.size() > 1 && (arguments[0] == "weight" || arguments[0] == "radius")) {
        const auto amount = amountFrom(arguments[0], arguments[1]);
        if (!amount) return amount.error();
        (arguments[0] == "weight" ? weight : radius) = *amount;
        arguments = arguments.subspan(2);
    }
    std::vector<glm::vec3> points;
    for (const std::string& text : arguments) {
        const auto point = pointFrom(text);
        if (!point) return Error{"A point of a stroke is X,Y,Z in metres, not \"" + text + "\"."};
        points.push_back(*point);
    }
    if (points.empty()) return usageError(addUsage);
    const auto id = addStroke(context.groom, *surface, kind, points, weight, radius);
    if (!id) return id.error();
    return "stroke " + std::to_string(*id);
}

Result<std::string> set(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 3) return usageError(setUsage);
    if (!context.hasGroom) return noGroomError();
    const auto id = idFrom(arguments[0]);
    if (!id) return id.error();
    FieldStroke stroke;
    if (const FieldStroke* own = findStroke(context.groom, *id)) stroke = *own;
    stroke.id = *id;
    if (arguments[1] == "kind") {
        const auto kind = kindFrom(arguments[2]);
        if (!kind) return usageError(setUsage);
        stroke.kind = *kind;
    } else if (arguments[1] == "weight" || arguments[1] == "radius") {
        const auto amount = amountFrom(arguments[1], arguments[2]);
        if (!amount) return amount.error();
        (arguments[1] == "weight" ? stroke.weight : stroke.radius) = *amount;
    } else {
        return usageError(setUsage);
    }
    if (auto done = changeStroke(context.groom, stroke); !done) return done.error();
    return std::string();
}

Result<std::string> move(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError(moveUsage);
    if (!context.hasGroom) return noGroomError();
    const auto id = idFrom(arguments[0]);
    if (!id) return id.error();
    const auto offset = pointFrom(arguments[1]);
    if (!offset) return usageError(moveUsage);
    const auto surface = context.surfaces.get(context.groom.mesh);
    if (auto done = moveStroke(context.groom, *surface, *id, *offset); !done) return done.error();
    return std::string();
}

Result<std::string> remove(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 1) return usageError("remove-stroke ID");
    if (!context.hasGroom) return noGroomError();
    const auto id = idFrom(arguments[0]);
    if (!id) return id.error();
    if (auto done = removeStroke(context.groom, *id); !done) return done.error();
    return std::string();
}

Result<std::string> clear(CommandContext& context, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("clear-strokes");
    if (!context.hasGroom) return noGroomError();
    context.groom.strokes = {};
    return std::string();
}

Result<std::string> fromGuides(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() > 1) return usageError("strokes-from-guides [GROUP]");
    if (!context.hasGroom) return noGroomError();
    int group = -1;
    if (!arguments.empty()) {
        const auto named = groupNamed(context, arguments[0]);
        if (!named) return named.error();
        group = *named;
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    if (auto done = makeStrokesOfGuides(context.groom, surface, group, progress); !done) return done.error();
    return std::to_string(context.groom.strokes->size()) + " strokes";
}

Result<std::string> grow(CommandContext& context, Arguments arguments, Progress& progress) {
    if (arguments.size() > 1) return usageError("grow-along [GROUP]");
    if (!context.hasGroom) return noGroomError();
    GrowAlong how = growAlong(*context.groom.field);
    if (!arguments.empty()) {
        const auto named = groupNamed(context, arguments[0]);
        if (!named) return named.error();
        how.group = *named;
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    const auto field = groomField(context.groom, surface, progress);
    if (!field) return field.error();
    if (auto done = growGuidesAlong(context.groom, *surface, *field, how, progress); !done) return done.error();
    return std::string();
}

Result<std::string> singularities(CommandContext& context, Arguments arguments, Progress& progress) {
    if (!arguments.empty()) return usageError("singularities");
    if (!context.hasGroom) return noGroomError();
    const auto surface = context.surfaces.get(context.groom.mesh);
    const auto field = groomField(context.groom, surface, progress);
    if (!field) return field.error();
    return singularitiesText(*field, surface->mesh());
}

}  // namespace

void addFieldCommands(std::vector<Command>& list) {
    list.push_back({"add-stroke", addUsage,
                    "Draws a stroke for the direction of hair over the skin through the places nearest to the points; "
                    "all kinds but along may have one point.",
                    true, add});
    list.push_back({"set-stroke", setUsage, "Changes a stroke (info lists them).", true, set});
    list.push_back({"move-stroke", moveUsage, "Carries a stroke by so many metres, down onto the skin.", true, move});
    list.push_back({"remove-stroke", "remove-stroke ID", "Removes a stroke (info lists them).", true, remove});
    list.push_back({"clear-strokes", "clear-strokes", "Removes all strokes.", true, clear});
    list.push_back(
        {"strokes-from-guides", "strokes-from-guides [GROUP]",
         "Replaces the strokes by those that follow the guides as they lie; strokes lead from then on (field/follow "
         "becomes off).",
         true, fromGuides});
    list.push_back({"grow-along", "grow-along [GROUP]",
                    "Gives all guides (or those of a group) new shapes along the field; set field/lift, field/length "
                    "and field/bend first.",
                    true, grow});
    list.push_back(
        {"singularities", "singularities",
         "Lists the places around which directions turn: +1 is a whorl or a star, -1 a saddle; and their sum, which on "
         "a "
         "closed mesh that is grown all over is 2 for a ball and 0 for a ring; at borders and partings it may be any.",
         false, singularities});
}

}  // namespace whorl
