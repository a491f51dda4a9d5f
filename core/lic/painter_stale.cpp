// SPDX-License-Identifier: Apache-2.0
#include "core/lic/painter_state.h"
#include "core/sampling/density.h"

#include <cmath>

namespace whorl {

void LicPainter::State::densityAgainst(const Groom& now, LicStale& stale) const {
    const bool same = now.groups->size() == groom.groups->size() &&
                      (now.partSettings.sameAs(groom.partSettings) || *now.partSettings == *groom.partSettings);
    // Densities count in shares of what a map of floats holds at most.
    if (!same || DensityLookup(now).scale() != densityScale) {
        LicChanges::addAll(stale.density);
        return;
    }
    changes.addMap(groom, groom.counts->groupMap.name, now, now.counts->groupMap.name, stale.density);
    for (std::size_t g = 0; g < now.groups->size(); ++g) {
        const Driven& was = (*groom.groups)[g].params.general.density;
        const Driven& is = (*now.groups)[g].params.general.density;
        if (was.value != is.value) LicChanges::addAll(stale.density);
        changes.addMap(groom, was.map, now, is.map, stale.density);
    }
}

void LicPainter::State::coloursAgainst(const Groom& now, LicStale& stale) const {
    bool same = now.groups->size() == groom.groups->size() && now.lic->colourPlace == groom.lic->colourPlace;
    for (std::size_t g = 0; same && g < now.groups->size(); ++g)
        same = (*now.groups)[g].params.colour == (*groom.groups)[g].params.colour;
    const std::vector<std::string> names = LicColours::mapNames(now), before = LicColours::mapNames(groom);
    if (!same || names.size() != before.size()) {
        LicChanges::addAll(stale.colours);
        return;
    }
    for (std::size_t i = 0; i < names.size(); ++i) changes.addMap(groom, before[i], now, names[i], stale.colours);
}

// A streamline is another one only if it came by a texel that tells it something else now.
void LicPainter::State::lightAgainst(const LicPlan& next, LicStale& stale) const {
    LicChanges::add(stale.steps, stale.light);
    LicChanges::add(stale.noise, stale.light);
    const LicBlocks told = stale.light;
    // How many of the blocks up to there are: by row and column.
    const auto across = static_cast<std::size_t>(atlas.blocksAcross()), width = across + 1;
    std::vector<std::uint32_t> sums(width * width, 0);
    for (std::size_t b = 0; b < told.size(); ++b) {
        const std::size_t at = (b / across + 1) * width + b % across + 1;
        sums[at] = told[b] + sums[at - 1] + sums[at - width] - sums[at - width - 1];
    }
    const auto upTo = [&](int x, int y) {
        return sums[static_cast<std::size_t>(y + 1) * width + static_cast<std::size_t>(x + 1)];
    };
    // Beyond seams: no streamline is longer than the steps around allow; a texel for what rounding adds.
    const std::vector<std::uint8_t> rings = atlas.ringsAround(told);
    const auto ringsOf = [](float texels) { return static_cast<int>(std::ceil(texels / TexelAtlas::block)); };
    LicBlocks around(told.size());
    const int most = ringsOf(next.longestStep * static_cast<float>(next.steps));
    for (std::size_t b = 0; b < told.size(); ++b) around[b] = rings[b] <= most ? 1 : 0;
    const float longest = std::min(words.longestStep(around), next.longestStep);
    for (std::size_t b = 0; b < told.size(); ++b) {
        const LicReach& r = reaches[b];
        if (r.left <= r.right && upTo(r.right, r.bottom) - upTo(r.left - 1, r.bottom) - upTo(r.right, r.top - 1) +
                                         upTo(r.left - 1, r.top - 1) !=
                                     0)
            stale.light[b] = 1;
        for (const LicLanding& there : landings[b])
            if (there.block == TexelAtlas::none ||
                rings[there.block] <= ringsOf(longest * static_cast<float>(there.steps) + 1.0f))
                stale.light[b] = 1;
    }
}

LicStale LicPainter::State::staleAgainst(const Groom& now, const DirectionField& nowField, const LicPlan& next,
                                         bool fresh) const {
    LicStale stale(atlas.blockCount());
    const LicParams& is = *now.lic;
    const LicParams& was = *groom.lic;
    if (fresh) {
        for (LicBlocks* all : {&stale.steps, &stale.noise, &stale.lengths, &stale.light, &stale.density, &stale.opacity,
                               &stale.cover, &stale.colours})
            LicChanges::addAll(*all);
        stale.partings = stale.ranks = stale.border = true;
        return stale;
    }
    stale.partings = !now.partings.sameAs(groom.partings) && *now.partings != *groom.partings;
    stale.ranks = next.hairDeviation != plan.hairDeviation;
    if (stale.partings || next.stepMetres != plan.stepMetres || next.longestStep != plan.longestStep)
        LicChanges::addAll(stale.steps);
    changes.addTriangles(changes.triangles(field, nowField), stale.steps);
    if (is.seed != was.seed || next.mean != plan.mean || next.samples != plan.samples || next.grains != plan.grains)
        LicChanges::addAll(stale.noise);
    changes.addMap(groom, was.grain.map, now, is.grain.map, stale.noise);
    if (next.longest != plan.longest || is.length.value != was.length.value) LicChanges::addAll(stale.lengths);
    changes.addMap(groom, was.length.map, now, is.length.map, stale.lengths);
    densityAgainst(now, stale);
    changes.addTriangles(changes.grown(field, nowField), stale.density);

    if (anyOf(stale.steps) || anyOf(stale.noise)) lightAgainst(next, stale);
    LicChanges::add(stale.lengths, stale.light);
    if (next.weights != plan.weights || next.steps != plan.steps) LicChanges::addAll(stale.light);
    stale.border = is.border != was.border;
    if (is.opacity.value != was.opacity.value) LicChanges::addAll(stale.opacity);
    changes.addMap(groom, was.opacity.map, now, is.opacity.map, stale.opacity);
    for (const LicBlocks* part : {&stale.light, &stale.density, &stale.opacity}) LicChanges::add(*part, stale.cover);
    if (stale.ranks || stale.border) LicChanges::addAll(stale.cover);
    coloursAgainst(now, stale);
    return stale;
}

}  // namespace whorl
