// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/field/grow_guides.h"
#include "core/field/growing_area.h"
#include "core/surface/parting_line.h"

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

constexpr const char* usage =
    "comb-along [group NAME] [lift NUMBER] [length METRES] [reach METRES] X,Y,Z X,Y,Z... [/ X,Y,Z X,Y,Z...]";

Result<std::string> combAlong(CommandContext& context, Arguments arguments, Progress& progress) {
    if (!context.hasGroom) return noGroomError();
    GrowAlong how;
    FieldParams params = *context.groom.field;
    while (arguments.size() > 1) {
        const std::string& name = arguments[0];
        float* number = name == "lift"     ? &how.lift
                        : name == "length" ? &how.length
                        : name == "reach"  ? &params.reach
                                           : nullptr;
        if (name == "group") {
            const auto group = groupNamed(context, arguments[1]);
            if (!group) return group.error();
            how.group = *group;
        } else if (number) {
            const bool lift = name == "lift";
            const auto value = numberFrom<float>(arguments[1], 0.0f, lift ? 1.0f : 1000.0f);
            if (!value)
                return Error{"The " + name + " must be from 0 to " + (lift ? "1" : "1000 metres") + ", not \"" +
                             arguments[1] + "\"."};
            *number = *value;
        } else {
            break;
        }
        arguments = arguments.subspan(2);
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    std::vector<FieldStroke> strokes;
    std::vector<glm::vec3> points;
    const auto finish = [&]() -> Result<void> {
        if (points.empty()) return {};
        auto line = tracedParting(*surface, points);
        if (!line) return line.error();
        FieldStroke stroke;
        stroke.points = std::move(*line);
        strokes.push_back(std::move(stroke));
        points.clear();
        return {};
    };
    for (const std::string& text : arguments) {
        if (text == "/") {
            if (auto done = finish(); !done) return done.error();
            continue;
        }
        const auto point = pointFrom(text);
        if (!point) return usageError(usage);
        points.push_back(*point);
    }
    if (auto done = finish(); !done) return done.error();
    const auto solver = FieldSolver::make(surface, growingTriangles(context.groom), *context.groom.partings, progress);
    if (!solver) return solver.error();
    const auto field = solver->solve(strokes, params, progress);
    if (!field) return field.error();
    if (auto done = growGuidesAlong(context.groom, *surface, *field, how, progress); !done) return done.error();
    return std::string();
}

}  // namespace

void addFieldCommands(std::vector<Command>& list) {
    list.push_back({"comb-along", usage,
                    "Combs all guides along directions that spread over the skin from lines on it, kept apart by "
                    "partings; without a line hair hangs and falls from the partings.",
                    true, combAlong});
}

}  // namespace whorl
