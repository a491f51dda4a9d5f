// SPDX-License-Identifier: Apache-2.0
#include "core/hair/evaluate.h"

#include "core/base/parallel.h"
#include "core/hair/evaluator.h"

#include <algorithm>
#include <utility>

namespace whorl {
namespace {

constexpr std::size_t blockHairs = 512;
// More hair than this leaves the caches anyway.
constexpr std::size_t cacheBytes = std::size_t{48} << 20;

// Calls `work(evaluator, group, hairs)` for up to sixteen hairs of one group at a time, of those in `which`.
template <class Work>
void forLanes(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
              Strands& strands, Progress* progress, Work&& work) {
    const std::vector<GroupTables> tables = makeGroupTables(sources.groom, sources.chain);
    const bool past = which.size() > grown.count() / 2 && strands.bytes() > cacheBytes;
    parallelFor(which.size(), blockHairs, [&](std::size_t begin, std::size_t end) {
        if (progress && progress->cancelled()) return;
        Evaluator evaluator(sources, grown, strands, past);
        std::vector<std::vector<std::uint32_t>> waiting(tables.size());
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint8_t group = sources.roots[grown.roots[which[i]]].group;
            std::vector<std::uint32_t>& same = waiting[group];
            same.push_back(which[i]);
            if (same.size() < Evaluator::lanes) continue;
            work(evaluator, tables[group], same);
            same.clear();
        }
        for (std::size_t g = 0; g < tables.size(); ++g)
            if (!waiting[g].empty()) work(evaluator, tables[g], waiting[g]);
    });
}

// All that is one a hair of the strands [first, last) of a root.
void setStrands(const HairRoot& root, std::uint32_t first, std::uint32_t last, Strands& strands) {
    for (std::uint32_t strand = first; strand < last; ++strand) {
        strands.ids[strand] = root.id;
        strands.members[strand] = static_cast<std::uint8_t>(strand - first);
        strands.roots[strand] = root.point;
        strands.rootUvs[strand] = root.uv;
        strands.groups[strand] = root.group;
    }
}

}  // namespace

TraitList makeTraits(const TraitLookup& lookup, std::span<const HairRoot> roots, Progress& progress, TraitList old,
                     bool coloursKnown) {
    TraitList traits = std::move(old);
    traits.resize(roots.size());
    parallelFor(roots.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        lookup.at(roots.subspan(begin, end - begin), std::span(traits).subspan(begin, end - begin), coloursKnown);
    });
    return traits;
}

std::uint32_t verticesOfRoot(const HairSources& sources, std::uint32_t root) {
    const HairTraits& traits = sources.traits[root];
    const HairParams& params = (*sources.groom.groups)[sources.roots[root].group].params;
    const bool grows = sources.bindings.counts[root] > 0 && traits.scale > 0.0f;
    return grows ? cutEnd(traits.cut, params.general.segments).vertices : 0;
}

void setHair(const HairSources& sources, const GrownHairs& grown, std::uint32_t hair, Strands& strands) {
    setStrands(sources.roots[grown.roots[hair]], grown.firstStrand[hair], grown.firstStrand[hair + 1], strands);
}

GrownHairs layOut(const HairSources& sources, Strands& strands) {
    // What each block of roots grows, then where it goes.
    struct Sums {
        std::uint32_t hairs = 0, strands = 0, vertices = 0;
    };
    constexpr std::size_t blockRoots = 4096;
    const std::vector<std::uint32_t>& order = sources.order;
    const auto membersOf = [&](std::uint32_t root) {
        const HairParams& params = (*sources.groom.groups)[sources.roots[root].group].params;
        return static_cast<std::uint32_t>(std::max(params.strands.hairs, 1));
    };
    std::vector<Sums> before((order.size() + blockRoots - 1) / blockRoots + 1);
    parallelFor(order.size(), blockRoots, [&](std::size_t begin, std::size_t end) {
        Sums& sums = before[begin / blockRoots + 1];
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t vertices = verticesOfRoot(sources, order[i]);
            if (vertices == 0) continue;
            const std::uint32_t members = membersOf(order[i]);
            ++sums.hairs;
            sums.strands += members;
            sums.vertices += members * vertices;
        }
    });
    for (std::size_t b = 1; b < before.size(); ++b) {
        before[b].hairs += before[b - 1].hairs;
        before[b].strands += before[b - 1].strands;
        before[b].vertices += before[b - 1].vertices;
    }
    const Sums all = before.back();
    GrownHairs grown;
    grown.roots.resize(all.hairs);
    grown.firstStrand.resize(all.hairs + std::size_t{1});
    strands.resize(all.strands, all.vertices);
    parallelFor(order.size(), blockRoots, [&](std::size_t begin, std::size_t end) {
        Sums at = before[begin / blockRoots];
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t vertices = verticesOfRoot(sources, order[i]);
            if (vertices == 0) continue;
            const std::uint32_t members = membersOf(order[i]);
            grown.roots[at.hairs] = order[i];
            grown.firstStrand[at.hairs + 1] = at.strands + members;
            for (std::uint32_t member = 0; member < members; ++member) {
                at.vertices += vertices;
                strands.firstVertex[++at.strands] = at.vertices;
            }
            setStrands(sources.roots[order[i]], at.strands - members, at.strands, strands);
            ++at.hairs;
        }
    });
    return grown;
}

void evaluateHairs(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
                   Strands& strands, Progress& progress) {
    forLanes(sources, grown, which, strands, &progress,
             [](Evaluator& evaluator, const GroupTables& group, std::span<const std::uint32_t> hairs) {
                 evaluator.make(group, hairs);
             });
}

void renewLook(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
               Strands& strands) {
    forLanes(sources, grown, which, strands, nullptr,
             [](Evaluator& evaluator, const GroupTables& group, std::span<const std::uint32_t> hairs) {
                 evaluator.setLook(group, hairs);
             });
}

}  // namespace whorl
