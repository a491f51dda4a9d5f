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

template <class Same>
bool allGroups(const Groom& a, const Groom& b, Same&& same) {
    if (a.groups.sameAs(b.groups)) return true;
    if (a.groups->size() != b.groups->size()) return false;
    for (std::size_t i = 0; i < a.groups->size(); ++i)
        if (!same((*a.groups)[i].params.general, (*b.groups)[i].params.general)) return false;
    return true;
}

}  // namespace

bool sameDensity(const Groom& a, const Groom& b) {
    if (!a.mesh.sameAs(b.mesh)) return false;
    if (!a.partSettings.sameAs(b.partSettings) && *a.partSettings != *b.partSettings) return false;
    if (a.counts->groupMap != b.counts->groupMap || !sameMap(a, b, a.counts->groupMap.name)) return false;
    const bool numbers =
        allGroups(a, b, [](const GeneralParams& x, const GeneralParams& y) { return x.density == y.density; });
    if (!numbers) return false;
    for (const Group& group : *a.groups)
        if (!sameMap(a, b, group.params.general.density.map)) return false;
    return true;
}

bool sameBindings(const Groom& a, const Groom& b) {
    return a.mesh.sameAs(b.mesh) &&
           allGroups(a, b,
                     [](const GeneralParams& x, const GeneralParams& y) {
                         return x.samples == y.samples && x.interpolation == y.interpolation;
                     }) &&
           sameGuideRoots(a.guides, b.guides);
}

bool sameSegments(const Groom& a, const Groom& b) {
    return allGroups(a, b, [](const GeneralParams& x, const GeneralParams& y) { return x.segments == y.segments; });
}

bool sameParameters(const Groom& a, const Groom& b) {
    if (!a.counts.sameAs(b.counts) && a.counts->seed != b.counts->seed) return false;
    if (!a.groups.sameAs(b.groups) && *a.groups != *b.groups) return false;
    return a.maps.sameAs(b.maps);
}

}  // namespace whorl
