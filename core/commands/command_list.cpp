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
    addBakeCommands(list);
    addFieldCommands(list);
    addStrokeCommands(list);
    return list;
}

std::optional<glm::vec3> pointFrom(std::string_view text) {
    glm::vec3 point(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (axis == 2)) return std::nullopt;
        const auto number = numberFrom<float>(text.substr(0, comma), -1e6f, 1e6f);
        if (!number) return std::nullopt;
        point[axis] = *number;
        text.remove_prefix(std::min(text.size(), comma == std::string_view::npos ? text.size() : comma + 1));
    }
    return point;
}

std::optional<bool> switchFrom(std::string_view text) {
    if (text == "on") return true;
    if (text == "off") return false;
    return std::nullopt;
}

}  // namespace whorl
