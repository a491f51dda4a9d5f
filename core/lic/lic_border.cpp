// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_border.h"

#include "core/base/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

constexpr std::size_t blocksAtOnce = 16;
constexpr std::uint32_t shelf = 512;  // ways of so many shares wait together

}  // namespace

LicBorder::LicBorder(const TexelAtlas& atlas) : m_atlas(atlas) {
    const std::size_t count = atlas.slots().size();
    const std::int64_t side = atlas.side();
    m_around = {-side - 1,     -side,         -side + 1,    -1,           1,         side - 1,  side,     side + 1,
                -2 * side - 1, -2 * side + 1, 2 * side - 1, 2 * side + 1, -side - 2, -side + 2, side - 2, side + 2};
    const auto end = static_cast<float>(atlas.side());
    for (const TexelAtlas::Jump& jump : atlas.jumps()) {
        if (!(jump.to[0] >= 0.0f && jump.to[1] >= 0.0f && jump.to[0] < end && jump.to[1] < end)) continue;
        const auto texel = static_cast<std::uint32_t>(jump.to[1]) * static_cast<std::uint32_t>(side) +
                           static_cast<std::uint32_t>(jump.to[0]);
        const std::uint32_t there = atlas.slotOf(texel);
        if (there == TexelAtlas::none) continue;
        m_beyond.push_back({jump.slot, there});
        m_beyond.push_back({there, jump.slot});
    }
    std::sort(m_beyond.begin(), m_beyond.end());
    m_joined.assign(count, 0);
    for (const auto& pair : m_beyond) m_joined[pair[0]] = 1;
    m_ways.assign(count, 0);
    m_queue.resize(limit / shelf + 1);
}

template <class Visit>
void LicBorder::forNeighbours(std::uint32_t slot, Visit&& visit) const {
    // Texels with a place are at least two away from the edge of memory: the frame is wider than margins.
    const auto texel = static_cast<std::int64_t>(m_atlas.slots()[slot].texel);
    for (const std::int64_t step : m_around) {
        const std::uint32_t there = m_atlas.slotOf(static_cast<std::uint32_t>(texel + step));
        if (there != TexelAtlas::none) visit(there);
    }
    if (!m_joined[slot]) return;
    const auto from = std::lower_bound(m_beyond.begin(), m_beyond.end(), std::array{slot, 0u});
    for (auto pair = from; pair != m_beyond.end() && (*pair)[0] == slot; ++pair) visit((*pair)[1]);
}

glm::vec3 LicBorder::position(std::uint32_t slot) const {
    return positionAt(m_atlas.mesh(), m_atlas.slots()[slot].point());
}

// The same both ways.
std::uint32_t LicBorder::between(const glm::vec3& a, const glm::vec3& b) const {
    const float way = glm::distance(a, b) * m_scale + 0.5f;
    return way < 1.0f ? 1 : way < static_cast<float>(limit) ? static_cast<std::uint32_t>(way) : limit;
}

void LicBorder::add(std::uint32_t slot) {
    m_queue[m_ways[slot] / shelf].push_back(slot);
}

void LicBorder::spread(std::uint8_t* changed) {
    for (std::vector<std::uint32_t>& waiting : m_queue) {
        // Grows while it is gone through.
        for (std::size_t i = 0; i < waiting.size(); ++i) {
            const std::uint32_t slot = waiting[i], way = m_ways[slot];
            if (m_queue.data() + way / shelf != &waiting) continue;  // went on from already
            const glm::vec3 here = position(slot);
            forNeighbours(slot, [&](std::uint32_t n) {
                if (m_ways[n] <= way + 1) return;
                const std::uint32_t next = way + between(here, position(n));
                if (next >= m_ways[n]) return;
                m_ways[n] = static_cast<std::uint16_t>(next);
                if (changed) changed[m_atlas.blockOf(m_atlas.slots()[n].texel)] = 1;
                add(n);
            });
        }
        waiting.clear();
    }
}

void LicBorder::set(float metres, std::span<const std::uint8_t> density) {
    m_scale = static_cast<float>(limit) / metres;
    for (std::size_t i = 0; i < density.size(); ++i) m_ways[i] = density[i] == 0 ? 0 : limit;
    std::vector<std::vector<std::uint32_t>> found(m_atlas.blockCount());
    parallelFor(found.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i) {
                if (density[i] != 0) continue;
                bool border = false;
                forNeighbours(i, [&](std::uint32_t n) { border = border || density[n] != 0; });
                if (border) found[b].push_back(i);
            }
        }
    });
    for (const auto& some : found) m_queue[0].insert(m_queue[0].end(), some.begin(), some.end());
    spread(nullptr);
}

// The way of this place and of all that came over it are no longer known; those beside go on from where they are.
void LicBorder::forget(std::uint32_t slot, std::uint8_t* changed) {
    struct Lost {
        std::uint32_t slot, way;
    };
    std::vector<Lost> lost{{slot, m_ways[slot]}};
    m_ways[slot] = limit;
    for (std::size_t i = 0; i < lost.size(); ++i) {
        const Lost from = lost[i];
        const glm::vec3 here = position(from.slot);
        changed[m_atlas.blockOf(m_atlas.slots()[from.slot].texel)] = 1;
        forNeighbours(from.slot, [&](std::uint32_t n) {
            const std::uint32_t way = m_ways[n];
            if (way <= from.way || way == limit || way != from.way + between(here, position(n))) return;
            lost.push_back({n, way});
            m_ways[n] = limit;
        });
    }
    for (const Lost& of : lost)
        forNeighbours(of.slot, [&](std::uint32_t n) {
            if (m_ways[n] < limit) add(n);
        });
}

void LicBorder::update(std::span<const std::uint8_t> density, std::span<const std::uint8_t> blocks,
                       std::span<std::uint8_t> changed) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks[b]) continue;
        for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i) {
            if ((density[i] == 0) == (m_ways[i] == 0)) continue;
            changed[b] = 1;
            if (density[i] != 0) {
                forget(i, changed.data());
            } else {
                m_ways[i] = 0;
                add(i);
            }
        }
    }
    spread(changed.data());
}

}  // namespace whorl
