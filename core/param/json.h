// SPDX-License-Identifier: Apache-2.0
// Parameters to and from JSON. Include in sources only: the JSON library is heavy.
#pragma once

#include "core/model/groom.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>

namespace whorl {

/// A plain value; nothing for what is none (objects, lists but of three numbers).
std::optional<ParamValue> paramValueFromJson(const nlohmann::json& json);

/// One object of a block. Numbers with a map become {"value": 0.5, "map": "length"}; choices are texts.
nlohmann::json blockToJson(std::span<const ParamRef> params);
/// Sets what the object names; what it does not name stays. Unknown keys and bad values are told in `problems`, each
/// with `where` in front, and change nothing.
void blockFromJson(std::span<const ParamRef> params, const nlohmann::json& json, const std::string& where,
                   Problems& problems);

nlohmann::json hairParamsToJson(const HairParams& params);
void hairParamsFromJson(HairParams& params, const nlohmann::json& json, const std::string& where, Problems& problems);
/// A list of modifiers: [{"name", "kind", "params"}]. Reading replaces `list`; modifiers of unknown kinds and those
/// beyond Modifier::most are left out, names that are none or taken are changed, and `problems` tells.
nlohmann::json modifiersToJson(const std::vector<Modifier>& list);
void modifiersFromJson(std::vector<Modifier>& list, const nlohmann::json& json, const std::string& where,
                       Problems& problems);
nlohmann::json countsToJson(const CountParams& counts);
void countsFromJson(CountParams& counts, const nlohmann::json& json, const std::string& where, Problems& problems);

}  // namespace whorl
