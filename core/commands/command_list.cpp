// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command_list.h"

namespace whorl {

std::vector<Command> coreCommands() {
    std::vector<Command> list;
    addFileCommands(list);
    addEditCommands(list);
    addGroupCommands(list);
    addModifierCommands(list);
    addPartingCommands(list);
    addStrokeCommands(list);
    return list;
}

std::optional<bool> switchFrom(std::string_view text) {
    if (text == "on") return true;
    if (text == "off") return false;
    return std::nullopt;
}

}  // namespace whorl
