// SPDX-License-Identifier: Apache-2.0
// Roots out of a sampler that is made; root_sampler.cpp makes it.
#include "core/base/parallel.h"
#include "core/sampling/root_sampler.h"
#include "core/sampling/root_sweep.kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

// Candidates have numbers of 31 bits; no level is finer.
constexpr double mostCandidates = 2147483648.0;
constexpr unsigned leastLevel = 4;
// More hairs than this are not counted to make their number right.
constexpr double mostCounted = 1e6;

// The place for a share of a triangle.
SurfacePoint pointAt(std::uint32_t triangle, std::uint32_t share) {
    std::int32_t u = 0, v = 0;
    placeInTriangle(share, u, v);
    return {triangle, static_cast<float>(u) * placeUnit, static_cast<float>(v) * placeUnit};
}

}  // namespace

void RootList::reserve(std::size_t capacity) {
    if (capacity <= m_capacity) return;
    const auto grow = [&](auto& array) {
        auto more = std::make_unique_for_overwrite<std::remove_reference_t<decltype(array[0])>[]>(capacity);
        if (m_count > 0) std::memcpy(more.get(), array.get(), m_count * sizeof(array[0]));
        array = std::move(more);
    };
    grow(m_ids);
    grow(m_triangles);
    grow(m_u);
    grow(m_v);
    m_capacity = capacity;
}

std::uint8_t RootSampler::codeAt(std::size_t place, std::uint32_t share) const {
    const unsigned depth = m_depths[place];
    return m_codes[m_firstCode[place] + (depth > 0 ? share >> (32u - 2u * depth) : 0u)];
}

RootSampler::Candidate RootSampler::candidate(std::uint32_t seed, std::uint32_t index) const {
    assert(!m_curve->empty());
    if (index & evenId) return evenCandidate(seed, numberOf(index));
    const CandidateKeys keys = candidateKeys(seed);
    Candidate found;
    found.unit = unitOf(stratumOf(keys, index));
    const std::size_t place = m_curve->placeAt(found.unit);
    const auto zeros = static_cast<std::uint32_t>(std::countl_zero(m_curve->width(place)));
    const std::uint32_t share = shareOfTriangle(found.unit - m_curve->begins()[place], finePlace(keys, index), zeros,
                                                m_curve->reciprocals()[place]);
    found.point = pointAt(m_curve->triangles()[place], share);
    found.code = codeAt(place, share);
    return found;
}

void RootSampler::sample(const RootRequest& request, RootRange range, RootList& roots) const {
    std::vector<std::size_t> ends;
    sample(request, std::span(&range, 1), roots, ends);
}

void RootSampler::sample(const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                         std::vector<std::size_t>& ends) const {
    sampleAs(m_spread, request, ranges, roots, ends);
}

void RootSampler::sampleAs(Spread spread, const RootRequest& request, std::span<const RootRange> ranges,
                           RootList& roots, std::vector<std::size_t>& ends) const {
    ends.assign(ranges.size(), roots.count());
    if (empty()) return;
    if (spread == Spread::Plain) return samplePlain(request, ranges, roots, ends);
    if (spread == Spread::Even) return sampleEven(request, ranges, roots, ends);
    RootList plain, even;
    std::vector<std::size_t> plainEnds(ranges.size()), evenEnds(ranges.size());
    samplePlain(request, ranges, plain, plainEnds);
    sampleEven(request, ranges, even, evenEnds);
    const CandidateKeys keys = candidateKeys(request.seed);
    for (std::size_t i = 0; i < plain.count(); ++i) plain.m_units.push_back(unitOf(stratumOf(keys, plain.id(i))));
    roots.reserve(roots.count() + plain.count() + even.count());
    const auto take = [&](const RootList& from, std::size_t i) { roots.push(from.id(i), from.point(i), from.unit(i)); };
    std::size_t p = 0, e = 0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        while (p < plainEnds[i] || e < evenEnds[i]) {
            // Plain ids are smaller.
            if (e == evenEnds[i] || (p < plainEnds[i] && plain.unit(p) <= even.unit(e))) {
                take(plain, p++);
            } else {
                take(even, e++);
            }
        }
        ends[i] = roots.m_count;
    }
}

std::uint32_t RootSampler::limitOf(std::uint8_t code, double rate) const {
    const double limit = std::min(rate * densityOf(code) + 0.5, mostCandidates);
    return limit > 0.0 ? static_cast<std::uint32_t>(limit) : 0;
}

RootSampler::Limits RootSampler::limitsOf(double rate) const {
    Limits limits;
    for (unsigned code = 0; code < 256; ++code) limits[code] = limitOf(static_cast<std::uint8_t>(code), rate);
    return limits;
}

std::shared_ptr<const EvenSequence> RootSampler::evenFor(const RootRequest& request, bool alone,
                                                         Progress& progress) const {
    return m_even->get(request.seed, limitOf(m_brightest, request.rate), alone, progress);
}

void RootSampler::prepare(const RootRequest& request, Progress& progress) const {
    if (m_spread != Spread::Plain && !empty()) evenFor(request, false, progress);
}

void RootSampler::sampleEven(const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                             std::vector<std::size_t>& ends) const {
    Progress progress;
    const std::shared_ptr<const EvenSequence> sequence = evenFor(request, true, progress);
    const std::span<const EvenSequence::Place> places = sequence->places();
    const Limits limits = limitsOf(request.rate);
    const SurfaceCurve& curve = *m_curve;
    const auto before = [](const EvenSequence::Place& place, std::uint32_t unit) { return place.unit < unit; };
    for (std::size_t r = 0; r < ranges.size(); ++r) {
        ends[r] = roots.m_count;
        if (ranges[r].first >= ranges[r].last) continue;
        const auto first = std::lower_bound(places.begin(), places.end(), ranges[r].first, before);
        const auto last = std::lower_bound(first, places.end(), ranges[r].last, before);
        std::size_t triangle = curve.placeAt(ranges[r].first);
        for (auto place = first; place != last; ++place) {
            while (curve.begins()[triangle + 1] <= place->unit) ++triangle;
            if (place->rank >= limits[m_most[triangle]]) continue;
            if (place->rank >= limits[codeAt(triangle, place->share)]) continue;
            if (roots.m_count == roots.m_capacity) roots.reserve(2 * roots.m_capacity + 1024);
            roots.push(place->rank | evenId, pointAt(place->triangle, place->share), place->unit);
        }
        ends[r] = roots.m_count;
    }
}

// `rank` below what was asked for in that many; else the last.
RootSampler::Candidate RootSampler::evenCandidate(std::uint32_t seed, std::uint32_t rank) const {
    Progress progress;
    const auto sequence = m_even->get(seed, rank + 1.0, true, progress);
    for (const EvenSequence::Place& place : sequence->places()) {
        if (place.rank != std::min(rank, sequence->count() - 1)) continue;
        return {pointAt(place.triangle, place.share), place.unit, codeAt(m_curve->placeAt(place.unit), place.share)};
    }
    return {};
}

void RootSampler::samplePlain(const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                              std::vector<std::size_t>& ends) const {
    const Limits limits = limitsOf(request.rate);
    std::array<std::uint8_t, 256> levels;
    for (unsigned code = 0; code < 256; ++code) {
        // 2^level candidates are enough.
        const auto level = static_cast<unsigned>(std::bit_width(limits[code] > 0 ? limits[code] - 1 : 0u));
        levels[code] = static_cast<std::uint8_t>(std::clamp(level, leastLevel, 31u));
    }
    const SweepArrays arrays{candidateKeys(request.seed),
                             limits.data(),
                             levels.data(),
                             m_curve->count(),
                             m_curve->triangles().data(),
                             m_curve->begins().data(),
                             m_curve->reciprocals().data(),
                             m_firstCode.data(),
                             m_depths.data(),
                             m_most.data(),
                             m_codes.data()};
    const auto sweep = WHORL_PICK(sweepRoots);
    double expected = 0.0;
    for (const RootRange& range : ranges)
        if (range.first < range.last)
            expected += request.rate * m_weight * (shareBefore(range.last) - shareBefore(range.first));
    const double most = std::min(expected * 1.02 + 4096.0, mostCandidates);
    roots.reserve(roots.m_count + static_cast<std::size_t>(most));
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        for (std::uint32_t from = ranges[i].first; from < ranges[i].last;) {
            SweepRoots room{roots.m_ids.get(), roots.m_triangles.get(), roots.m_u.get(),
                            roots.m_v.get(),   roots.m_capacity,        roots.m_count};
            from = sweep(arrays, m_curve->placeAt(from), from, ranges[i].last, room);
            roots.m_count = room.count;
            if (from < ranges[i].last) roots.reserve(roots.m_capacity + roots.m_capacity / 2 + sweepStrata);
        }
        ends[i] = roots.m_count;
    }
}

float RootSampler::weightFor(double hairs, std::uint32_t seed) const {
    const auto average = static_cast<float>(m_weight);
    if (empty() || !(hairs >= 1.0) || hairs > mostCounted) return average;
    const auto wanted = static_cast<std::int64_t>(hairs + 0.5);
    const auto pieces = static_cast<std::uint32_t>(hairs / 32768.0) + 1;
    std::vector<RootList> lists(pieces);
    // Of groups of both kinds, each has its share of either sequence.
    const Spread spread = m_spread == Spread::Mixed ? Spread::Plain : m_spread;
    const auto excessAt = [&](float weight) {
        const RootRequest request{hairs / static_cast<double>(weight), seed};
        Progress progress;
        if (spread == Spread::Even) evenFor(request, false, progress);
        parallelFor(pieces, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                lists[i].clear();
                const RootRange range = part(static_cast<std::uint32_t>(i), pieces);
                std::vector<std::size_t> ends;
                sampleAs(spread, request, std::span(&range, 1), lists[i], ends);
            }
        });
        std::int64_t count = 0;
        for (const RootList& list : lists) count += static_cast<std::int64_t>(list.count());
        return count - wanted;
    };
    // Greater weights give fewer hairs. From the average in growing steps to both sides of the wanted number...
    struct Tried {
        float weight;
        std::int64_t excess;
    };
    const Tried first{average, excessAt(average)};
    if (first.excess == 0) return average;
    const float grow = first.excess > 0 ? 1.0f : -1.0f;
    float step = static_cast<float>(std::abs(first.excess) + 1) / static_cast<float>(wanted);
    // Ever more candidates can not help where the surface has no room for so many.
    const float most = wanted < 1000 ? 64.0f : 1.0f;
    Tried last = first, next = first;
    while ((next.excess > 0) == (first.excess > 0)) {
        if (step > most) return average;
        last = next;
        next.weight = grow > 0.0f ? average * (1.0f + step) : average / (1.0f + step);
        next.excess = excessAt(next.weight);
        if (next.excess == 0) return next.weight;
        step *= 2.0f;
    }
    // ...then between these. Where several come in at once, the smaller weight gives one too many.
    Tried many = grow > 0.0f ? last : next, few = grow > 0.0f ? next : last;
    for (bool halve = false;; halve = !halve) {
        const float share =
            halve ? 0.5f : static_cast<float>(many.excess) / static_cast<float>(many.excess - few.excess);
        float middle = many.weight + (few.weight - many.weight) * share;
        if (!(middle > many.weight && middle < few.weight)) middle = std::nextafter(many.weight, few.weight);
        if (!(middle < few.weight)) return many.weight;
        const Tried tried{middle, excessAt(middle)};
        if (tried.excess == 0) return middle;
        (tried.excess > 0 ? many : few) = tried;
    }
}

}  // namespace whorl
