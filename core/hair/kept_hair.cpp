// SPDX-License-Identifier: Apache-2.0
#include "core/hair/kept_hair.h"

#include "core/base/cow.h"
#include "core/base/parallel.h"
#include "core/hair/copy_strands.h"
#include "core/hair/thin.h"

#include <algorithm>
#include <numeric>

namespace whorl {
namespace {

// Above this many bytes of hair no memory is kept for the next copy.
constexpr std::size_t mostSpare = std::size_t{256} << 20;

// The pieces of the surface that a wish asks for on places [first, last) of the curve, in runs of `places`.
std::vector<RootRange> rangesOf(const SurfaceCurve& curve, const std::vector<std::uint32_t>& places, RootRange within) {
    std::vector<RootRange> ranges;
    for (std::size_t i = 0; i < places.size();) {
        std::size_t next = i + 1;
        while (next < places.size() && places[next] == places[next - 1] + 1) ++next;
        const RootRange range{std::max(curve.begins()[places[i]], within.first),
                              std::min(curve.begins()[places[next - 1] + 1], within.last)};
        if (range.first < range.last) ranges.push_back(range);
        i = next;
    }
    return ranges;
}

void copyHair(const GrownHairs& grown, std::uint32_t hair, const Strands& from, Strands& to) {
    const std::size_t first = grown.firstStrand[hair], last = grown.firstStrand[hair + 1];
    const std::size_t vertex = from.firstVertex[first], end = from.firstVertex[last];
    const auto copy = [](const auto& source, auto& target, std::size_t begin, std::size_t stop) {
        std::copy(source.begin() + static_cast<std::ptrdiff_t>(begin),
                  source.begin() + static_cast<std::ptrdiff_t>(stop),
                  target.begin() + static_cast<std::ptrdiff_t>(begin));
    };
    copy(from.ids, to.ids, first, last);
    copy(from.roots, to.roots, first, last);
    copy(from.rootUvs, to.rootUvs, first, last);
    copy(from.groups, to.groups, first, last);
    copy(from.positions, to.positions, vertex, end);
    copy(from.normals, to.normals, vertex, end);
    copy(from.widths, to.widths, vertex, end);
    copy(from.colours, to.colours, vertex, end);
}

}  // namespace

std::vector<std::uint8_t> changedGuides(const GuideSet& before, const GuideSet& next,
                                        const std::vector<std::uint8_t>& blocks) {
    std::vector<std::uint8_t> changed(next.count(), 0);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks[b]) continue;
        const std::size_t first = next.firstOfBlock(b), last = first + next.block(b).count();
        for (std::size_t g = first; g < last; ++g)
            changed[g] = before.count() != next.count() || !std::ranges::equal(before.points(g), next.points(g));
    }
    return changed;
}

void KeptHair::clear() {
    m_valid = false;
    m_batch = Batch{};
    m_spare.reset();
    m_behind.reset();
    m_thin.reset();
}

std::shared_ptr<const Strands> KeptHair::share(const Groom& groom) {
    if (!skipsVertices(groom)) return m_batch.strands;
    if (!m_thin) m_thin = std::make_shared<const Strands>(thinned(*m_batch.strands, groom));
    return m_thin;
}

void KeptHair::renew(const HairParts& parts, const HairLookups& lookups, const HairWish& wish,
                     const HairChanges& changes, Progress& progress) {
    const bool all = changes.bindings || changes.shape || changes.shapes || changes.clumps;
    const bool painted = !changes.places.empty();
    // One map may drive both where hair grows and its shape; that is rare enough to be made anew.
    const bool both = painted && ((changes.shapeMaps && !changes.shapeMaps->empty()) ||
                                  (changes.lookMaps && !changes.lookMaps->empty()));
    const bool rootsKept = m_valid && !changes.density && m_wish == wish && !(painted && all) && !both;
    m_valid = false;
    m_wish = wish;
    if (!rootsKept) {
        growAnew(parts, lookups, wish, progress);
    } else if (all) {
        regrowAll(parts, lookups, changes, progress);
    } else {
        edit(parts, lookups, wish, changes, progress);
    }
    m_valid = !progress.cancelled();
}

void KeptHair::growAnew(const HairParts& parts, const HairLookups& lookups, const HairWish& wish, Progress& progress) {
    m_thin.reset();
    ownStrands();
    const RootSource source{*parts.groom.mesh, parts.sampler, lookups.density, wish.request};
    m_batch.roots = makeRoots(source, wish.range, progress);
    growBatch(parts, lookups, wish.lod, m_batch, progress);
}

// The same roots, but any of them may have another shape.
void KeptHair::regrowAll(const HairParts& parts, const HairLookups& lookups, const HairChanges& changes,
                         Progress& progress) {
    if (changes.bindings)
        m_batch.bindings = bindHairs(parts.groom, parts.index, m_batch.roots, progress, std::move(m_batch.bindings));
    const bool coloursKnown = !changes.look && (!changes.lookMaps || changes.lookMaps->empty());
    m_batch.traits =
        traitsFor(lookups.traits, m_batch.roots, m_wish.lod, progress, std::move(m_batch.traits), coloursKnown);
    if (changes.clumps) m_batch.centres = centresOf(lookups.chain, parts.clumps, m_batch.roots, progress);
    if (progress.cancelled()) return;
    m_thin.reset();
    ownStrands();
    const HairSources sources = m_batch.sourcesOf(parts, lookups);
    m_batch.grown = layOut(sources, *m_batch.strands);
    evaluateHairs(sources, m_batch.grown, allOf(m_batch.grown), *m_batch.strands, progress);
}

// Some hairs come, go or change.
void KeptHair::edit(const HairParts& parts, const HairLookups& lookups, const HairWish& wish,
                    const HairChanges& changes, Progress& progress) {
    if (changes.look)
        m_batch.traits = traitsFor(lookups.traits, m_batch.roots, wish.lod, progress, std::move(m_batch.traits));
    BatchEdit shape, look;
    if (!changes.places.empty()) {
        const std::vector<RootRange> ranges = rangesOf(parts.sampler.curve(), changes.places, wish.range);
        renewRoots(parts, lookups, wish, ranges, m_batch, shape, progress);
    }
    if (changes.shapeMaps) renewTraits(lookups, wish.lod, *changes.shapeMaps, m_batch, shape);
    if (changes.lookMaps) renewTraits(lookups, wish.lod, *changes.lookMaps, m_batch, look);
    if (progress.cancelled()) return;

    const HairSources sources = m_batch.sourcesOf(parts, lookups);
    std::vector<std::uint32_t> which;
    if (!shape.empty() && !keepsLayout(sources, m_batch.grown, shape, *m_batch.strands)) {
        m_thin.reset();
        const std::size_t same = m_spare && m_spare.use_count() == 1 ? m_same : 0;
        const std::shared_ptr<Strands> next = otherStrands();
        m_batch.grown = spliced(sources, m_batch.grown, shape, *m_batch.strands, *next, same, which);
        m_same = shape.edits.front().first;
        m_spare = m_batch.strands->bytes() <= mostSpare ? m_batch.strands : nullptr;
        m_batch.strands = next;
        m_behind.reset();
        look = {};
        if (changes.lookMaps) renewTraits(lookups, wish.lod, *changes.lookMaps, m_batch, look);
    } else if (!shape.empty()) {
        ownCopy();
        replaceHairs(sources, shape, m_batch.grown, *m_batch.strands, which);
    }
    std::vector<std::uint32_t> guided = hairsOfChangedGuides(changes);
    if (!guided.empty()) {
        const auto middle = static_cast<std::ptrdiff_t>(which.size());
        which.insert(which.end(), guided.begin(), guided.end());
        std::inplace_merge(which.begin(), which.begin() + middle, which.end());
        which.erase(std::unique(which.begin(), which.end()), which.end());
    }
    std::vector<std::uint32_t> repainted;
    if (changes.look) {
        repainted = allOf(m_batch.grown);
    } else {
        for (const HairEdit& e : look.edits)
            for (std::uint32_t hair = e.first; hair < e.last; ++hair) repainted.push_back(hair);
    }
    if (which.empty() && repainted.empty()) return;
    ownCopy();
    m_thin.reset();
    renewLook(sources, m_batch.grown, repainted, *m_batch.strands);
    evaluateHairs(sources, m_batch.grown, which, *m_batch.strands, progress);
    noteBehind(which);
    noteBehind(repainted);
}

// Those that a changed guide shapes, or the middle of whose lock has moved; ascending.
std::vector<std::uint32_t> KeptHair::hairsOfChangedGuides(const HairChanges& changes) const {
    std::vector<std::uint32_t> which;
    if (std::none_of(changes.blocks.begin(), changes.blocks.end(), [](std::uint8_t b) { return b != 0; })) return which;
    const std::vector<std::uint8_t>& changed = changes.guides;
    const Bindings& bindings = m_batch.bindings;
    for (std::uint32_t i = 0; i < m_batch.grown.count(); ++i) {
        const std::size_t hair = m_batch.grown.roots[i];
        const std::uint32_t* guides = &bindings.guides[hair * bindings.perHair];
        bool touched =
            std::any_of(guides, guides + bindings.counts[hair], [&](std::uint32_t g) { return changed[g] != 0; });
        for (std::size_t c = 0; !touched && c < changes.movedCentres.size(); ++c) {
            const std::uint32_t centre = m_batch.centres[c][hair];
            touched = centre != ClumpCentres::none && changes.movedCentres[c][centre] != 0;
        }
        if (touched) which.push_back(i);
    }
    return which;
}

// Memory for the next strands while somebody may hold the newest: the spare's when nobody holds that.
std::shared_ptr<Strands> KeptHair::otherStrands() {
    if (!m_spare || m_spare.use_count() != 1) return std::make_shared<Strands>();
    acquireSole(m_spare);
    return std::move(m_spare);
}

// Makes the strands writable, whatever is in them. Somebody holds them: writes go to other memory.
void KeptHair::ownStrands() {
    m_behind.reset();
    m_same = 0;
    if (m_batch.strands.use_count() == 1) {
        acquireSole(m_batch.strands);
        return;
    }
    std::shared_ptr<Strands> other = otherStrands();
    m_spare = m_batch.strands->bytes() <= mostSpare ? m_batch.strands : nullptr;
    m_batch.strands = std::move(other);
}

// The same with what is in them.
void KeptHair::ownCopy() {
    if (m_batch.strands.use_count() == 1) {
        acquireSole(m_batch.strands);
        return;
    }
    const bool near = m_spare && m_spare.use_count() == 1 && m_behind;
    std::shared_ptr<Strands> other = otherStrands();
    if (near) {
        std::sort(m_behind->begin(), m_behind->end());
        m_behind->erase(std::unique(m_behind->begin(), m_behind->end()), m_behind->end());
        parallelFor(m_behind->size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) copyHair(m_batch.grown, (*m_behind)[i], *m_batch.strands, *other);
        });
    } else {
        copyStrands(*m_batch.strands, *other);
    }
    m_spare = m_batch.strands->bytes() <= mostSpare ? m_batch.strands : nullptr;
    m_batch.strands = std::move(other);
    m_behind.emplace();
    m_same = m_batch.grown.count();
}

// The spare has not these changes of the newest.
void KeptHair::noteBehind(const std::vector<std::uint32_t>& which) {
    if (!which.empty()) m_same = std::min<std::size_t>(m_same, which.front());
    if (!m_behind) return;
    if (m_behind->size() + which.size() > m_batch.grown.count() / 2) {
        m_behind.reset();
        return;
    }
    m_behind->insert(m_behind->end(), which.begin(), which.end());
}

}  // namespace whorl
