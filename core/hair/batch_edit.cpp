// SPDX-License-Identifier: Apache-2.0
#include "core/hair/batch_edit.h"

#include "core/base/parallel.h"
#include "core/hair/copy_strands.h"

#include <algorithm>

namespace whorl {
namespace {

std::uint64_t keyOf(const HairRoot& root) {
    return std::uint64_t{root.unit} << 32 | root.id;
}

bool sameRoot(const HairRoot& a, const HairRoot& b) {
    return a.id == b.id && a.group == b.group;
}

// The first entry of `slots`, from `from` on, whose root does not come before `key`. Looks nearby first.
std::uint32_t lowerBound(const std::vector<HairRoot>& roots, std::span<const std::uint32_t> slots, std::uint32_t from,
                         std::uint64_t key) {
    const auto before = [&](std::uint32_t i) { return keyOf(roots[slots[i]]) < key; };
    const auto count = static_cast<std::uint32_t>(slots.size());
    std::uint32_t step = 1;
    std::uint32_t low = from;
    while (low < count && step < count && low + step <= count && before(low + step - 1)) {
        low += step;
        step *= 2;
    }
    std::uint32_t high = std::min(low + step, count);
    while (low < high) {
        const std::uint32_t middle = low + (high - low) / 2;
        if (before(middle)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

// Roots that come instead of entries [first, last) of Batch::order.
struct RootEdit {
    std::uint32_t first, last;
    std::size_t firstNew, lastNew;
};

struct RootEdits {
    std::vector<RootEdit> edits;
    std::vector<HairRoot> roots;
};

// What differs between entries [first, last) of the order and new roots [from, to) of `made`, both in order.
void compare(const Batch& batch, std::uint32_t first, std::uint32_t last, const std::vector<HairRoot>& made,
             std::size_t from, std::size_t to, RootEdits& out) {
    const auto old = [&](std::uint32_t i) -> const HairRoot& { return batch.roots[batch.order[i]]; };
    while (first < last || from < to) {
        if (first < last && from < to && sameRoot(old(first), made[from])) {
            ++first;
            ++from;
            continue;
        }
        RootEdit edit{first, first, out.roots.size(), out.roots.size()};
        while (first < last || from < to) {
            if (first < last && from < to && sameRoot(old(first), made[from])) break;
            const bool goes = first < last && (from == to || keyOf(old(first)) <= keyOf(made[from]));
            const bool comes = from < to && (first == last || keyOf(made[from]) <= keyOf(old(first)));
            if (goes) edit.last = ++first;
            if (comes) out.roots.push_back(made[from++]);
        }
        edit.lastNew = out.roots.size();
        out.edits.push_back(edit);
    }
}

RootEdits compareRanges(const RootSource& source, std::span<const RootRange> ranges, const Batch& batch) {
    constexpr std::size_t grain = 64;
    std::vector<RootEdits> blocks((ranges.size() + grain - 1) / grain);
    parallelFor(ranges.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::vector<HairRoot> made;
        std::vector<std::size_t> ends;
        makeRoots(source, ranges.subspan(begin, end - begin), made, ends);
        std::uint32_t at = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t first = lowerBound(batch.roots, batch.order, at, std::uint64_t{ranges[i].first} << 32);
            at = lowerBound(batch.roots, batch.order, first, std::uint64_t{ranges[i].last} << 32);
            const std::size_t from = i == begin ? 0 : ends[i - begin - 1];
            compare(batch, first, at, made, from, ends[i - begin], blocks[begin / grain]);
        }
    });
    RootEdits all;
    for (RootEdits& block : blocks) {
        for (RootEdit edit : block.edits) {
            edit.firstNew += all.roots.size();
            edit.lastNew += all.roots.size();
            all.edits.push_back(edit);
        }
        all.roots.insert(all.roots.end(), block.roots.begin(), block.roots.end());
    }
    return all;
}

// Slots for that many roots: free ones first.
std::vector<std::uint32_t> takeSlots(Batch& batch, std::size_t count) {
    std::vector<std::uint32_t> slots;
    while (slots.size() < count && !batch.free.empty()) {
        slots.push_back(batch.free.back());
        batch.free.pop_back();
    }
    auto next = static_cast<std::uint32_t>(batch.roots.size());
    while (slots.size() < count) slots.push_back(next++);
    batch.roots.resize(next);
    batch.traits.resize(next);
    batch.bindings.counts.resize(next);
    batch.bindings.guides.resize(next * batch.bindings.perHair);
    batch.bindings.weights.resize(next * batch.bindings.perHair);
    for (std::vector<std::uint32_t>& centres : batch.centres) centres.resize(next, ClumpCentres::none);
    return slots;
}

void fillSlots(const HairParts& parts, const HairLookups& lookups, float lod, const std::vector<HairRoot>& roots,
               std::span<const std::uint32_t> slots, Batch& batch, Progress& progress) {
    const Bindings bindings = bindHairs(parts.groom, parts.index, roots, progress);
    const TraitList traits = traitsFor(lookups.traits, roots, lod, progress);
    const CentresOfHairs centres = centresOf(lookups.chain, parts.clumps, roots, progress);
    if (progress.cancelled()) return;
    const std::size_t places = bindings.perHair;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const std::size_t slot = slots[i];
        batch.roots[slot] = roots[i];
        batch.traits[slot] = traits[i];
        batch.bindings.counts[slot] = bindings.counts[i];
        std::copy_n(bindings.guides.begin() + static_cast<std::ptrdiff_t>(i * places), places,
                    batch.bindings.guides.begin() + static_cast<std::ptrdiff_t>(slot * places));
        std::copy_n(bindings.weights.begin() + static_cast<std::ptrdiff_t>(i * places), places,
                    batch.bindings.weights.begin() + static_cast<std::ptrdiff_t>(slot * places));
        for (std::size_t c = 0; c < centres.size(); ++c) batch.centres[c][slot] = centres[c][i];
    }
}

// What the hair of a slot needs; no vertices: it grows none.
struct HairSize {
    std::uint32_t vertices = 0, members = 0;
    std::uint32_t all() const { return vertices * members; }
};

HairSize sizeOf(const HairSources& sources, std::uint32_t slot) {
    const std::uint32_t vertices = verticesOfRoot(sources, slot);
    if (vertices == 0) return {};
    const int hairs = (*sources.groom.groups)[sources.roots[slot].group].params.strands.hairs;
    return {vertices, static_cast<std::uint32_t>(std::max(hairs, 1))};
}

}  // namespace

void renewRoots(const HairParts& parts, const HairLookups& lookups, const HairWish& wish,
                std::span<const RootRange> ranges, Batch& batch, BatchEdit& edit, Progress& progress) {
    batch.free.insert(batch.free.end(), batch.gone.begin(), batch.gone.end());
    batch.gone.clear();
    const RootSource source{*parts.groom.mesh, parts.sampler, lookups.density, wish.request};
    parts.sampler.prepare(wish.request, progress);
    const RootEdits changed = compareRanges(source, ranges, batch);
    if (changed.edits.empty()) return;
    const std::vector<std::uint32_t> slots = takeSlots(batch, changed.roots.size());
    fillSlots(parts, lookups, wish.lod, changed.roots, slots, batch, progress);
    if (progress.cancelled()) return;
    std::vector<std::uint32_t> order;
    order.reserve(batch.order.size() + slots.size());
    std::uint32_t from = 0, place = 0;
    for (const RootEdit& e : changed.edits) {
        order.insert(order.end(), batch.order.begin() + from, batch.order.begin() + e.first);
        HairEdit hair;
        const std::uint64_t key =
            e.first < e.last ? keyOf(batch.roots[batch.order[e.first]]) : keyOf(changed.roots[e.firstNew]);
        hair.first = hair.last = lowerBound(batch.roots, batch.grown.roots, place, key);
        for (std::uint32_t i = e.first; i < e.last; ++i) {
            const std::uint32_t slot = batch.order[i];
            if (hair.last < batch.grown.count() && batch.grown.roots[hair.last] == slot) ++hair.last;
            batch.gone.push_back(slot);
        }
        place = hair.last;
        hair.firstSlot = static_cast<std::uint32_t>(edit.slots.size());
        for (std::size_t i = e.firstNew; i < e.lastNew; ++i) {
            order.push_back(slots[i]);
            edit.slots.push_back(slots[i]);
        }
        hair.lastSlot = static_cast<std::uint32_t>(edit.slots.size());
        edit.edits.push_back(hair);
        from = e.last;
    }
    order.insert(order.end(), batch.order.begin() + from, batch.order.end());
    batch.order = std::move(order);
}

void renewTraits(const HairLookups& lookups, float lod, const TouchedMaps& maps, Batch& batch, BatchEdit& edit) {
    const TouchedUvs where = maps.where();
    if (where.empty()) return;
    const auto differs = [&](glm::vec2 uv) {
        return std::any_of(maps.maps().begin(), maps.maps().end(), [&](const TouchedMaps::Pair& pair) {
            return pair.before->sample(uv) != pair.after->sample(uv) ||
                   pair.before->sampleColour(uv) != pair.after->sampleColour(uv);
        });
    };
    constexpr std::size_t grain = 4096;
    std::vector<std::vector<std::uint32_t>> blocks((batch.order.size() + grain - 1) / grain);
    parallelFor(batch.order.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const HairRoot& root = batch.roots[batch.order[i]];
            if (where.at(root.uv) && differs(root.uv)) blocks[begin / grain].push_back(batch.order[i]);
        }
    });
    std::uint32_t place = 0;
    for (const std::vector<std::uint32_t>& block : blocks) {
        for (const std::uint32_t slot : block) {
            HairTraits& traits = batch.traits[slot];
            traits = lookups.traits.at(batch.roots[slot]);
            if (lod < 1.0f) widen(traits, lod);
            place = lowerBound(batch.roots, batch.grown.roots, place, keyOf(batch.roots[slot]));
            const bool grown = place < batch.grown.count() && batch.grown.roots[place] == slot;
            const auto at = static_cast<std::uint32_t>(edit.slots.size());
            edit.slots.push_back(slot);
            edit.edits.push_back({place, place + (grown ? 1u : 0u), at, at + 1});
        }
    }
}

bool keepsLayout(const HairSources& sources, const GrownHairs& grown, const BatchEdit& edit, const Strands& strands) {
    for (const HairEdit& e : edit.edits) {
        std::uint32_t hair = e.first;
        for (std::uint32_t i = e.firstSlot; i < e.lastSlot; ++i) {
            const HairSize size = sizeOf(sources, edit.slots[i]);
            if (size.vertices == 0) continue;
            if (hair == e.last) return false;
            const std::uint32_t first = grown.firstStrand[hair], last = grown.firstStrand[hair + 1];
            if (last - first != size.members || strands.firstVertex[last] - strands.firstVertex[first] != size.all())
                return false;
            ++hair;
        }
        if (hair != e.last) return false;
    }
    return true;
}

void replaceHairs(const HairSources& sources, const BatchEdit& edit, GrownHairs& grown, Strands& strands,
                  std::vector<std::uint32_t>& which) {
    which.clear();
    for (const HairEdit& e : edit.edits) {
        std::uint32_t hair = e.first;
        for (std::uint32_t i = e.firstSlot; i < e.lastSlot; ++i) {
            if (sizeOf(sources, edit.slots[i]).vertices == 0) continue;
            grown.roots[hair] = edit.slots[i];
            setHair(sources, grown, hair, strands);
            which.push_back(hair++);
        }
    }
}

GrownHairs spliced(const HairSources& sources, const GrownHairs& grown, const BatchEdit& edit, const Strands& from,
                   Strands& to, std::size_t same, std::vector<std::uint32_t>& which) {
    which.clear();
    std::size_t mostStrands = from.count(), mostVertices = from.vertexCount();
    for (const std::uint32_t slot : edit.slots) {
        const HairSize size = sizeOf(sources, slot);
        mostStrands += size.members;
        mostVertices += size.all();
    }
    if (!to.makeRoom(mostStrands, mostVertices)) same = 0;
    GrownHairs next;
    next.roots.reserve(grown.count() + edit.slots.size());
    next.firstStrand.reserve(next.roots.capacity() + 1);
    std::vector<StrandRun> runs;
    std::vector<HairSize> sizes;  // of the hairs `which`
    std::uint32_t hair = 0;
    std::int64_t vertices = 0;  // more than before, so far
    const auto keep = [&](std::uint32_t last) {
        const auto by = static_cast<std::int64_t>(next.firstStrand.back()) - grown.firstStrand[hair];
        // Nothing has moved before the first edit.
        const bool moved = hair > 0 || !which.empty();
        const std::uint32_t there = moved ? hair : std::min(last, static_cast<std::uint32_t>(same));
        addRuns(grown.firstStrand[there], grown.firstStrand[last], by, vertices, runs);
        next.roots.insert(next.roots.end(), grown.roots.begin() + hair, grown.roots.begin() + last);
        for (; hair < last; ++hair)
            next.firstStrand.push_back(static_cast<std::uint32_t>(grown.firstStrand[hair + 1] + by));
    };
    for (const HairEdit& e : edit.edits) {
        keep(e.first);
        vertices -= static_cast<std::int64_t>(from.firstVertex[grown.firstStrand[e.last]]) -
                    from.firstVertex[grown.firstStrand[e.first]];
        hair = e.last;
        for (std::uint32_t i = e.firstSlot; i < e.lastSlot; ++i) {
            const HairSize size = sizeOf(sources, edit.slots[i]);
            if (size.vertices == 0) continue;
            which.push_back(static_cast<std::uint32_t>(next.count()));
            sizes.push_back(size);
            next.roots.push_back(edit.slots[i]);
            next.firstStrand.push_back(next.firstStrand.back() + size.members);
            vertices += size.all();
        }
    }
    keep(static_cast<std::uint32_t>(grown.count()));

    const std::size_t strands = next.firstStrand.back();
    const auto all = static_cast<std::size_t>(static_cast<std::int64_t>(from.vertexCount()) + vertices);
    to.resize(strands, all);
    copyRuns(runs, from, to);
    // Where new hairs begin is where those before them, kept or new, end.
    for (std::size_t i = 0; i < which.size(); ++i) {
        const std::uint32_t first = next.firstStrand[which[i]];
        for (std::uint32_t member = 0; member < sizes[i].members; ++member)
            to.firstVertex[first + member + 1] = to.firstVertex[first + member] + sizes[i].vertices;
        setHair(sources, next, which[i], to);
    }
    return next;
}

}  // namespace whorl
