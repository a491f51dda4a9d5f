// SPDX-License-Identifier: Apache-2.0
#include "core/param/json.h"

#include <nlohmann/json.hpp>

namespace whorl {
namespace {

using nlohmann::json;

json plainJson(const ParamValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag;
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* v = std::get_if<glm::vec3>(&value)) return json::array({v->x, v->y, v->z});
    return std::get<std::string>(value);
}

bool isMapName(const ParamRef& param) {
    return std::holds_alternative<MapName*>(param.target);
}

void setFromJson(const ParamRef& param, const json& stored, const std::string& where, Problems& problems) {
    const json* plain = &stored;
    if (stored.is_object()) {
        std::string* map = paramMap(param);
        for (const auto& [key, entry] : stored.items()) {
            if (key != "value" && key != "map") problems.push_back(where + ": unknown key \"" + key + "\"; left out.");
        }
        if (map && !isMapName(param) && stored.contains("map") && stored["map"].is_string()) {
            *map = stored["map"].get<std::string>();
        } else if (stored.contains("map")) {
            problems.push_back(where + ": \"map\" does not belong here; left out.");
        }
        if (!stored.contains("value")) return;
        plain = &stored["value"];
    }
    const auto value = paramValueFromJson(*plain);
    if (!value) {
        problems.push_back(where + ": not a value; the default is used.");
        return;
    }
    if (const auto set = setParamValue(param, *value); !set) {
        problems.push_back(where + ": " + set.error().message + " The default is used.");
    }
}

}  // namespace

std::optional<ParamValue> paramValueFromJson(const json& value) {
    if (value.is_boolean()) return ParamValue(value.get<bool>());
    if (value.is_number()) return ParamValue(value.get<double>());
    if (value.is_string()) return ParamValue(value.get<std::string>());
    if (value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() && value[2].is_number()) {
        return ParamValue(glm::vec3(value[0].get<float>(), value[1].get<float>(), value[2].get<float>()));
    }
    return std::nullopt;
}

json blockToJson(std::span<const ParamRef> params) {
    json object = json::object();
    for (const ParamRef& param : params) {
        json value = plainJson(paramValue(param));
        const std::string* map = isMapName(param) ? nullptr : paramMap(param);
        if (map && !map->empty()) {
            object[std::string(param.info.id)] = json{{"value", std::move(value)}, {"map", *map}};
        } else {
            object[std::string(param.info.id)] = std::move(value);
        }
    }
    return object;
}

void blockFromJson(std::span<const ParamRef> params, const json& object, const std::string& where, Problems& problems) {
    if (!object.is_object()) {
        problems.push_back(where + ": not a block of parameters; defaults are used.");
        return;
    }
    for (const auto& [key, value] : object.items()) {
        const auto known =
            std::find_if(params.begin(), params.end(),
                         [&, name = std::string_view(key)](const ParamRef& p) { return p.info.id == name; });
        if (known == params.end()) {
            problems.push_back(where + ": unknown key \"" + key + "\"; left out.");
        } else {
            setFromJson(*known, value, where + "/" + key, problems);
        }
    }
}

json hairParamsToJson(const HairParams& params) {
    json object = json::object();
    HairParams copy = params;
    HairParams::each(
        copy, [&](const BlockInfo& info, auto& block) { object[std::string(info.id)] = blockToJson(paramsOf(block)); });
    if (!params.modifiers.empty()) object["modifiers"] = modifiersToJson(params.modifiers);
    return object;
}

json modifiersToJson(const std::vector<Modifier>& list) {
    json array = json::array();
    for (Modifier modifier : list) {
        array.push_back({{"name", modifier.name},
                         {"kind", std::string(modifierKinds()[modifier.kind()].id)},
                         {"params", blockToJson(paramsOf(modifier))}});
    }
    return array;
}

void modifiersFromJson(std::vector<Modifier>& list, const json& array, const std::string& where, Problems& problems) {
    if (!array.is_array()) {
        problems.push_back(where + ": not a list of modifiers; left out.");
        return;
    }
    const auto text = [](const json& entry, const char* key) {
        return entry.contains(key) && entry[key].is_string() ? entry[key].get<std::string>() : std::string();
    };
    list.clear();
    for (const json& entry : array) {
        if (list.size() >= Modifier::most) {
            problems.push_back(where + ": more than " + std::to_string(Modifier::most) +
                               " modifiers; those beyond are left out.");
            return;
        }
        const std::string given = entry.is_object() ? text(entry, "name") : std::string();
        const auto kind = modifierKind(entry.is_object() ? text(entry, "kind") : std::string());
        if (!kind) {
            problems.push_back(where + "/" + given +
                               ": a modifier of a kind that this version does not have; left out.");
            continue;
        }
        Modifier modifier{freeModifierName(list, given)};
        if (modifier.name != given)
            problems.push_back(where + "/" + given + ": not a name of its own; now \"" + modifier.name + "\".");
        modifier.params = defaultModifierParams(*kind);
        for (const auto& [key, value] : entry.items()) {
            if (key != "name" && key != "kind" && key != "params")
                problems.push_back(where + "/" + modifier.name + ": unknown key \"" + key + "\"; left out.");
        }
        if (entry.contains("params"))
            blockFromJson(paramsOf(modifier), entry["params"], where + "/" + modifier.name, problems);
        list.push_back(std::move(modifier));
    }
}

void hairParamsFromJson(HairParams& params, const json& object, const std::string& where, Problems& problems) {
    if (!object.is_object()) {
        problems.push_back(where + ": not parameters; defaults are used.");
        return;
    }
    for (const auto& [key, value] : object.items()) {
        bool known = key == "modifiers";
        if (known) modifiersFromJson(params.modifiers, value, where + "/modifiers", problems);
        HairParams::each(params,
                         [&, name = std::string_view(key), stored = &value](const BlockInfo& info, auto& block) {
                             if (info.id != name) return;
                             known = true;
                             blockFromJson(paramsOf(block), *stored, where + "/" + std::string(info.id), problems);
                         });
        if (!known) problems.push_back(where + ": unknown block \"" + key + "\"; left out.");
    }
}

json countsToJson(const CountParams& counts) {
    CountParams copy = counts;
    return blockToJson(paramsOf(copy));
}

void countsFromJson(CountParams& counts, const json& object, const std::string& where, Problems& problems) {
    blockFromJson(paramsOf(counts), object, where, problems);
}

}  // namespace whorl
