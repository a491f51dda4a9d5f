// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_cover.h"

#include "core/base/parallel.h"
#include "core/lic/lic_pixels.kernel.h"
#include "core/sampling/density.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

constexpr std::size_t blocksAtOnce = 16;

std::uint8_t byteOf(float share) {
    return static_cast<std::uint8_t>(std::clamp(share, 0.0f, 1.0f) * 255.0f + 0.5f);
}

}  // namespace

LicCover::LicCover(const TexelAtlas& atlas) : m_atlas(atlas), m_border(atlas) {
    m_density.assign(atlas.slots().size(), 0);
    m_opacity.assign(atlas.slots().size(), 255);
    m_reaching.assign(atlas.slots().size(), 255);
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

void LicCover::setBorder(float metres) {
    m_soft = metres > 0.0f;
    if (m_soft) m_border.set(metres, m_density);
    setReaching(std::vector<std::uint8_t>(m_atlas.blockCount(), 1));
}

void LicCover::updateBorder(std::span<const std::uint8_t> grown, std::span<std::uint8_t> changed) {
    if (!m_soft) return;
    std::vector<std::uint8_t> other(grown.size());
    m_border.update(m_density, grown, other);
    setReaching(other);
    for (std::size_t b = 0; b < other.size(); ++b) changed[b] = changed[b] | other[b];
}

// Quickly more with the way from the border, so that narrow areas such as brows keep most.
void LicCover::setReaching(std::span<const std::uint8_t> blocks) {
    static const std::vector<std::uint8_t> table = [] {
        std::vector<std::uint8_t> shares;
        for (int i = 0; i <= LicBorder::limit / 16; ++i) {
            const float left = 1.0f - static_cast<float>(i * 16) / static_cast<float>(LicBorder::limit);
            shares.push_back(byteOf(1.0f - left * left));
        }
        return shares;
    }();
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks[b]) continue;
            for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i)
                m_reaching[i] = m_soft ? table[m_border.way(i) / 16] : 255;
        }
    });
}

void LicCover::setRanks(float deviation) {
    for (int i = 0; i < 256; ++i) {
        const double off = (i / 255.0 - 0.5) / static_cast<double>(std::max(deviation, 1e-3f));
        m_ranks[static_cast<std::size_t>(i)] = byteOf(static_cast<float>(0.5 + 0.5 * std::erf(off * 0.70710678)));
    }
}

void LicCover::pixels(std::size_t b, const std::uint8_t* hair, std::uint8_t* rank, std::uint8_t* cover) const {
    const std::uint32_t first = m_atlas.firstSlot(b), count = m_atlas.firstSlot(b + 1) - first;
    WHORL_PICK(licCoverPixels)
    ({static_cast<int>(count), m_ranks.data(), hair, m_density.data() + first, m_reaching.data() + first,
      m_opacity.data() + first, rank, cover});
}

}  // namespace whorl
