// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/root_sampler.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/root_sweep.kernel.h"
#include "core/sampling/texel_depth.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

constexpr std::size_t trianglesPerBlock = 256;
constexpr std::size_t trianglesPerSum = 64;
// Candidates have numbers of 31 bits; no level is finer.
constexpr double mostCandidates = 2147483648.0;
constexpr unsigned leastLevel = 4;
// More hairs than this are not counted to make their number right.
constexpr double mostCounted = 1e6;

float meanOf(const std::uint8_t* codes, std::size_t count) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += std::uint32_t{codes[i]} * codes[i];
    return static_cast<float>(static_cast<double>(sum) / (65025.0 * static_cast<double>(count)));
}

}  // namespace

CandidateKeys candidateKeys(std::uint32_t seed) {
    constexpr std::uint32_t channel = 0x726f6f74;
    CandidateKeys keys{};
    for (std::uint64_t i = 0; i < 3; ++i) keys.add[i] = static_cast<std::uint32_t>(randomBits(seed, i, channel) >> 32);
    keys.fine = static_cast<std::uint32_t>(randomBits(seed, 3, channel) >> 32);
    return keys;
}

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

Result<RootSampler> RootSampler::build(const Groom& groom, const DensityLookup& density, Progress& progress,
                                       const RootSampler* earlier) {
    const SurfaceMesh& mesh = *groom.mesh;
    RootSampler sampler;
    const bool serves = earlier && earlier->m_curve->serves(mesh, density.grows());
    sampler.m_curve = serves ? earlier->m_curve : std::make_shared<SurfaceCurve>(mesh, density.grows());
    const SurfaceCurve& curve = *sampler.m_curve;
    if (density.anyEven()) {
        sampler.m_spread = density.allEven() ? Spread::Even : Spread::Mixed;
        const bool same = serves && earlier->m_even;
        sampler.m_even = same ? earlier->m_even : std::make_shared<EvenSequences>(groom.mesh.share(), sampler.m_curve);
    }
    const std::size_t count = curve.count();
    std::vector<std::uint8_t> depths(count);
    parallelFor(count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            depths[i] = static_cast<std::uint8_t>(
                texelDepth(mesh, curve.triangles()[i], density.mapWidth(), density.mapHeight(), maxDepth));
    });
    sampler.m_allowed = allowedDepth(depths, maxDepth, maxPieces);

    BorderedTexels texels;
    if (const Map* map = DensityCodes::readsTexels(density)) texels.read(*map);
    const DensityCodes codes(groom, density, texels);
    std::vector<std::vector<std::uint8_t>> blocks((count + trianglesPerBlock - 1) / trianglesPerBlock);
    sampler.m_depths.resize(count);
    sampler.m_firstCode.resize(count);
    std::atomic<std::size_t> done{0};
    parallelFor(count, trianglesPerBlock, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        std::vector<std::uint8_t>& block = blocks[begin / trianglesPerBlock];
        for (std::size_t i = begin; i < end; ++i) {
            sampler.m_firstCode[i] = static_cast<std::uint32_t>(block.size());
            const int depth = codes.measure(curve.triangles()[i], std::min<int>(depths[i], sampler.m_allowed), block);
            sampler.m_depths[i] = static_cast<std::uint8_t>(depth);
        }
        const std::size_t sum = done.fetch_add(end - begin, std::memory_order_relaxed) + (end - begin);
        progress.report(static_cast<float>(sum) / static_cast<float>(count), "Measuring density");
    });
    if (progress.cancelled()) return cancelledError();

    std::vector<std::size_t> firstOfBlock(blocks.size() + 1, 0);
    for (std::size_t i = 0; i < blocks.size(); ++i) firstOfBlock[i + 1] = firstOfBlock[i] + blocks[i].size();
    sampler.m_codes.resize(firstOfBlock.back());
    sampler.m_most.resize(count);
    sampler.m_means.resize(count);
    parallelFor(count, trianglesPerBlock, [&](std::size_t begin, std::size_t end) {
        const std::size_t block = begin / trianglesPerBlock;
        std::copy(blocks[block].begin(), blocks[block].end(),
                  sampler.m_codes.begin() + static_cast<std::ptrdiff_t>(firstOfBlock[block]));
        for (std::size_t i = begin; i < end; ++i) {
            sampler.m_firstCode[i] += static_cast<std::uint32_t>(firstOfBlock[block]);
            sampler.summarise(i);
        }
    });
    sampler.m_scale = codes.scale();
    sampler.m_sums.resize((count + trianglesPerSum - 1) / trianglesPerSum);
    for (std::size_t block = 0; block < sampler.m_sums.size(); ++block) sampler.sumUp(block);
    sampler.sumUp();
    return sampler;
}

bool RootSampler::update(const Groom& groom, const DensityLookup& density, const TouchedMaps& maps,
                         std::vector<std::uint32_t>& touched) {
    touched.clear();
    const Map* const read = DensityCodes::readsTexels(density);
    const DensityCodes codes(groom, density, m_texels);
    // Codes are shares of the scale.
    if (codes.scale() != m_scale) return false;
    if (read && m_texels.empty()) {
        m_texels.read(*read);
    } else if (read) {
        for (const TouchedMaps::Pair& pair : maps.maps()) {
            if (pair.after != read) continue;
            for (const TexelRect& rect : changedTexels(*pair.before, *pair.after)) m_texels.read(*read, rect);
        }
    }
    if (!m_cells) m_cells = std::make_shared<const UvCells>(*groom.mesh, m_curve->triangles());
    touched = m_cells->under(maps.where());

    constexpr std::size_t grain = 128;
    struct Measured {
        std::vector<std::uint8_t> codes, depths;
    };
    std::vector<Measured> blocks((touched.size() + grain - 1) / grain);
    parallelFor(touched.size(), grain, [&](std::size_t begin, std::size_t end) {
        Measured& block = blocks[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t triangle = m_curve->triangles()[touched[i]];
            const int depth = texelDepth(*groom.mesh, triangle, density.mapWidth(), density.mapHeight(), maxDepth);
            block.depths.push_back(
                static_cast<std::uint8_t>(codes.measure(triangle, std::min(depth, m_allowed), block.codes)));
        }
    });
    std::size_t sum = m_sums.size();
    for (std::size_t i = 0, from = 0; i < touched.size(); ++i) {
        const Measured& block = blocks[i / grain];
        if (i % grain == 0) from = 0;
        const int depth = block.depths[i % grain];
        const std::size_t count = std::size_t{1} << (2 * depth);
        store(touched[i], depth, std::span(block.codes).subspan(from, count));
        from += count;
        const std::size_t next = touched[i] / trianglesPerSum;
        if (sum != next && sum < m_sums.size()) sumUp(sum);
        sum = next;
    }
    if (sum < m_sums.size()) sumUp(sum);
    closeGaps();
    sumUp();
    return true;
}

void RootSampler::store(std::size_t place, int depth, std::span<const std::uint8_t> codes) {
    const std::size_t had = std::size_t{1} << (2 * m_depths[place]);
    if (codes.size() > had) {
        m_lost += had;
        m_firstCode[place] = static_cast<std::uint32_t>(m_codes.size());
        m_codes.insert(m_codes.end(), codes.begin(), codes.end());
    } else {
        m_lost += had - codes.size();
        std::copy(codes.begin(), codes.end(), m_codes.begin() + static_cast<std::ptrdiff_t>(m_firstCode[place]));
    }
    m_depths[place] = static_cast<std::uint8_t>(depth);
    summarise(place);
}

// Once more than half of the codes are left behind.
void RootSampler::closeGaps() {
    if (m_lost <= m_codes.size() / 2) return;
    std::vector<std::uint8_t> codes;
    codes.reserve(m_codes.size() - m_lost);
    for (std::size_t i = 0; i < m_curve->count(); ++i) {
        const auto first = m_codes.begin() + static_cast<std::ptrdiff_t>(m_firstCode[i]);
        m_firstCode[i] = static_cast<std::uint32_t>(codes.size());
        codes.insert(codes.end(), first, first + (std::ptrdiff_t{1} << (2 * m_depths[i])));
    }
    m_codes = std::move(codes);
    m_lost = 0;
}

// Largest code and mean of a triangle.
void RootSampler::summarise(std::size_t place) {
    const std::uint8_t* codes = &m_codes[m_firstCode[place]];
    const std::size_t count = std::size_t{1} << (2 * m_depths[place]);
    m_most[place] = *std::max_element(codes, codes + count);
    m_means[place] = meanOf(codes, count);
}

double RootSampler::weightOf(std::size_t place) const {
    return static_cast<double>(m_curve->width(place)) * static_cast<double>(m_means[place]);
}

void RootSampler::sumUp(std::size_t block) {
    const std::size_t first = block * trianglesPerSum, last = std::min(first + trianglesPerSum, m_curve->count());
    m_sums[block] = 0.0;
    for (std::size_t i = first; i < last; ++i) m_sums[block] += weightOf(i);
}

// From the sums of the blocks.
void RootSampler::sumUp() {
    m_before.clear();
    double sum = 0.0;
    for (const double weight : m_sums) {
        m_before.push_back(sum);
        sum += weight;
    }
    m_before.push_back(sum);
    m_brightest = m_most.empty() ? std::uint8_t{0} : *std::max_element(m_most.begin(), m_most.end());
    m_weight = sum / static_cast<double>(SurfaceCurve::end) * m_scale;
}

std::size_t RootSampler::memoryBytes() const {
    return m_curve->memoryBytes() + m_firstCode.capacity() * sizeof(std::uint32_t) + m_depths.capacity() +
           m_most.capacity() + m_means.capacity() * sizeof(float) + m_codes.capacity() +
           (m_before.capacity() + m_sums.capacity()) * sizeof(double) + m_texels.memoryBytes() +
           (m_cells ? m_cells->memoryBytes() : 0);
}

double RootSampler::densityOf(std::uint8_t code) const {
    return static_cast<double>(code * code) / 65025.0 * m_scale;
}

std::uint32_t RootSampler::limitOf(std::uint8_t code, double rate) const {
    const double limit = std::min(rate * densityOf(code) + 0.5, mostCandidates);
    return limit > 0.0 ? static_cast<std::uint32_t>(limit) : 0;
}

RootSampler::Candidate RootSampler::candidate(std::uint32_t seed, std::uint32_t index) const {
    assert(!m_curve->empty());
    if (index & evenId) return evenCandidate(seed, index & ~evenId);
    const CandidateKeys keys = candidateKeys(seed);
    Candidate found;
    found.unit = unitOf(stratumOf(keys, index));
    const std::size_t place = m_curve->placeAt(found.unit);
    const auto zeros = static_cast<std::uint32_t>(std::countl_zero(m_curve->width(place)));
    const std::uint32_t share = shareOfTriangle(found.unit - m_curve->begins()[place], finePlace(keys, index), zeros,
                                                m_curve->reciprocals()[place]);
    std::int32_t u = 0, v = 0;
    placeInTriangle(share, u, v);
    found.point = {m_curve->triangles()[place], static_cast<float>(u) * placeUnit, static_cast<float>(v) * placeUnit};
    const unsigned depth = m_depths[place];
    found.code = m_codes[m_firstCode[place] + (depth > 0 ? share >> (32u - 2u * depth) : 0u)];
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
    const auto take = [&](const RootList& from, std::size_t i) {
        roots.m_ids[roots.m_count] = from.m_ids[i];
        roots.m_triangles[roots.m_count] = from.m_triangles[i];
        roots.m_u[roots.m_count] = from.m_u[i];
        roots.m_v[roots.m_count] = from.m_v[i];
        roots.m_units.push_back(from.m_units[i]);
        ++roots.m_count;
    };
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
            const unsigned depth = m_depths[triangle];
            const std::uint8_t code =
                m_codes[m_firstCode[triangle] + (depth > 0 ? place->share >> (32u - 2u * depth) : 0u)];
            if (place->rank >= limits[code]) continue;
            if (roots.m_count == roots.m_capacity) roots.reserve(2 * roots.m_capacity + 1024);
            std::int32_t u = 0, v = 0;
            placeInTriangle(place->share, u, v);
            roots.m_ids[roots.m_count] = place->rank | evenId;
            roots.m_triangles[roots.m_count] = place->triangle;
            roots.m_u[roots.m_count] = static_cast<float>(u) * placeUnit;
            roots.m_v[roots.m_count] = static_cast<float>(v) * placeUnit;
            roots.m_units.push_back(place->unit);
            ++roots.m_count;
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
        std::int32_t u = 0, v = 0;
        placeInTriangle(place.share, u, v);
        const std::size_t triangle = m_curve->placeAt(place.unit);
        const unsigned depth = m_depths[triangle];
        return {{place.triangle, static_cast<float>(u) * placeUnit, static_cast<float>(v) * placeUnit},
                place.unit,
                m_codes[m_firstCode[triangle] + (depth > 0 ? place.share >> (32u - 2u * depth) : 0u)]};
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

double RootSampler::shareBefore(std::uint32_t unit) const {
    if (empty() || unit == 0) return 0.0;
    if (unit >= SurfaceCurve::end) return 1.0;
    const std::size_t place = m_curve->placeAt(unit);
    double before = m_before[place / trianglesPerSum];
    for (std::size_t i = place / trianglesPerSum * trianglesPerSum; i < place; ++i) before += weightOf(i);
    const double inside = static_cast<double>(unit - m_curve->begins()[place]);
    return (before + inside * static_cast<double>(m_means[place])) / m_before.back();
}

std::vector<double> RootSampler::sharesByTriangle(std::size_t triangleCount) const {
    std::vector<double> shares(triangleCount, 0.0);
    for (std::size_t i = 0; !empty() && i < m_curve->count(); ++i)
        shares[m_curve->triangles()[i]] = weightOf(i) / m_before.back();
    return shares;
}

std::uint32_t RootSampler::cut(double share) const {
    if (empty() || !(share > 0.0)) return 0;
    const double wanted = share * m_before.back();
    if (wanted >= m_before.back()) return SurfaceCurve::end;
    const auto sum = std::upper_bound(m_before.begin(), m_before.end() - 1, wanted) - 1;
    double before = *sum;
    std::size_t place = static_cast<std::size_t>(sum - m_before.begin()) * trianglesPerSum;
    for (; place + 1 < m_curve->count() && before + weightOf(place) <= wanted; ++place) before += weightOf(place);
    const double mean = static_cast<double>(m_means[place]);
    const double inside = mean > 0.0 ? (wanted - before) / mean : 0.0;
    return m_curve->begins()[place] +
           static_cast<std::uint32_t>(std::min(inside, static_cast<double>(m_curve->width(place))));
}

RootRange RootSampler::part(std::uint32_t index, std::uint32_t count) const {
    if (index >= count) return {SurfaceCurve::end, SurfaceCurve::end};
    const auto edge = [&](std::uint32_t i) {
        if (i == 0) return 0u;
        return i == count ? SurfaceCurve::end : cut(static_cast<double>(i) / static_cast<double>(count));
    };
    return {edge(index), edge(index + 1)};
}

}  // namespace whorl
