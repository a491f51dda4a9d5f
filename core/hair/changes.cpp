// SPDX-License-Identifier: Apache-2.0
#include "core/hair/changes.h"

#include "core/hair/guide_index.h"

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
    return a.mesh.sameAs(b.mesh) &&
           allGroups(a, b,
                     [](const HairParams& x, const HairParams& y) {
                         return x.general.samples == y.general.samples &&
                                x.general.interpolation == y.general.interpolation;
                     }) &&
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
        return g.keepOutside == h.keepOutside &&
               sameNumbers(a, b, g, h, &GeneralParams::cut, &GeneralParams::scale, &GeneralParams::randomScale,
                           &GeneralParams::displacement) &&
               sameNumbers(a, b, x.frizz, y.frizz, &FrizzParams::root, &FrizzParams::tip, &FrizzParams::frequency) &&
               sameNumbers(a, b, x.kink, y.kink, &KinkParams::root, &KinkParams::tip, &KinkParams::frequency);
    });
}

bool sameLookParameters(const Groom& a, const Groom& b) {
    if (a.counts->seed != b.counts->seed) return false;
    return allGroups(a, b, [&](const HairParams& x, const HairParams& y) {
        return x.colour.mutant == y.colour.mutant &&
               sameNumbers(a, b, x.general, y.general, &GeneralParams::rootThickness, &GeneralParams::tipThickness) &&
               sameNumbers(a, b, x.colour, y.colour, &ColourParams::root, &ColourParams::tip,
                           &ColourParams::rootOpacity, &ColourParams::tipOpacity, &ColourParams::hueVariation,
                           &ColourParams::valueVariation, &ColourParams::mutants);
    });
}

}  // namespace whorl
