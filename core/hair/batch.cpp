// SPDX-License-Identifier: Apache-2.0
#include "core/hair/batch.h"

#include "core/hair/thin.h"

#include <algorithm>
#include <numeric>

namespace whorl {

std::vector<std::uint32_t> allOf(const GrownHairs& grown) {
    std::vector<std::uint32_t> which(grown.count());
    std::iota(which.begin(), which.end(), 0u);
    return which;
}

std::size_t mostHairsOfRoot(const Groom& groom) {
    int most = 1;
    for (const Group& group : *groom.groups) most = std::max(most, group.params.strands.hairs);
    return static_cast<std::size_t>(most);
}

bool wantsSkin(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.general.keepOutside; });
}

namespace {

double hairCountOf(const Groom& groom, const GenerateOptions& options) {
    if (options.hairCount) return static_cast<double>(*options.hairCount);
    return static_cast<double>(std::max(groom.counts->hairs, 0));
}

}  // namespace

HairWish wishFor(const HairParts& parts, const GenerateOptions& options) {
    const float lod = std::clamp(options.lod, 0.0f, 1.0f);
    const double hairs = hairCountOf(parts.groom, options);
    const RootRequest all =
        parts.countedFor == hairs ? parts.counted : requestFor(*parts.groom.counts, parts.sampler, hairs);
    return {{all.rate * static_cast<double>(lod), all.seed}, parts.sampler.part(options.part, options.partCount), lod};
}

void countHairs(HairParts& parts, const GenerateOptions& options) {
    const double hairs = hairCountOf(parts.groom, options);
    if (parts.countedFor == hairs) return;
    parts.counted = requestFor(*parts.groom.counts, parts.sampler, hairs);
    parts.countedFor = hairs;
}

std::vector<HairTraits> traitsFor(const TraitLookup& lookup, std::span<const HairRoot> roots, float lod,
                                  Progress& progress) {
    std::vector<HairTraits> traits = makeTraits(lookup, roots, progress);
    if (lod < 1.0f) {
        for (HairTraits& t : traits) widen(t, lod);
    }
    return traits;
}

void growBatch(const HairParts& parts, const HairLookups& lookups, float lod, Batch& batch, Progress& progress) {
    batch.bindings = bindHairs(parts.groom, parts.index, batch.roots, progress, std::move(batch.bindings));
    batch.traits = traitsFor(lookups.traits, batch.roots, lod, progress);
    batch.centres = centresOf(lookups.chain, parts.clumps, batch.roots, progress);
    if (progress.cancelled()) return;
    const HairSources sources = batch.sourcesOf(parts, lookups);
    batch.grown = layOut(sources, *batch.strands);
    evaluateHairs(sources, batch.grown, allOf(batch.grown), *batch.strands, progress);
}

Result<void> streamBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                           std::uint32_t blockSize, const std::function<bool(const Strands&)>& sink,
                           Progress& progress) {
    // Fewer roots are not worth going over the surface for.
    constexpr double leastPerPiece = 4096.0;
    const HairWish wish = wishFor(parts, options);
    const RootSource source{*parts.groom.mesh, parts.sampler, lookups.density, wish.request};
    const std::size_t step = std::max<std::size_t>(blockSize / mostHairsOfRoot(parts.groom), 1);
    // Roots are made for a piece of the surface, hair for at most `step` of them.
    const double perPiece = std::max(static_cast<double>(step), leastPerPiece);
    const auto pieces = static_cast<std::size_t>(expectedRoots(source, wish.range) / perPiece) + 1;
    const bool thin = skipsVertices(parts.groom);
    Batch block;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        const std::vector<HairRoot> roots =
            makeRoots(source, pieceOf(parts.sampler, wish.range, piece, pieces), progress);
        for (std::size_t first = 0; first < roots.size(); first += step) {
            const std::size_t last = std::min(first + step, roots.size());
            block.roots.assign(roots.begin() + static_cast<std::ptrdiff_t>(first),
                               roots.begin() + static_cast<std::ptrdiff_t>(last));
            growBatch(parts, lookups, wish.lod, block, progress);
            if (progress.cancelled()) return cancelledError();
            if (block.strands->count() > 0 && !sink(thin ? thinned(*block.strands, parts.groom) : *block.strands))
                return cancelledError();
        }
        if (progress.cancelled()) return cancelledError();
        progress.report(static_cast<float>(piece + 1) / static_cast<float>(pieces), "Growing hair");
    }
    return {};
}

}  // namespace whorl
