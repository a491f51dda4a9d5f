// SPDX-License-Identifier: Apache-2.0
#include "core/hair/batch.h"

#include "core/hair/prepared.h"
#include "core/hair/thin.h"

#include <algorithm>
#include <numeric>

namespace whorl {

std::vector<std::uint32_t> allOf(const GrownHairs& grown) {
    std::vector<std::uint32_t> which(grown.count());
    std::iota(which.begin(), which.end(), 0u);
    return which;
}

void Batch::inOrder() {
    order.resize(roots.size());
    std::iota(order.begin(), order.end(), 0u);
    free.clear();
    gone.clear();
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

TraitList traitsFor(const TraitLookup& lookup, std::span<const HairRoot> roots, float lod, Progress& progress,
                    TraitList old, bool coloursKnown) {
    TraitList traits = makeTraits(lookup, roots, progress, std::move(old), coloursKnown);
    if (lod < 1.0f) {
        for (HairTraits& t : traits) widen(t, lod);
    }
    return traits;
}

void growBatch(const HairParts& parts, const HairLookups& lookups, float lod, Batch& batch, Progress& progress) {
    batch.inOrder();
    batch.bindings = bindHairs(parts.groom, parts.index, batch.roots, progress, std::move(batch.bindings));
    batch.traits = traitsFor(lookups.traits, batch.roots, lod, progress, std::move(batch.traits));
    batch.centres = centresOf(lookups.chain, parts.clumps, batch.roots, progress);
    if (progress.cancelled()) return;
    const HairSources sources = batch.sourcesOf(parts, lookups);
    batch.grown = layOut(sources, *batch.strands);
    evaluateHairs(sources, batch.grown, allOf(batch.grown), *batch.strands, progress);
}

namespace {

/// Calls `use` with a piece of the part's roots at a time, in order, at most `step` of them; false stops.
Result<void> eachBatch(const HairParts& parts, const HairLookups& lookups, const HairWish& wish, std::size_t step,
                       const std::function<bool(std::span<const HairRoot>)>& use, Progress& progress) {
    // Fewer roots are not worth going over the surface for.
    constexpr double leastPerPiece = 4096.0;
    const RootSource source{*parts.groom.mesh, parts.sampler, lookups.density, wish.request};
    // Roots are made for a piece of the surface, hair for at most `step` of them.
    const double perPiece = std::max(static_cast<double>(step), leastPerPiece);
    const auto pieces = static_cast<std::size_t>(expectedRoots(source, wish.range) / perPiece) + 1;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        const std::vector<HairRoot> roots =
            makeRoots(source, pieceOf(parts.sampler, wish.range, piece, pieces), progress);
        for (std::size_t first = 0; first < roots.size(); first += step) {
            const bool wanted = use({roots.data() + first, std::min(step, roots.size() - first)});
            if (progress.cancelled() || !wanted) return cancelledError();
        }
        if (progress.cancelled()) return cancelledError();
        progress.report(static_cast<float>(piece + 1) / static_cast<float>(pieces), "Growing hair");
    }
    return {};
}

/// The hair of `batch`, which was grown at another time.
void growAtTime(const HairParts& parts, const HairLookups& lookups, float lod, const Batch& batch, Strands& strands,
                Progress& progress) {
    const TraitList traits = traitsFor(lookups.traits, batch.roots, lod, progress);
    if (progress.cancelled()) return;
    const HairSources sources = batch.sourcesOf(parts, lookups, traits);
    const GrownHairs grown = layOut(sources, strands);
    evaluateHairs(sources, grown, allOf(grown), strands, progress);
}

std::size_t rootsOfBlock(const HairParts& parts, std::uint32_t blockSize) {
    return std::max<std::size_t>(blockSize / mostHairsOfRoot(parts.groom), 1);
}

}  // namespace

Result<void> streamMotion(const HairParts& parts, std::span<const HairLookups* const> times,
                          const GenerateOptions& options, std::uint32_t blockSize, const MotionSink& sink,
                          Progress& progress) {
    const HairWish wish = wishFor(parts, options);
    const bool thin = skipsVertices(parts.groom);
    Batch block;
    std::vector<Strands> later(times.size() - 1);
    std::vector<const Strands*> samples(times.size());
    const auto grow = [&](std::span<const HairRoot> roots) {
        block.roots.assign(roots.begin(), roots.end());
        growBatch(parts, *times[0], wish.lod, block, progress);
        if (progress.cancelled() || block.strands->count() == 0) return true;
        samples[0] = block.strands.get();
        for (std::size_t s = 1; s < times.size(); ++s) {
            samples[s] = times[s] == times[0] ? samples[0] : &later[s - 1];
            if (samples[s] != samples[0]) growAtTime(parts, *times[s], wish.lod, block, later[s - 1], progress);
        }
        if (progress.cancelled()) return true;
        if (!thin) return sink(samples);
        const std::vector<Strands> thinner = thinnedTogether(samples, parts.groom);
        std::vector<const Strands*> shown;
        for (const Strands& sample : thinner) shown.push_back(&sample);
        return sink(shown);
    };
    return eachBatch(parts, *times[0], wish, rootsOfBlock(parts, blockSize), grow, progress);
}

Result<void> streamBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                           std::uint32_t blockSize, const std::function<bool(const Strands&)>& sink,
                           Progress& progress) {
    const HairLookups* once = &lookups;
    return streamMotion(
        parts, {&once, 1}, options, blockSize,
        [&](std::span<const Strands* const> samples) { return sink(*samples[0]); }, progress);
}

Result<HairCount> countBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                               Progress& progress) {
    const HairWish wish = wishFor(parts, options);
    HairCount count;
    Batch block;
    const auto add = [&](std::span<const HairRoot> roots) {
        block.roots.assign(roots.begin(), roots.end());
        block.inOrder();
        block.bindings = bindHairs(parts.groom, parts.index, block.roots, progress, std::move(block.bindings));
        block.traits = traitsFor(lookups.traits, block.roots, wish.lod, progress);
        if (progress.cancelled()) return true;
        layOut(block.sourcesOf(parts, lookups), *block.strands);
        count.hairs += block.strands->count();
        count.vertices += block.strands->vertexCount();
        return true;
    };
    const auto done = eachBatch(parts, lookups, wish, rootsOfBlock(parts, 1u << 14), add, progress);
    if (!done) return done.error();
    return count;
}

}  // namespace whorl
