// SPDX-License-Identifier: Apache-2.0
// Generation against the scalar reference: from nothing, with what is kept between strokes, and stage by stage.
#include "core/base/parallel.h"
#include "core/hair/batch.h"
#include "core/hair/reference.h"
#include "editor/cli/bench_grooms.h"

#include <algorithm>
#include <utility>

namespace whorl {
namespace {

constexpr const char* referenceText = "scalar reference from nothing, one thread";

// All of `hairs` and all that leads to them, against the reference.
BenchRow fromNothing(const std::string& name, const Groom& groom, std::uint32_t hairs, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    Progress progress;
    std::shared_ptr<const Strands> fast;
    Strands slow;
    const Medians seconds = interleaved([&] { fast = madeAnew(groom, surface, {hairs}); },
                                        [&] { slow = *generateReference(groom, surface, {hairs}, progress); });
    BenchRow row = hairRow("hair/" + name, static_cast<double>(fast->count()), threads, seconds, referenceText);
    row.correct = closeToReference(groom, *surface, {hairs}, *fast, slow);
    return row;
}

// Moves the points of all guides a little, back at every second call.
void moveGuides(Groom& groom, bool back) {
    for (std::size_t g = 0; g < groom.guides.count(); ++g)
        for (glm::vec3& p : groom.guides.editPoints(g).subspan(1)) p.x += back ? -0.0005f : 0.0005f;
}

// All hairs shaped again after all guides have moved: roots and neighbours are kept. The moving counts.
BenchRow cached(const std::string& name, Groom groom, std::uint32_t hairs, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    Generator kept;
    kept.setSurface(surface);
    Progress progress;
    std::shared_ptr<const Strands> fast = made(kept, groom, {hairs});
    Strands slow;
    bool back = false;
    const Medians seconds = interleaved(
        [&] {
            moveGuides(groom, std::exchange(back, !back));
            fast.reset();
            fast = made(kept, groom, {hairs});
        },
        [&] { slow = *generateReference(groom, surface, {hairs}, progress); });
    BenchRow row = hairRow("hair/" + name, static_cast<double>(fast->count()), threads, seconds, referenceText);
    row.correct = closeToReference(groom, *surface, {hairs}, *fast, slow);
    return row;
}

// So many hairs that the reference makes only a sixteenth of them; its time counts sixteen times.
constexpr std::uint32_t shares = 16;

bool sharesClose(const Groom& groom, const Surface& surface, std::uint32_t hairs, const Strands& all,
                 const Strands& share) {
    const auto begin = std::find(all.ids.begin(), all.ids.end(), share.ids.empty() ? 0u : share.ids[0]);
    const auto first = static_cast<std::size_t>(begin - all.ids.begin());
    if (first + share.count() > all.count()) return false;
    return closeToReference(groom, surface, {hairs, 0, shares}, slice(all, first, share.count()), share);
}

BenchRow many(const std::string& name, Groom groom, std::uint32_t hairs, unsigned threads, bool keep) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    Progress progress;
    Generator kept;
    kept.setSurface(surface);
    std::shared_ptr<const Strands> fast;
    if (keep) fast = made(kept, groom, {hairs});
    Strands slow;
    bool back = false;
    Medians seconds = interleaved(
        [&] {
            fast.reset();
            if (keep) moveGuides(groom, std::exchange(back, !back));
            fast = keep ? made(kept, groom, {hairs}) : madeAnew(groom, surface, {hairs});
        },
        [&] {
            slow = *generateReference(groom, surface, {hairs, 0, shares}, progress);
        });
    seconds.baseline *= shares;
    BenchRow row = hairRow("hair/" + name, static_cast<double>(fast->count()), threads, seconds,
                           "scalar reference from nothing, one thread, one sixteenth of the hairs, times sixteen");
    row.correct = sharesClose(groom, *surface, hairs, *fast, slow);
    return row;
}

// Hairs to guides, together against one query after another.
BenchRow binding(const std::string& name, const Groom& groom, std::uint32_t hairs) {
    const ThreadLimit limit(1);
    Progress progress;
    const DensityLookup density(groom);
    const auto sampler = RootSampler::build(groom, density, progress);
    const RootRequest request = requestFor(*groom.counts, *sampler, static_cast<double>(hairs));
    const std::vector<HairRoot> roots = makeRoots({*groom.mesh, *sampler, density, request}, {}, progress);
    const GuideIndex index(groom);
    const int samples = (*groom.groups)[0].params.general.samples;
    const auto perHair = static_cast<std::size_t>(samples);
    Bindings bindings;
    std::vector<Neighbour> plain(roots.size() * perHair);
    bool complete = true;
    const Medians seconds = interleaved(
        [&] { bindings = bindHairs(groom, index, roots, progress, std::move(bindings)); },
        [&] {
            for (std::size_t i = 0; i < roots.size(); ++i) {
                const std::span<Neighbour> out = std::span(plain).subspan(i * perHair, perHair);
                const std::size_t count = index.nearest(0, roots[i].position, roots[i].normal, samples, out);
                complete = complete && count == perHair;
            }
        });
    BenchRow row =
        hairRow("hair/" + name, static_cast<double>(roots.size()), 1, seconds, "a query of the KD-tree a hair");
    row.correct = complete;
    for (std::size_t j = 0; j < plain.size(); ++j)
        row.correct = row.correct && bindings.guides[j] == plain[j].guide && bindings.weights[j] == plain[j].weight;
    return row;
}

// Where the time goes: each stage of 400,000 hairs alone, into memory that is there, one thread.
std::vector<BenchRow> stages(const std::string& name, const Groom& groom) {
    const ThreadLimit limit(1);
    constexpr double hairs = 400000;
    Progress progress;
    const HairLookups lookups(groom);
    Result<RootSampler> sampler = RootSampler::build(groom, lookups.density, progress);
    HairParts parts{groom, {}, std::move(*sampler), GuideIndex(groom), GuideShapes(groom), {}, {}, -1.0};
    if (wantsSkin(groom)) parts.guard.emplace(std::make_shared<const Surface>(groom.mesh)->sharedSkin());
    const RootSource source{*groom.mesh, parts.sampler, lookups.density,
                            requestFor(*groom.counts, parts.sampler, hairs)};
    Batch batch;
    batch.roots = makeRoots(source, {}, progress);
    growBatch(parts, lookups, 1.0f, batch, progress);
    const HairSources sources = batch.sourcesOf(parts, lookups);
    std::vector<BenchRow> rows;
    const auto row = [&](const std::string& stage, const std::function<void()>& work) {
        rows.push_back(hairRow("hair/stage: " + stage + name, hairs, 1, interleaved(work, {}), {}));
    };
    row("roots", [&] { makeRoots(source, {}, progress); });
    row("neighbours",
        [&] { batch.bindings = bindHairs(groom, parts.index, batch.roots, progress, std::move(batch.bindings)); });
    row("traits",
        [&] { batch.traits = traitsFor(lookups.traits, batch.roots, 1.0f, progress, std::move(batch.traits)); });
    row("layout", [&] { batch.grown = layOut(sources, *batch.strands); });
    row("shapes, frames, look",
        [&] { evaluateHairs(sources, batch.grown, allOf(batch.grown), *batch.strands, progress); });
    row("look", [&] { renewLook(sources, batch.grown, allOf(batch.grown), *batch.strands); });
    return rows;
}

}  // namespace

std::vector<BenchRow> benchHair() {
    const Groom plain = benchGroom(), outside = benchGroom({true, false}), kinked = benchGroom({true, true});
    BenchDocument sample = benchDocument();
    sample.groom.countAnew();
    std::vector<BenchRow> rows = {
        fromNothing("100k x 16 from nothing", plain, 100000, 1),
        fromNothing("100k x 16 from nothing, kinked", benchGroom({false, true}), 100000, 1),
        fromNothing("100k x 16 from nothing, outside the skin", outside, 100000, 1),
        fromNothing("100k x 16 from nothing, outside the skin, kinked", kinked, 100000, 1),
        fromNothing("100k x 16 from nothing, outside the skin, kinked", kinked, 100000, 2),
        cached("100k x 16, neighbours kept", plain, 100000, 1),
        cached("100k x 16, neighbours kept, kinked", benchGroom({false, true}), 100000, 1),
        cached("100k x 16, neighbours kept, outside the skin", outside, 100000, 1),
        cached("100k x 16, neighbours kept, outside the skin", outside, 100000, 2),
        many("1600k x 16 from nothing", plain, 1600000, 2, false),
        many("1600k x 16, neighbours kept", plain, 1600000, 2, true),
        many("1600k of the " + sample.name + " from nothing", sample.groom, 1600000, 2, false),
        many("1600k of the " + sample.name + ", neighbours kept", sample.groom, 1600000, 2, true),
        binding("neighbours of 100k", plain, 100000),
        binding("neighbours of 1600k", plain, 1600000),
    };
    for (BenchRow& row : stages("", plain)) rows.push_back(std::move(row));
    for (BenchRow& row : stages(", outside the skin, kinked", kinked)) rows.push_back(std::move(row));
    return rows;
}

}  // namespace whorl
