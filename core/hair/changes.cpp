// SPDX-License-Identifier: Apache-2.0
#include "core/hair/changes.h"

#include "core/hair/guide_index.h"

#include <algorithm>

namespace whorl {
namespace {

// The two grooms, and where to note maps that differ in texels only (null: such maps differ).
struct Both {
    const Groom& a;
    const Groom& b;
    TouchedMaps* touched = nullptr;
};

bool sameMap(const Both& both, const std::string& name) {
    if (both.touched) return both.touched->add(name);
    return name.empty() || both.a.maps.find(name) == both.b.maps.find(name);
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
bool sameNumbers(const Both& both, const Block& x, const Block& y, Member... member) {
    return ((x.*member == y.*member && sameMap(both, (x.*member).map)) && ...);
}

// The same for every parameter of a block.
template <class Block>
bool sameBlock(const Both& both, const Block& x, const Block& y) {
    if (!(x == y)) return false;
    Block copy = x;
    const std::vector<ParamRef> params = paramsOf(copy);
    return std::all_of(params.begin(), params.end(), [&](const ParamRef& param) {
        const std::string* map = paramMap(param);
        return !map || sameMap(both, *map);
    });
}

// The modifiers that `wanted` picks, changed by `as`: names do not count.
template <class Wanted, class As>
bool sameModifiers(const Both& both, const HairParams& x, const HairParams& y, Wanted&& wanted, As&& as) {
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
        if (!sameBlock(both, one[i], other[i])) return false;
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

bool sameGrowth(const Groom& a, const Groom& b) {
    return a.mesh.sameAs(b.mesh) && (a.partSettings.sameAs(b.partSettings) || *a.partSettings == *b.partSettings);
}

bool sameDensity(const Groom& a, const Groom& b, TouchedMaps* touched) {
    const Both both{a, b, touched};
    if (!sameGrowth(a, b)) return false;
    if (a.counts->groupMap != b.counts->groupMap || !sameMap(both, a.counts->groupMap.name)) return false;
    const bool numbers = allGroups(a, b, [](const HairParams& x, const HairParams& y) {
        return x.general.density == y.general.density && x.general.even == y.general.even;
    });
    if (!numbers) return false;
    for (const Group& group : *a.groups)
        if (!sameMap(both, group.params.general.density.map)) return false;
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

bool sameShapeParameters(const Groom& a, const Groom& b, TouchedMaps* touched) {
    const Both both{a, b, touched};
    if (a.counts->seed != b.counts->seed) return false;
    return allGroups(a, b, [&](const HairParams& x, const HairParams& y) {
        const GeneralParams &g = x.general, &h = y.general;
        return g.keepOutside == h.keepOutside && g.skipThreshold == h.skipThreshold &&
               sameBlock(both, x.strands, y.strands) &&
               (!mindsThickness(x) || sameNumbers(both, g, h, &GeneralParams::rootThickness)) &&
               sameModifiers(
                   both, x, y, [](const Modifier& m) { return !isTaper(m); }, [](Modifier&) {}) &&
               sameNumbers(both, g, h, &GeneralParams::cut, &GeneralParams::scale, &GeneralParams::randomScale,
                           &GeneralParams::displacement) &&
               sameNumbers(both, x.frizz, y.frizz, &FrizzParams::root, &FrizzParams::tip, &FrizzParams::frequency,
                           &FrizzParams::animation, &FrizzParams::speed) &&
               x.frizz.direction == y.frizz.direction &&
               sameNumbers(both, x.kink, y.kink, &KinkParams::root, &KinkParams::tip, &KinkParams::frequency);
    });
}

bool sameClumps(const Groom& a, const Groom& b) {
    const Both both{a, b};
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
        const bool none = std::none_of(x.modifiers.begin(), x.modifiers.end(), isClump);
        return sameModifiers(both, x, y, isClump, centresOnly) &&
               (none || sameNumbers(both, x.general, y.general, &GeneralParams::scale, &GeneralParams::displacement));
    });
}

bool isAnimated(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.frizz.animation.value > 0.0f; });
}

bool sameLookParameters(const Groom& a, const Groom& b, TouchedMaps* touched) {
    const Both both{a, b, touched};
    if (a.counts->seed != b.counts->seed) return false;
    return allGroups(a, b, [&](const HairParams& x, const HairParams& y) {
        return x.colour.mutant == y.colour.mutant && sameModifiers(both, x, y, isTaper, [](Modifier&) {}) &&
               sameNumbers(both, x.general, y.general, &GeneralParams::rootThickness, &GeneralParams::tipThickness) &&
               sameNumbers(both, x.colour, y.colour, &ColourParams::root, &ColourParams::tip,
                           &ColourParams::rootOpacity, &ColourParams::tipOpacity, &ColourParams::hueVariation,
                           &ColourParams::valueVariation, &ColourParams::mutants);
    });
}

}  // namespace whorl
