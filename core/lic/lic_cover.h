// SPDX-License-Identifier: Apache-2.0
// How much of the skin the drawn hair covers: by density, opacity and the way to the border of the growing area.
#pragma once

#include "core/base/plain_vector.h"
#include "core/field/direction_field.h"
#include "core/lic/texel_atlas.h"
#include "core/model/groom.h"

#include <array>
#include <span>
#include <vector>

namespace whorl {

/// Where less than all hair grows, single hairs are left out: those whose own noise, convolved along the field, ranks
/// low. So a border frays into hairs instead of fading. Refers to the atlas, which must outlive it.
class LicCover {
public:
    explicit LicCover(const TexelAtlas& atlas);

    /// Density of the marked blocks (one a block). Marks in `grown` those where a place got hair or lost it.
    void setDensity(const Groom& groom, const DirectionField& field, std::span<const std::uint8_t> blocks,
                    std::span<std::uint8_t> grown);
    void setOpacity(const Driven& opacity, const Map* map, std::span<const std::uint8_t> blocks);
    /// How far the border is, from the densities. `metres`: where it has no effect any more.
    void setBorder(float metres, const std::vector<std::uint8_t>& blocks);
    /// Texels that a change of density has an effect on the border from.
    float borderReach(float metres) const;
    /// How noise that tells hairs apart ranks, when it deviates that much.
    void setRanks(float deviation);

    bool grows(std::uint32_t slot) const { return m_density[slot] != 0; }
    /// Share of hairs, 0 to 255, that rank below this one, by its noise.
    std::uint8_t rank(std::uint8_t hair) const { return m_ranks[hair]; }
    /// 0 to 255, by the convolved noise of the place.
    std::uint8_t cover(std::uint32_t slot, std::uint8_t hair) const;

private:
    struct Near {
        std::uint32_t slot, source;
    };
    static constexpr std::uint8_t joined = 1, looked = 2;
    template <class Visit>
    void forNeighbours(std::uint32_t slot, Visit&& visit) const;
    glm::vec3 position(std::uint32_t slot) const;

    const TexelAtlas& m_atlas;
    std::vector<std::uint8_t> m_density;  // one a slot, as all of these; above zero where any hair grows
    std::vector<std::uint8_t> m_opacity;
    std::vector<std::uint8_t> m_border;                  // share of hairs that reach this near to the border
    std::vector<std::array<std::uint32_t, 2>> m_beyond;  // slots that stand for the same place, both ways
    std::vector<std::uint8_t> m_marks;                   // joined: in m_beyond; looked: in the window of setBorder
    std::vector<std::uint32_t> m_source;                 // nearest place without hair, while it is looked for
    std::vector<float> m_distance;
    std::vector<std::uint16_t> m_hop;  // steps from texel to texel after which it was found
    std::array<std::uint8_t, 256> m_ranks{};
};

}  // namespace whorl
