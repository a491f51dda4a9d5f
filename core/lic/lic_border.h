// SPDX-License-Identifier: Apache-2.0
// How far every texel is from the border of the hair, over the skin. Private to lic_cover.cpp.
#pragma once

#include "core/lic/texel_atlas.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// The way goes from texel to texel, through hair only, in sixteen directions and over seams: at most 3 % longer than
/// straight on. It counts in whole shares of the limit, so that what it is does not depend on what was looked at
/// first. Refers to the atlas, which must outlive it.
class LicBorder {
public:
    static constexpr std::uint16_t limit = 60000;  ///< of a way: so far and farther

    explicit LicBorder(const TexelAtlas& atlas);

    /// All ways, up to `metres` (positive). Of all these spans: one a slot; zero: no hair.
    void set(float metres, std::span<const std::uint8_t> density);
    /// Ways after hair came or went in the marked blocks (one a block) only. Marks in `changed` those where a way is
    /// another.
    void update(std::span<const std::uint8_t> density, std::span<const std::uint8_t> blocks,
                std::span<std::uint8_t> changed);

    /// 0 without hair, above where there is.
    std::uint16_t way(std::uint32_t slot) const { return m_ways[slot]; }

private:
    template <class Visit>
    void forNeighbours(std::uint32_t slot, Visit&& visit) const;
    glm::vec3 position(std::uint32_t slot) const;
    std::uint32_t between(const glm::vec3& a, const glm::vec3& b) const;
    void add(std::uint32_t slot);
    void spread(std::uint8_t* changed);
    void forget(std::uint32_t slot, std::uint8_t* changed);

    const TexelAtlas& m_atlas;
    std::array<std::int64_t, 16> m_around;               // texels
    std::vector<std::array<std::uint32_t, 2>> m_beyond;  // slots that stand for the same place, both ways
    std::vector<std::uint8_t> m_joined;                  // one a slot: in m_beyond
    std::vector<std::uint16_t> m_ways;                   // one a slot
    float m_scale = 0.0f;                                // shares of a metre
    std::vector<std::vector<std::uint32_t>> m_queue;     // slots to go on from, by way
};

}  // namespace whorl
