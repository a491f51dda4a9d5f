// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/commands/group_edits.h"

namespace whorl {

Result<int> groupNamed(const CommandContext& context, const std::string& name) {
    if (!context.hasGroom) return noGroomError();
    const int group = context.groom.groupIndex(name);
    if (group >= 0) return group;
    std::string names;
    for (const Group& known : *context.groom.groups) names += (names.empty() ? "" : ", ") + known.name;
    return Error{"There is no group \"" + name + "\"; groups are " + names + "."};
}

namespace {

using Arguments = std::span<const std::string>;

Result<std::string> add(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.empty() || arguments.size() > 2) return usageError("add-group NAME [LIKE]");
    if (!context.hasGroom) return noGroomError();
    int like = -1;
    if (arguments.size() > 1) {
        const auto group = groupNamed(context, arguments[1]);
        if (!group) return group.error();
        like = *group;
    }
    const auto made = addGroup(context.groom, arguments[0], like);
    if (!made) return made.error();
    return std::string();
}

Result<std::string> rename(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError("rename-group NAME NEW-NAME");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    if (auto done = renameGroup(context.groom, *group, arguments[1]); !done) return done.error();
    return std::string();
}

Result<std::string> remove(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 1) return usageError("remove-group NAME");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    if (auto done = removeGroup(context.groom, *group); !done) return done.error();
    return std::string();
}

Result<std::string> regroup(CommandContext& context, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("regroup-guides");
    if (!context.hasGroom) return noGroomError();
    return std::to_string(regroupGuides(context.groom)) + " guides changed group";
}

}  // namespace

void addGroupCommands(std::vector<Command>& list) {
    list.push_back({"add-group", "add-group NAME [LIKE]",
                    "Adds a group with default parameters, or with those of another group.", true, add});
    list.push_back({"rename-group", "rename-group NAME NEW-NAME", "Renames a group.", true, rename});
    list.push_back(
        {"remove-group", "remove-group NAME", "Removes a group; its guides go to the one before it.", true, remove});
    list.push_back({"regroup-guides", "regroup-guides",
                    "Gives every guide the group that the group map has at its root.", true, regroup});
}

}  // namespace whorl
