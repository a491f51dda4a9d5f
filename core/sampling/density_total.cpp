// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/density_total.h"

#include "core/sampling/root_sampler.h"

#include <algorithm>

namespace whorl {

bool drivesDensity(const Groom& groom, std::string_view map) {
    if (map.empty()) return false;
    if (groom.groups->size() > 1 && groom.counts->groupMap.name == map) return true;
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [&](const Group& group) { return group.params.general.density.map == map; });
}

float densityTotalOf(const Groom& groom) {
    Progress progress;
    const Result<RootSampler> sampler = RootSampler::build(groom, DensityLookup(groom), progress);
    if (!sampler) return 0.0f;
    return sampler->weightFor(groom.counts->hairs, static_cast<std::uint32_t>(groom.counts->seed));
}

}  // namespace whorl
