// SPDX-License-Identifier: Apache-2.0
#include "core/commands/partings.h"

#include "core/commands/command_list.h"
#include "core/surface/parting_line.h"

#include <algorithm>

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

constexpr const char* addUsage = "add-parting [NAME] X,Y,Z X,Y,Z...";

Result<std::string> add(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.empty()) return usageError(addUsage);
    if (!context.hasGroom) return noGroomError();
    std::string name;
    if (arguments[0].find(',') == std::string::npos) {
        name = arguments[0];
        arguments = arguments.subspan(1);
    }
    std::vector<glm::vec3> points;
    for (const std::string& text : arguments) {
        const auto point = pointFrom(text);
        if (!point) return Error{"A point of a parting is X,Y,Z in metres, not \"" + text + "\"."};
        points.push_back(*point);
    }
    const auto surface = context.surfaces.get(context.groom.mesh);
    const auto id = addParting(context.groom, *surface, points, name);
    if (!id) return id.error();
    return "parting " + std::to_string(*id);
}

Result<std::string> remove(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 1) return usageError("remove-parting ID");
    if (!context.hasGroom) return noGroomError();
    const auto id = numberFrom<std::uint32_t>(arguments[0], 0, UINT32_MAX);
    if (!id) return Error{"A parting is named by its number, not \"" + arguments[0] + "\"."};
    if (auto done = removeParting(context.groom, *id); !done) return done.error();
    return std::string();
}

Result<std::string> clear(CommandContext& context, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("clear-partings");
    if (!context.hasGroom) return noGroomError();
    context.groom.partings = {};
    return std::string();
}

}  // namespace

Result<std::uint32_t> addParting(Groom& groom, const Surface& surface, std::span<const glm::vec3> points,
                                 std::string name) {
    if (groom.partings->size() >= Parting::maxPartings)
        return Error{"A groom has at most " + std::to_string(Parting::maxPartings) + " partings; remove some first."};
    auto line = tracedParting(surface, points);
    if (!line) return line.error();
    const std::uint32_t id = nextPartingId(*groom.partings);
    groom.partings.edit().push_back({id, std::move(name), std::move(*line)});
    return id;
}

Result<void> removeParting(Groom& groom, std::uint32_t id) {
    if (!findParting(groom, id)) return Error{"There is no parting " + std::to_string(id) + "."};
    std::erase_if(groom.partings.edit(), [&](const Parting& parting) { return parting.id == id; });
    return {};
}

const Parting* findParting(const Groom& groom, std::uint32_t id) {
    const auto found = std::ranges::find(*groom.partings, id, &Parting::id);
    return found != groom.partings->end() ? &*found : nullptr;
}

void addPartingCommands(std::vector<Command>& list) {
    list.push_back({"add-parting", addUsage,
                    "Draws a parting over the skin through the places nearest to the points (space of the mesh).", true,
                    add});
    list.push_back({"remove-parting", "remove-parting ID", "Removes a parting (info lists them).", true, remove});
    list.push_back({"clear-partings", "clear-partings", "Removes all partings.", true, clear});
}

}  // namespace whorl
