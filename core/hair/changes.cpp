// SPDX-License-Identifier: Apache-2.0
#include "core/hair/changes.h"

#include "core/hair/guide_index.h"

#include <algorithm>

namespace whorl {
namespace {

bool sameMap(const Groom& a, const Groom& b, const std::string& name) {
    const auto entry = [&](const Groom& groom) -> const MapSet::Entry* {
        for (const MapSet::Entry& e : groom.maps.entries())
            if (e.name == name) return &e;
        return nullptr;
    };
    if (name.empty()) return true;
    const MapSet::Entry *x = entry(a), *y = entry(b);
    return x && y ? x->map.sameAs(y->map) : x == y;
}

// True when `same` says so of every pair of groups; also asked of shared ones, because their maps may differ.
template <class Same>
bool allGroups(const Groom& a, const Groom& b, Same&& same) {
    if (a.groups->size() != b.groups->size()) return false;
    for (std::size_t i = 0; i < a.groups->size(); ++i)
        if (!same((*a.groups)[i].params, (*b.groups)[i].params)) return false;
    return true;
}

// True when these driven parameters of two blocks have the same values and the same maps with the same texels.
template <class Block, class... Member>
bool sameNumbers(const Groom& a, const Groom& b, const Block& x, const Block& y, Member... member) {
    return ((x.*member == y.*member && sameMap(a, b, (x.*member).map)) && ...);
}

// The same for every parameter of a block.
template <class Block>
bool sameBlock(const Groom& a, const Groom& b, const Block& x, const Block& y) {
    if (!(x == y)) return false;
    Block copy = x;
    const std::vector<ParamRef> params = paramsOf(copy);
    return std::all_of(params.begin(), params.end(), [&](const ParamRef& param) {
        const std::string* map = paramMap(param);
        return !map || sameMap(a, b, *map);
    });
}

// The modifiers that `wanted` picks, changed by `as`: names do not count.
template <class Wanted, class As>
bool sameModifiers(const Groom& a, const Groom& b, const HairParams& x, const HairParams& y, Wanted&& wanted, As&& as) {
    const auto picked = [&](const HairParams& params) {
        std::vector<Modifier> list;
        for (const Modifier& modifier : params.modifiers) {
            if (!wanted(modifier)) continue;
            list.push_back(modifier);
            list.back().name.clear();
            as(list.back());
        }
        return list;
    };
    const std::vector<Modifier> one = picked(x), other = picked(y);
    if (one.size() != other.size()) return false;
    for (std::size_t i = 0; i < one.size(); ++i)
        if (!sameBlock(a, b, one[i], other[i])) return false;
    return true;
}

// True when a modifier asks how thick hairs are.
bool mindsThickness(const HairParams& params) {
    return std::any_of(params.modifiers.begin(), params.modifiers.end(), [](const Modifier& modifier) {
        const auto* bend = std::get_if<BendParams>(&modifier.params);
        return bend && bend->byThickness.value > 0.0f;
    });
}

bool isTaper(const Modifier& modifier) {
    return std::holds_alternative<TaperParams>(modifier.params);
}

// Triangles of guides cover the growing parts.
bool usesTriangles(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.general.fromTriangle(); });
}

}  // namespace

bool sameDensity(const Groom& a, const Groom& b) {
    if (!a.mesh.sameAs(b.mesh)) return false;
    if (!a.partSettings.sameAs(b.partSettings) && *a.partSettings != *b.partSettings) return false;
    if (a.counts->groupMap != b.counts->groupMap || !sameMap(a, b, a.counts->groupMap.name)) return false;
    const bool numbers = allGroups(
        a, b, [](const HairParams& x, const HairParams& y) { return x.general.density == y.general.density; });
    if (!numbers) return false;
    for (const Group& group : *a.groups)
        if (!sameMap(a, b, group.params.general.density.map)) return false;
    return true;
}

bool sameBindings(const Groom& a, const Groom& b) {
    return a.mesh.sameAs(b.mesh) && (a.partings.sameAs(b.partings) || *a.partings == *b.partings) &&
           allGroups(a, b,
                     [](const HairParams& x, const HairParams& y) {
                         return x.general.samples == y.general.samples &&
                                x.general.interpolation == y.general.interpolation &&
                                x.general.guidesFrom == y.general.guidesFrom;
                     }) &&
           (!usesTriangles(a) || a.partSettings.sameAs(b.partSettings) || *a.partSettings == *b.partSettings) &&
           sameGuideRoots(a.guides, b.guides);
}

bool sameSegments(const Groom& a, const Groom& b) {
    return allGroups(a, b,
                     [](const HairParams& x, const HairParams& y) { return x.general.segments == y.general.segments; });
}

bool sameShapeParameters(const Groom& a, const Groom& b) {
    if (a.counts->seed != b.counts->seed) return false;
    return allGroups(a, b, [&](const HairParams& x, const HairParams& y) {
        const GeneralParams &g = x.general, &h = y.general;
        return g.keepOutside == h.keepOutside && g.skipThreshold == h.skipThreshold &&
               sameBlock(a, b, x.strands, y.strands) &&
               (!mindsThickness(x) || sameNumbers(a, b, g, h, &GeneralParams::rootThickness)) &&
               sameModifiers(
                   a, b, x, y, [](const Modifier& m) { return !isTaper(m); }, [](Modifier&) {}) &&
               sameNumbers(a, b, g, h, &GeneralParams::cut, &GeneralParams::scale, &GeneralParams::randomScale,
                           &GeneralParams::displacement) &&
               sameNumbers(a, b, x.frizz, y.frizz, &FrizzParams::root, &FrizzParams::tip, &FrizzParams::frequency,
                           &FrizzParams::animation, &FrizzParams::speed) &&
               x.frizz.direction == y.frizz.direction &&
               sameNumbers(a, b, x.kink, y.kink, &KinkParams::root, &KinkParams::tip, &KinkParams::frequency);
    });
}

bool sameClumps(const Groom& a, const Groom& b) {
    if (a.counts->seed != b.counts->seed) return false;
    // Of a clump that is on, what only hairs mind is set to one and the same.
    const auto centresOnly = [](Modifier& modifier) {
        modifier.amount = {};
        ClumpParams& clump = std::get<ClumpParams>(modifier.params);
        clump.tightness = clump.rootTightness = clump.profile = clump.flyaways = {};
        clump.keepLength = false;
    };
    const auto isClump = [](const Modifier& m) {
        return m.on && m.amount.value > 0.0f && std::holds_alternative<ClumpParams>(m.params);
    };
    return allGroups(a, b, [&](const HairParams& x, const HairParams& y) {
        return sameModifiers(a, b, x, y, isClump, centresOnly) &&
               sameNumbers(a, b, x.general, y.general, &GeneralParams::scale, &GeneralParams::displacement);
    });
}

bool isAnimated(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.frizz.animation.value > 0.0f; });
}

bool sameLookParameters(const Groom& a, const Groom& b) {
    if (a.counts->seed != b.counts->seed) return false;
    return allGroups(a, b, [&](const HairParams& x, const HairParams& y) {
        return x.colour.mutant == y.colour.mutant && sameModifiers(a, b, x, y, isTaper, [](Modifier&) {}) &&
               sameNumbers(a, b, x.general, y.general, &GeneralParams::rootThickness, &GeneralParams::tipThickness) &&
               sameNumbers(a, b, x.colour, y.colour, &ColourParams::root, &ColourParams::tip,
                           &ColourParams::rootOpacity, &ColourParams::tipOpacity, &ColourParams::hueVariation,
                           &ColourParams::valueVariation, &ColourParams::mutants);
    });
}

}  // namespace whorl
