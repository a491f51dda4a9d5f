// SPDX-License-Identifier: Apache-2.0
#include "core/hair/batch.h"

#include <algorithm>
#include <numeric>

namespace whorl {

std::vector<std::uint32_t> allOf(const Strands& strands) {
    std::vector<std::uint32_t> which(strands.count());
    std::iota(which.begin(), which.end(), 0u);
    return which;
}

HairRange partRange(std::uint32_t count, std::uint32_t part, std::uint32_t partCount) {
    if (partCount == 0 || part >= partCount) return {count, count};
    const auto edge = [&](std::uint64_t p) { return static_cast<std::uint32_t>(std::uint64_t{count} * p / partCount); };
    return {edge(part), edge(std::uint64_t{part} + 1)};
}

bool wantsSkin(const Groom& groom) {
    return std::any_of(groom.groups->begin(), groom.groups->end(),
                       [](const Group& group) { return group.params.general.keepOutside; });
}

std::uint32_t hairCountOf(const Groom& groom, const GenerateOptions& options) {
    return options.hairCount.value_or(static_cast<std::uint32_t>(std::max(groom.counts->hairs, 0)));
}

void makeBatch(const HairParts& parts, const HairLookups& lookups, std::uint32_t count, Batch& batch,
               Progress& progress) {
    const Groom& groom = parts.groom;
    const RootSource source{*groom.mesh, parts.sampler, lookups.density, count,
                            static_cast<std::uint32_t>(groom.counts->seed)};
    batch.roots = makeRoots(source, batch.range, progress);
    batch.bindings = bindHairs(groom, parts.index, batch.roots, progress);
    batch.traits = makeTraits(lookups.traits, batch.roots, progress);
    if (progress.cancelled()) return;
    const HairSources sources = batch.sourcesOf(parts, lookups.traits);
    batch.grown = layOut(sources, *batch.strands);
    evaluateHairs(sources, batch.grown, allOf(*batch.strands), *batch.strands, progress);
}

Result<void> streamBatches(const HairParts& parts, const HairLookups& lookups, const GenerateOptions& options,
                           std::uint32_t blockSize, const std::function<bool(const Strands&)>& sink,
                           Progress& progress) {
    const std::uint32_t count = hairCountOf(parts.groom, options);
    const HairRange range = partRange(count, options.part, options.partCount);
    const std::uint32_t step = std::max(blockSize, 1u);
    Batch block;
    for (std::uint64_t first = range.first; first < range.last; first += step) {
        block.range = {static_cast<std::uint32_t>(first),
                       static_cast<std::uint32_t>(std::min<std::uint64_t>(first + step, range.last))};
        makeBatch(parts, lookups, count, block, progress);
        if (progress.cancelled()) return cancelledError();
        if (block.strands->count() > 0 && !sink(*block.strands)) return cancelledError();
        progress.report(
            static_cast<float>(block.range.last - range.first) / static_cast<float>(range.last - range.first),
            "Growing hair");
    }
    return {};
}

}  // namespace whorl
