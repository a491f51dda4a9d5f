// SPDX-License-Identifier: Apache-2.0
// Hairs of strands from their base hairs, against the scalar reference.
#include "core/base/parallel.h"
#include "core/hair/reference.h"
#include "editor/cli/bench_grooms.h"

#include <utility>

namespace whorl {
namespace {

// The reference makes an eighth of the hairs; its time counts eight times.
constexpr std::uint32_t shares = 8;

// Base hairs keep their neighbours; they and their strands are made again.
BenchRow inMemory(const std::string& name, Groom groom, std::uint32_t base, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    Progress progress;
    Generator kept;
    kept.setSurface(surface);
    std::shared_ptr<const Strands> fast = made(kept, groom, {base});
    Strands slow;
    Medians seconds = interleaved(
        [&] {
            for (Group& group : groom.groups.edit()) group.params.strands.tipSplay.value += 1e-6f;
            fast.reset();
            fast = made(kept, groom, {base});
        },
        [&] {
            slow = *generateReference(groom, surface, {base, 0, shares}, progress);
        });
    seconds.baseline *= shares;
    BenchRow row = hairRow("strands/" + name, static_cast<double>(fast->count()), threads, seconds,
                           "scalar reference from nothing, one thread, one eighth of the hairs, times eight");
    row.correct = fast->count() > slow.count() &&
                  closeToReference(groom, *surface, {base, 0, shares}, slice(*fast, 0, slow.count()), slow);
    return row;
}

// Handed over block by block and not kept, as a renderer takes it.
BenchRow streamed(const std::string& name, const Groom& groom, std::uint32_t base, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    Progress progress;
    Generator kept;
    kept.setSurface(surface);
    Strands slow, first;
    std::size_t count = 0;
    Medians seconds = interleaved(
        [&] {
            count = 0;
            const Result<void> done = kept.stream(
                groom, {base}, 1u << 14,
                [&](const Strands& block) {
                    count += block.count();
                    return true;
                },
                progress);
            if (!done) count = 0;
        },
        [&] {
            slow = *generateReference(groom, surface, {base, 0, shares}, progress);
        });
    seconds.baseline *= shares;
    BenchRow row = hairRow("strands/" + name, static_cast<double>(count), threads, seconds,
                           "scalar reference from nothing, one thread, one eighth of the hairs, times eight");
    const Result<void> done = kept.stream(
        groom, {base, 0, shares}, 1u << 14,
        [&](const Strands& block) {
            first.append(block);
            return true;
        },
        progress);
    row.correct = done && count > slow.count() && closeToReference(groom, *surface, {base, 0, shares}, first, slow);
    return row;
}

}  // namespace

std::vector<BenchRow> benchStrands() {
    const Groom ball = inStrands(benchGroom());
    BenchDocument sample = benchDocument();
    sample.groom = inStrands(std::move(sample.groom));
    sample.groom.countAnew();
    return {
        inMemory("400k x 16 of 25k base hairs", ball, 25000, 1),
        inMemory("1600k x 16 of 100k base hairs", ball, 100000, 1),
        inMemory("1600k x 16 of 100k base hairs", ball, 100000, 2),
        inMemory("1600k of 100k base hairs of the " + sample.name, sample.groom, 100000, 2),
        streamed("1600k x 16 of 100k base hairs, streamed from roots on", ball, 100000, 1),
        streamed("1600k x 16 of 100k base hairs, streamed from roots on", ball, 100000, 2),
        streamed("1600k of 100k base hairs of the " + sample.name + ", streamed", sample.groom, 100000, 2),
    };
}

}  // namespace whorl
