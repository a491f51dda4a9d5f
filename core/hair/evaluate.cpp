// SPDX-License-Identifier: Apache-2.0
#include "core/hair/evaluate.h"

#include "core/base/parallel.h"
#include "core/hair/evaluator.h"

#include <algorithm>

namespace whorl {
namespace {

constexpr std::size_t blockHairs = 256;

}  // namespace

std::vector<HairTraits> makeTraits(const TraitLookup& lookup, std::span<const HairRoot> roots, Progress& progress) {
    std::vector<HairTraits> traits(roots.size());
    parallelFor(roots.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        for (std::size_t i = begin; i < end; ++i) traits[i] = lookup.at(roots[i]);
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
    const HairRoot& root = sources.roots[grown.roots[hair]];
    const std::uint32_t first = grown.firstStrand[hair];
    for (std::uint32_t strand = first; strand < grown.firstStrand[hair + 1]; ++strand) {
        strands.ids[strand] = root.id;
        strands.members[strand] = static_cast<std::uint8_t>(strand - first);
        strands.roots[strand] = root.point;
        strands.rootUvs[strand] = root.uv;
        strands.groups[strand] = root.group;
    }
}

GrownHairs layOut(const HairSources& sources, Strands& strands) {
    strands.clear();
    GrownHairs grown;
    std::uint32_t vertices = 0;
    for (const std::uint32_t i : sources.order) {
        const std::uint32_t each = verticesOfRoot(sources, i);
        if (each == 0) continue;
        const HairRoot& root = sources.roots[i];
        const int hairs = std::max((*sources.groom.groups)[root.group].params.strands.hairs, 1);
        for (int member = 0; member < hairs; ++member) {
            vertices += each;
            strands.firstVertex.push_back(vertices);
            strands.ids.push_back(root.id);
            strands.members.push_back(static_cast<std::uint8_t>(member));
            strands.roots.push_back(root.point);
            strands.rootUvs.push_back(root.uv);
            strands.groups.push_back(root.group);
        }
        grown.roots.push_back(i);
        grown.firstStrand.push_back(static_cast<std::uint32_t>(strands.count()));
    }
    strands.positions.resize(vertices);
    strands.normals.resize(vertices);
    strands.widths.resize(vertices);
    strands.colours.resize(vertices);
    return grown;
}

void evaluateHairs(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
                   Strands& strands, Progress& progress) {
    const std::vector<GroupTables> tables = makeGroupTables(sources.groom);
    parallelFor(which.size(), blockHairs, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        Evaluator evaluator(sources, grown, strands);
        std::vector<std::vector<std::uint32_t>> waiting(tables.size());
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint8_t group = sources.roots[grown.roots[which[i]]].group;
            std::vector<std::uint32_t>& same = waiting[group];
            same.push_back(which[i]);
            if (same.size() < Evaluator::lanes) continue;
            evaluator.make(tables[group], same);
            same.clear();
        }
        for (std::size_t g = 0; g < tables.size(); ++g)
            if (!waiting[g].empty()) evaluator.make(tables[g], waiting[g]);
    });
}

void renewLook(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
               Strands& strands) {
    const std::vector<GroupTables> tables = makeGroupTables(sources.groom);
    parallelFor(which.size(), blockHairs, [&](std::size_t begin, std::size_t end) {
        Evaluator evaluator(sources, grown, strands);
        for (std::size_t i = begin; i < end; ++i)
            evaluator.setLook(tables[sources.roots[grown.roots[which[i]]].group], which[i]);
    });
}

}  // namespace whorl
