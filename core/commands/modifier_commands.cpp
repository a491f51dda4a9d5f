// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"
#include "core/commands/modifier_edits.h"
#include "core/io/safe_file.h"
#include "core/param/param.h"

#include <algorithm>

namespace whorl {
namespace {

using Arguments = std::span<const std::string>;

Result<std::string> add(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() < 2 || arguments.size() > 3) return usageError("add-modifier GROUP KIND [NAME]");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    const auto place = addModifier(context.groom, *group, arguments[1], arguments.size() > 2 ? arguments[2] : "");
    if (!place) return place.error();
    return std::string();
}

Result<std::string> remove(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError("remove-modifier GROUP NAME");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    if (auto done = removeModifier(context.groom, *group, arguments[1]); !done) return done.error();
    return std::string();
}

Result<std::string> move(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 3) return usageError("move-modifier GROUP NAME PLACE");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    const auto place = numberFrom<int>(arguments[2], 1, static_cast<int>(Modifier::most));
    if (!place) return Error{"Places go from 1, the first, to 32, not \"" + arguments[2] + "\"."};
    if (auto done = moveModifier(context.groom, *group, arguments[1], *place - 1); !done) return done.error();
    return std::string();
}

Result<std::string> rename(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 3) return usageError("rename-modifier GROUP NAME NEW-NAME");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    if (auto done = renameModifier(context.groom, *group, arguments[1], arguments[2]); !done) return done.error();
    return std::string();
}

Result<std::string> list(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 1) return usageError("modifiers GROUP");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    std::string text;
    for (const Modifier& m : (*context.groom.groups)[static_cast<std::size_t>(*group)].params.modifiers)
        text += m.name + " " + std::string(modifierKinds()[m.kind()].id) + (m.on ? " on\n" : " off\n");
    return text;
}

Result<std::string> listPresets(CommandContext&, Arguments arguments, Progress&) {
    if (!arguments.empty()) return usageError("presets");
    std::string text;
    for (const Preset& preset : presets()) text += preset.id + ": " + preset.tip + "\n";
    return text;
}

Result<std::string> apply(CommandContext& context, Arguments arguments, Progress&) {
    if (arguments.size() != 2) return usageError("apply-preset GROUP NAME-OR-FILE");
    const auto group = groupNamed(context, arguments[0]);
    if (!group) return group.error();
    const auto known = std::ranges::find(presets(), arguments[1], &Preset::id);
    std::string text;
    if (known != presets().end()) {
        text = known->text;
    } else if (arguments[1].ends_with(".json")) {
        const auto bytes = readFile(arguments[1], 1u << 20);
        if (!bytes) return bytes.error();
        text.assign(bytes->begin(), bytes->end());
    } else {
        std::string names;
        for (const Preset& preset : presets()) names += (names.empty() ? "" : ", ") + preset.id;
        return Error{"There is no preset \"" + arguments[1] + "\"; name a .json file or one of " + names + "."};
    }
    if (auto done = applyPreset(context.groom, *group, text, arguments[1]); !done) return done.error();
    return std::string();
}

}  // namespace

void addModifierCommands(std::vector<Command>& commands) {
    commands.push_back({"add-modifier", "add-modifier GROUP KIND [NAME]",
                        "Adds a modifier at the end of a group's list: clump, curl, noise, bend, length, smooth, "
                        "straighten or taper.",
                        true, add});
    commands.push_back(
        {"remove-modifier", "remove-modifier GROUP NAME", "Removes a modifier of a group.", true, remove});
    commands.push_back({"move-modifier", "move-modifier GROUP NAME PLACE",
                        "Moves a modifier to another place of the list; 1 works first.", true, move});
    commands.push_back({"rename-modifier", "rename-modifier GROUP NAME NEW-NAME", "Renames a modifier.", true, rename});
    commands.push_back({"modifiers", "modifiers GROUP", "Lists the modifiers of a group in their order.", false, list});
    commands.push_back({"presets", "presets", "Lists the presets.", false, listPresets});
    commands.push_back({"apply-preset", "apply-preset GROUP NAME-OR-FILE",
                        "Replaces a group's modifiers by those of a preset and sets what else it names.", true, apply});
}

}  // namespace whorl
