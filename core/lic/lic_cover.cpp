// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_cover.h"

#include "core/base/parallel.h"
#include "core/sampling/density.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whorl {
namespace {

// The most steps from texel to texel that a border has an effect over: what a dab of paint makes again stays bounded.
constexpr int mostHops = 512;
constexpr std::size_t blocksAtOnce = 16;
// How fast a hair ends where it ranks too low: over a quarter of the ranks.
constexpr int sharpness = 4;

std::uint8_t byteOf(float share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0f, 1.0f) * 255.0f + 0.5f);
}

// Share of hairs that come this near to the border: quickly more, so that narrow areas such as brows keep most.
float reachingBorder(float way) {
    const float left = 1.0f - std::min(way, 1.0f);
    return 1.0f - left * left;
}

}  // namespace

LicCover::LicCover(const TexelAtlas& atlas) : m_atlas(atlas) {
    const std::size_t count = atlas.slots().size();
    m_density.assign(count, 0);
    m_opacity.assign(count, 255);
    m_border.assign(count, 255);
    m_source.assign(count, TexelAtlas::none);
    m_distance.assign(count, 0.0f);
    m_hop.assign(count, 0);
    for (const TexelAtlas::Jump& jump : atlas.jumps()) {
        const auto limit = static_cast<float>(atlas.side());
        if (!(jump.to[0] >= 0.0f && jump.to[1] >= 0.0f && jump.to[0] < limit && jump.to[1] < limit)) continue;
        const auto texel = static_cast<std::uint32_t>(jump.to[1]) * static_cast<std::uint32_t>(atlas.side()) +
                           static_cast<std::uint32_t>(jump.to[0]);
        const std::uint32_t there = atlas.slotOf(texel);
        if (there == TexelAtlas::none) continue;
        m_beyond.push_back({jump.slot, there});
        m_beyond.push_back({there, jump.slot});
    }
    std::sort(m_beyond.begin(), m_beyond.end());
    m_marks.assign(count, 0);
    for (const auto& pair : m_beyond) m_marks[pair[0]] = joined;
}

glm::vec3 LicCover::position(std::uint32_t slot) const {
    return positionAt(m_atlas.mesh(), m_atlas.slots()[slot].point());
}

void LicCover::setDensity(const Groom& groom, const DirectionField& field, std::span<const std::uint8_t> blocks,
                          std::span<std::uint8_t> grown) {
    const DensityLookup density(groom);
    const float most = density.scale();
    const std::span<const std::uint8_t> grows = field.grows();
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks[b]) continue;
            for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i) {
                const TexelAtlas::Slot& slot = m_atlas.slots()[i];
                float here = 0.0f;
                if (most > 0.0f && !grows.empty() && grows[slot.triangle])
                    here = density.at(slot.triangle, uvAt(m_atlas.mesh(), slot.point())) / most;
                const std::uint8_t next = here > 0.0f ? std::max<std::uint8_t>(byteOf(here), 1) : 0;
                if ((next == 0) != (m_density[i] == 0)) grown[b] = 1;
                m_density[i] = next;
            }
        }
    });
}

void LicCover::setOpacity(const Driven& opacity, const Map* map, std::span<const std::uint8_t> blocks) {
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks[b]) continue;
            for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i) {
                const float share = map ? map->sample(uvAt(m_atlas.mesh(), m_atlas.slots()[i].point())) : 1.0f;
                m_opacity[i] = std::isfinite(share) ? byteOf(opacity.value * share) : 0;
            }
        }
    });
}

float LicCover::borderReach(float metres) const {
    if (!(metres > 0.0f)) return 0.0f;
    return std::min(std::ceil(metres / m_atlas.fineTexel()) + 2.0f, static_cast<float>(mostHops));
}

template <class Visit>
void LicCover::forNeighbours(std::uint32_t slot, Visit&& visit) const {
    const auto texel = static_cast<std::int64_t>(m_atlas.slots()[slot].texel);
    for (int n = 0; n < 9; ++n) {
        const auto there = static_cast<std::uint32_t>(texel + (n / 3 - 1) * m_atlas.side() + n % 3 - 1);
        if (n != 4 && m_atlas.slotOf(there) != TexelAtlas::none) visit(m_atlas.slotOf(there));
    }
    if ((m_marks[slot] & joined) == 0) return;
    const auto from = std::lower_bound(m_beyond.begin(), m_beyond.end(), std::array{slot, 0u});
    for (auto pair = from; pair != m_beyond.end() && (*pair)[0] == slot; ++pair) visit((*pair)[1]);
}

// Each place takes from its neighbours the nearest place without hair that they know, hop after hop; in every hop all
// see what was known before it. So what a place finds depends on its surroundings alone, however much is looked at.
void LicCover::setBorder(float metres, const std::vector<std::uint8_t>& blocks) {
    const auto hops = static_cast<int>(borderReach(metres));
    std::vector<std::uint8_t> window = blocks;
    if (hops > 0) m_atlas.spread(window, static_cast<float>(hops), true);
    std::vector<std::array<std::uint32_t, 2>> runs;  // of slots
    for (std::size_t b = 0; b < window.size() && hops > 0; ++b) {
        if (!window[b] || m_atlas.firstSlot(b) == m_atlas.firstSlot(b + 1)) continue;
        runs.push_back({m_atlas.firstSlot(b), m_atlas.firstSlot(b + 1)});
        for (std::uint32_t i = runs.back()[0]; i < runs.back()[1]; ++i) m_marks[i] |= looked;
    }
    std::vector<std::vector<Near>> edges(runs.size());
    parallelFor(runs.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            for (std::uint32_t i = runs[r][0]; i < runs[r][1]; ++i) {
                if (m_density[i] != 0) continue;
                bool border = false;
                forNeighbours(i, [&](std::uint32_t n) { border = border || m_density[n] != 0; });
                if (border) edges[r].push_back({i, i});
            }
        }
    });
    std::vector<Near> edge, next;
    for (const auto& some : edges) edge.insert(edge.end(), some.begin(), some.end());
    std::vector<std::uint32_t> touched;
    for (int hop = 0; hop < hops && !edge.empty(); ++hop) {
        next.clear();
        for (const Near& near : edge) {
            const glm::vec3 source = position(near.source);
            forNeighbours(near.slot, [&](std::uint32_t n) {
                if (m_density[n] == 0 || (m_marks[n] & looked) == 0) return;
                const float distance = glm::distance(position(n), source);
                if (!(distance < metres)) return;
                const std::uint32_t known = m_source[n];
                if (known != TexelAtlas::none &&
                    (m_distance[n] < distance || (m_distance[n] == distance && known <= near.source)))
                    return;
                if (known == TexelAtlas::none) {
                    touched.push_back(n);
                    m_hop[n] = static_cast<std::uint16_t>(hop + 1);
                }
                m_source[n] = near.source;
                m_distance[n] = distance;
                next.push_back({n, 0});
            });
        }
        std::sort(next.begin(), next.end(), [](const Near& a, const Near& b) { return a.slot < b.slot; });
        next.erase(std::unique(next.begin(), next.end(), [](const Near& a, const Near& b) { return a.slot == b.slot; }),
                   next.end());
        for (Near& near : next) near.source = m_source[near.slot];
        std::swap(edge, next);
    }
    // Where texels are so fine that the steps end before the border does, it ends with them: nowhere at once.
    const auto most = static_cast<float>(hops);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks[b]) continue;
        for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i) {
            const float way = std::max(m_distance[i] / metres, static_cast<float>(m_hop[i]) / most);
            m_border[i] = m_source[i] == TexelAtlas::none ? 255 : byteOf(reachingBorder(way));
        }
    }
    for (const std::uint32_t slot : touched) m_source[slot] = TexelAtlas::none;
    for (const auto& run : runs)
        for (std::uint32_t i = run[0]; i < run[1]; ++i) m_marks[i] &= joined;
}

void LicCover::setRanks(float deviation) {
    for (int i = 0; i < 256; ++i) {
        const double off = (i / 255.0 - 0.5) / static_cast<double>(std::max(deviation, 1e-3f));
        m_ranks[static_cast<std::size_t>(i)] = byteOf(static_cast<float>(0.5 + 0.5 * std::erf(off * 0.70710678)));
    }
}

std::uint8_t LicCover::cover(std::uint32_t slot, std::uint8_t hair) const {
    const int share = (m_density[slot] * m_border[slot] + 127) / 255;
    const int hairs = share == 0 ? 0 : std::clamp((m_ranks[hair] - (255 - share)) * sharpness + share, 0, 255);
    return static_cast<std::uint8_t>((hairs * m_opacity[slot] + 127) / 255);
}

}  // namespace whorl
