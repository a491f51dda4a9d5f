// SPDX-License-Identifier: Apache-2.0
// Hair after an edit: only what it touches is made again.
#include "core/base/parallel.h"
#include "editor/cli/bench_grooms.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace whorl {
namespace {

// The guides nearest to one place of the skin, as a comb finds them.
std::vector<std::uint32_t> guidesAround(const Groom& groom, std::size_t count) {
    const glm::vec3 place(0.05f, 0.05f, 0.05f);
    std::vector<std::uint32_t> guides(groom.guides.count());
    std::iota(guides.begin(), guides.end(), 0u);
    const auto away = [&](std::uint32_t g) { return glm::distance(groom.guides.points(g)[0], place); };
    std::sort(guides.begin(), guides.end(), [&](std::uint32_t a, std::uint32_t b) { return away(a) < away(b); });
    guides.resize(std::min(count, guides.size()));
    return guides;
}

// A stroke sample: the points of these guides move.
void comb(Groom& groom, std::span<const std::uint32_t> guides) {
    for (const std::uint32_t g : guides)
        for (glm::vec3& p : groom.guides.editPoints(g).subspan(1)) p.x += 0.0005f;
}

std::size_t hairsThatDiffer(const Strands& a, const Strands& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.count() && i < b.count(); ++i) {
        const auto from = a.positions.begin() + static_cast<std::ptrdiff_t>(a.firstVertex[i]);
        const auto to = a.positions.begin() + static_cast<std::ptrdiff_t>(a.firstVertex[i + 1]);
        if (!std::equal(from, to, b.positions.begin() + static_cast<std::ptrdiff_t>(b.firstVertex[i]))) ++count;
    }
    return count;
}

// After a stroke sample on `guides` guides, against everything made again by a fresh generator. Like the viewport, it
// holds the newest hair while the next is made.
BenchRow afterStroke(const std::string& name, Groom groom, std::uint32_t hairs, std::size_t guides, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    const std::vector<std::uint32_t> combed = guidesAround(groom, guides);
    Generator kept;
    kept.setSurface(surface);
    std::shared_ptr<const Strands> shown = made(kept, groom, {hairs}), fresh;
    const Strands before = *shown;
    // To move the guides is the comb's business; what is measured is generation.
    std::vector<Groom> samples;
    for (int i = 0; i < 32; ++i) {
        comb(groom, combed);
        samples.push_back(groom);
    }
    std::size_t next = 0;
    const Medians times = interleaved([&] { shown = made(kept, samples[next++], {hairs}); },
                                      [&] { fresh = madeAnew(samples[next - 1], surface, {hairs}); });
    char share[64];
    std::snprintf(share, sizeof share, "%.1f %% of the hairs touched",
                  100.0 * static_cast<double>(hairsThatDiffer(before, *shown)) / static_cast<double>(before.count()));
    BenchRow row =
        hairRow("edit/" + name, static_cast<double>(shown->count()), threads, times, "a fresh generator", share);
    row.correct = digestOf(*shown) == digestOf(*fresh) && shown->count() > 0;
    return row;
}

}  // namespace

std::vector<BenchRow> benchEdit() {
    const Groom plain = benchGroom(), outside = benchGroom({true, false}), kinked = benchGroom({true, true});
    return {
        afterStroke("100k x 16, comb", plain, 100000, 75, 1),
        afterStroke("100k x 16, comb", plain, 100000, 75, 2),
        afterStroke("100k x 16, comb, outside the skin", outside, 100000, 75, 1),
        afterStroke("100k x 16, comb, outside the skin", outside, 100000, 75, 2),
        afterStroke("100k x 16, comb, outside the skin, kinked", kinked, 100000, 75, 2),
        afterStroke("10k x 16, comb, outside the skin", outside, 10000, 75, 1),
        afterStroke("10k x 16, comb over all guides, outside the skin", outside, 10000, 2000, 1),
    };
}

}  // namespace whorl
