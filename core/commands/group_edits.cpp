// SPDX-License-Identifier: Apache-2.0
#include "core/commands/group_edits.h"

#include "core/param/param.h"
#include "core/sampling/density.h"
#include "core/surface/surface_point.h"

#include <algorithm>

namespace whorl {
namespace {

bool isNameCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

bool isName(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), isNameCharacter);
}

template <class Taken>
std::string freeName(std::string_view wanted, std::string_view fallback, const Taken& taken) {
    std::string base;
    for (const char c : wanted) base += isNameCharacter(c) ? c : '-';
    if (base.empty()) base = fallback;
    std::string name = base;
    for (int i = 2; taken(name); ++i) name = base + std::to_string(i);
    return name;
}

/// Calls `visit` with every map name that a parameter or mesh part of `block` holds.
template <class Block, class Visit>
void eachMapName(Block& block, const Visit& visit) {
    for (const ParamRef& param : paramsOf(block)) {
        if (std::string* map = paramMap(param)) visit(*map);
    }
}

/// Replaces the map `from` by `to` wherever the groom refers to it. Only parts that refer to it are unshared.
void replaceMapName(Groom& groom, std::string_view from, const std::string& to) {
    const auto replaceIn = [&](auto& block) {
        eachMapName(block, [&](std::string& map) {
            if (map == from) map = to;
        });
    };
    Groom::eachBlock(groom, [&](const BlockInfo&, auto& block) {
        auto copy = *block;
        replaceIn(copy);
        if (!(copy == *block)) block = {std::move(copy)};
    });
    std::vector<Group> groups = *groom.groups;
    for (Group& group : groups) {
        HairParams::eachWithModifiers(group.params, [&](const BlockInfo&, auto& block) { replaceIn(block); });
    }
    if (groups != *groom.groups) groom.groups.edit() = std::move(groups);
    const auto usesIt = [&](const MeshPart& part) { return part.texture == from; };
    if (std::any_of(groom.mesh->parts.begin(), groom.mesh->parts.end(), usesIt)) {
        for (MeshPart& part : groom.mesh.edit().parts) {
            if (usesIt(part)) part.texture = to;
        }
    }
}

Error badName(std::string_view name) {
    return {"\"" + std::string(name) + "\" is no name; use letters, digits, '_' and '-'."};
}

Error nameTaken(std::string_view name) {
    return {"The name \"" + std::string(name) + "\" is taken; choose another."};
}

}  // namespace

std::string freeGroupName(const Groom& groom, std::string_view wanted) {
    return freeName(wanted, "group", [&](const std::string& name) { return groom.groupIndex(name) >= 0; });
}

std::string freeMapName(const Groom& groom, std::string_view wanted) {
    return freeName(wanted, "map", [&](const std::string& name) { return groom.maps.find(name) != nullptr; });
}

Result<int> addGroup(Groom& groom, std::string_view name, int like) {
    if (groom.groups->size() >= Groom::maxGroups) {
        return Error{"A groom has at most " + std::to_string(Groom::maxGroups) + " groups; remove one first."};
    }
    if (!isName(name)) return badName(name);
    if (groom.groupIndex(name) >= 0) return nameTaken(name);
    Group group{std::string(name)};
    if (like >= 0 && static_cast<std::size_t>(like) < groom.groups->size()) {
        group.params = (*groom.groups)[static_cast<std::size_t>(like)].params;
    }
    groom.groups.edit().push_back(std::move(group));
    return static_cast<int>(groom.groups->size()) - 1;
}

Result<void> renameGroup(Groom& groom, int group, std::string_view name) {
    if (group < 0 || static_cast<std::size_t>(group) >= groom.groups->size()) return Error{"There is no such group."};
    if (!isName(name)) return badName(name);
    const int owner = groom.groupIndex(name);
    if (owner == group) return {};
    if (owner >= 0) return nameTaken(name);
    groom.groups.edit()[static_cast<std::size_t>(group)].name = name;
    return {};
}

Result<void> removeGroup(Groom& groom, int group) {
    if (group < 0 || static_cast<std::size_t>(group) >= groom.groups->size()) return Error{"There is no such group."};
    if (groom.groups->size() == 1) return Error{"The last group stays; a groom has at least one."};
    const int heir = group == 0 ? 1 : group - 1;
    const int heirSegments = (*groom.groups)[static_cast<std::size_t>(heir)].params.general.segments;
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        const int owner = groom.guides.group(i);
        if (owner < group) continue;
        if (owner == group && static_cast<int>(groom.guides.points(i).size()) != heirSegments + 1) {
            groom.guides.setPoints(i, resampled(groom.guides.points(i), heirSegments));
        }
        // Numbers above the removed one move down; so does the heir's when the first group goes.
        const int next = owner == group ? heir : owner;
        groom.guides.setGroup(i, static_cast<std::uint8_t>(next > group ? next - 1 : next));
    }
    std::vector<Group>& groups = groom.groups.edit();
    groups.erase(groups.begin() + group);
    groom.countAnew();
    return {};
}

std::size_t regroupGuides(Groom& groom) {
    const DensityLookup lookup(groom);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        const int group = lookup.groupAt(uvAt(*groom.mesh, groom.guides.root(i)));
        if (group == groom.guides.group(i)) continue;
        const int segments = (*groom.groups)[static_cast<std::size_t>(group)].params.general.segments;
        if (static_cast<int>(groom.guides.points(i).size()) != segments + 1) {
            groom.guides.setPoints(i, resampled(groom.guides.points(i), segments));
        }
        groom.guides.setGroup(i, static_cast<std::uint8_t>(group));
        ++changed;
    }
    return changed;
}

Result<void> renameMap(Groom& groom, std::string_view from, std::string_view to) {
    if (!groom.maps.find(from)) return Error{"There is no map \"" + std::string(from) + "\"."};
    if (from == to) return {};
    if (!isName(to)) return badName(to);
    if (groom.maps.find(to)) return nameTaken(to);
    // The set has no rename: it is built again, so that the order of the list stays.
    MapSet renamed;
    for (const MapSet::Entry& entry : groom.maps.entries()) {
        renamed.set(entry.name == from ? to : std::string_view(entry.name), *entry.map);
    }
    groom.maps = std::move(renamed);
    replaceMapName(groom, from, std::string(to));
    return {};
}

Result<void> removeMap(Groom& groom, std::string_view name) {
    const std::string gone(name);
    if (!groom.maps.erase(gone)) return Error{"There is no map \"" + gone + "\"."};
    replaceMapName(groom, gone, {});
    groom.countAnew();
    return {};
}

}  // namespace whorl
