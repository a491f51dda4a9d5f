// SPDX-License-Identifier: Apache-2.0
// JSON as text of files: depth checked before parsing, any bytes kept in strings. Include in sources only.
#pragma once

#include "core/base/result.h"
#include "core/model/groom.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace whorl {

/// Deeper ones are refused before they are parsed: the parser would need stack for each level.
inline constexpr int maxJsonDepth = 64;

/// One JSON value. `name` is the file for the error's sentence.
Result<nlohmann::json> parseJson(std::string_view text, const std::string& name);

/// Text of `value`, the same for equal values. Strings that are not UTF-8 (names from old files) are escaped with
/// private characters and come back from parseJson byte for byte. `indent` -1: one line.
std::string jsonText(const nlohmann::json& value, int indent = -1);

/// One sentence for each key of `object` that is not in `known`.
void reportUnknownKeys(const nlohmann::json& object, std::initializer_list<std::string_view> known,
                       const std::string& where, Problems& problems);

}  // namespace whorl
