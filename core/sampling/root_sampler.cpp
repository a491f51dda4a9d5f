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
