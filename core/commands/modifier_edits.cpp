// SPDX-License-Identifier: Apache-2.0
#include "core/commands/modifier_edits.h"

#include "core/io/json_text.h"
#include "core/param/json.h"
#include "core/param/path.h"

#include <algorithm>

namespace whorl {

/// Written by cmake/embed_presets.cmake: file name without suffix and text of each preset.
std::vector<std::pair<std::string_view, std::string_view>> embeddedPresets();

namespace {

using List = std::vector<Modifier>;

Error noModifier(const List& list, std::string_view name) {
    std::string names;
    for (const Modifier& modifier : list) names += (names.empty() ? "" : ", ") + modifier.name;
    return {"There is no modifier \"" + std::string(name) + "\"; " +
            (names.empty() ? "the group has none." : "modifiers are " + names + ".")};
}

bool hasGroup(const Groom& groom, int group) {
    return group >= 0 && static_cast<std::size_t>(group) < groom.groups->size();
}

const List& listOf(const Groom& groom, int group) {
    return (*groom.groups)[static_cast<std::size_t>(group)].params.modifiers;
}

List& editList(Groom& groom, int group) {
    return groom.groups.edit()[static_cast<std::size_t>(group)].params.modifiers;
}

Result<std::size_t> find(const Groom& groom, int group, std::string_view name) {
    if (!hasGroup(groom, group)) return Error{"There is no such group."};
    const List& list = listOf(groom, group);
    const auto found = std::ranges::find(list, name, &Modifier::name);
    if (found == list.end()) return noModifier(list, name);
    return static_cast<std::size_t>(found - list.begin());
}

Result<void> checkName(const List& list, std::string_view name) {
    if (!isModifierName(name))
        return Error{"\"" + std::string(name) + "\" is no name; use letters, digits, '_' and '-'."};
    if (std::ranges::find(list, name, &Modifier::name) != list.end())
        return Error{"The name \"" + std::string(name) + "\" is taken; choose another."};
    return {};
}

}  // namespace

Result<int> addModifier(Groom& groom, int group, std::string_view kind, std::string_view name, int place) {
    if (!hasGroup(groom, group)) return Error{"There is no such group."};
    const List& list = listOf(groom, group);
    const auto number = modifierKind(kind);
    if (!number) {
        std::string kinds;
        for (const BlockInfo& info : modifierKinds()) kinds += (kinds.empty() ? "" : ", ") + std::string(info.id);
        return Error{"There is no kind of modifier \"" + std::string(kind) + "\"; kinds are " + kinds + "."};
    }
    if (list.size() >= Modifier::most)
        return Error{"A group has at most " + std::to_string(Modifier::most) + " modifiers; remove one first."};
    if (!name.empty()) {
        if (auto good = checkName(list, name); !good) return good.error();
    }
    Modifier modifier{name.empty() ? freeModifierName(list, kind) : std::string(name)};
    modifier.params = defaultModifierParams(*number);
    scaleLengths(paramsOf(modifier), lengthScale(*groom.mesh));
    const int last = static_cast<int>(list.size());
    const int at = place < 0 ? last : std::min(place, last);
    List& edited = editList(groom, group);
    edited.insert(edited.begin() + at, std::move(modifier));
    return at;
}

Result<void> removeModifier(Groom& groom, int group, std::string_view name) {
    const auto place = find(groom, group, name);
    if (!place) return place.error();
    List& list = editList(groom, group);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(*place));
    return {};
}

Result<void> moveModifier(Groom& groom, int group, std::string_view name, int to) {
    const auto place = find(groom, group, name);
    if (!place) return place.error();
    const int last = static_cast<int>(listOf(groom, group).size()) - 1;
    const int target = std::clamp(to, 0, last);
    const int from = static_cast<int>(*place);
    if (target == from) return {};
    List& list = editList(groom, group);
    if (from < target) {
        std::rotate(list.begin() + from, list.begin() + from + 1, list.begin() + target + 1);
    } else {
        std::rotate(list.begin() + target, list.begin() + from, list.begin() + from + 1);
    }
    return {};
}

Result<void> renameModifier(Groom& groom, int group, std::string_view name, std::string_view to) {
    const auto place = find(groom, group, name);
    if (!place) return place.error();
    if (name == to) return {};
    if (auto good = checkName(listOf(groom, group), to); !good) return good;
    editList(groom, group)[*place].name = to;
    return {};
}

const std::vector<Preset>& presets() {
    static const std::vector<Preset> all = [] {
        std::vector<Preset> list;
        for (const auto& [id, text] : embeddedPresets()) {
            const auto parsed = parseJson(text, std::string(id));
            if (!parsed || !parsed->is_object()) continue;
            list.push_back({std::string(id), parsed->value("label", std::string(id)),
                            parsed->value("tip", std::string()), std::string(text)});
        }
        std::ranges::sort(list, {}, &Preset::label);
        return list;
    }();
    return all;
}

Result<void> applyPreset(Groom& groom, int group, std::string_view text, const std::string& name) {
    if (!hasGroup(groom, group)) return Error{"There is no such group."};
    const auto parsed = parseJson(text, name);
    if (!parsed) return parsed.error();
    const auto wrong = [&](const std::string& what) { return Error{name + " is no preset: " + what}; };
    if (!parsed->is_object() || !parsed->contains("whorl_preset")) return wrong("it has no entry \"whorl_preset\".");
    const float factor = lengthScale(*groom.mesh);
    const Group& old = (*groom.groups)[static_cast<std::size_t>(group)];
    HairParams named;  // values as they are for a head
    HairParams params = old.params;
    params.modifiers.clear();
    Problems problems;
    for (const auto& [key, value] : parsed->items()) {
        if (key == "whorl_preset" || key == "label" || key == "tip") continue;
        if (key == "modifiers") {
            modifiersFromJson(params.modifiers, value, "modifiers", problems);
            for (Modifier& modifier : params.modifiers) scaleLengths(paramsOf(modifier), factor);
            continue;
        }
        const nlohmann::json one{{key, value}};
        hairParamsFromJson(named, one, name, problems);
        if (!value.is_object()) continue;
        // Only what the preset names, so that the rest of a block stays as the artist has it.
        HairParams::each(
            named, [&, block = std::string_view(key), stored = &value](const BlockInfo& info, auto& values) {
                if (info.id != block) return;
                scaleLengths(paramsOf(values), factor);
                const nlohmann::json all = blockToJson(paramsOf(values));
                HairParams::each(params, [&](const BlockInfo& target, auto& into) {
                    if (target.id != block) return;
                    for (const auto& [id, unused] : stored->items()) {
                        if (all.contains(id))
                            blockFromJson(paramsOf(into), {{id, all[id]}}, name + "/" + std::string(block), problems);
                    }
                });
            });
    }
    if (!problems.empty()) return wrong(problems.front());
    const int segments = params.general.segments;
    params.general.segments = old.params.general.segments;
    if (!(params == old.params)) groom.groups.edit()[static_cast<std::size_t>(group)].params = std::move(params);
    // Through the path, which resamples the guides.
    const std::string& owner = (*groom.groups)[static_cast<std::size_t>(group)].name;
    return setGroomValue(groom, "groups/" + owner + "/general/segments", static_cast<double>(segments));
}

}  // namespace whorl
