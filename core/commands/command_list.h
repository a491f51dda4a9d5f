// SPDX-License-Identifier: Apache-2.0
// Where the commands of coreCommands come from, and what their sources share.
#pragma once

#include "core/commands/command.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace whorl {

void addFileCommands(std::vector<Command>& list);
void addBakeCommands(std::vector<Command>& list);
void addEditCommands(std::vector<Command>& list);
void addFieldCommands(std::vector<Command>& list);
void addGroupCommands(std::vector<Command>& list);
void addModifierCommands(std::vector<Command>& list);
void addPartingCommands(std::vector<Command>& list);
void addStrokeCommands(std::vector<Command>& list);

/// The whole of `text` as a number; nothing when it is none, not finite or out of range. Does not look at the locale.
template <class Number>
std::optional<Number> numberFrom(std::string_view text, Number low, Number high) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || !(number >= low && number <= high))
        return std::nullopt;
    return number;
}

/// "X,Y,Z", each from -1e6 to 1e6.
std::optional<glm::vec3> pointFrom(std::string_view text);

/// "on" or "off".
std::optional<bool> switchFrom(std::string_view text);

/// Number of the group of that name; the error names those there are, or that there is no groom.
Result<int> groupNamed(const CommandContext& context, const std::string& name);

inline Error usageError(const std::string& usage) {
    return {"Write: " + usage + "."};
}
inline Error noGroomError() {
    return {"There is no groom yet; begin with open or new."};
}

}  // namespace whorl
