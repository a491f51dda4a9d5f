// SPDX-License-Identifier: Apache-2.0
// How much of the skin the drawn hair covers: by density, opacity and the way to the border of the growing area.
#pragma once

#include "core/field/direction_field.h"
#include "core/lic/lic_border.h"
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
    void setBorder(float metres);
    /// The same after places of the marked blocks got hair or lost it. Marks blocks in `changed` where that has an
    /// effect.
    void updateBorder(std::span<const std::uint8_t> grown, std::span<std::uint8_t> changed);
    /// How noise that tells hairs apart ranks, when it deviates that much.
    void setRanks(float deviation);

    bool grows(std::uint32_t slot) const { return m_density[slot] != 0; }
    /// Of the slots of block `b`, by their convolved noise that tells hairs apart: the share of hairs that rank below,
    /// and how much of the place is covered, both 0 to 255. `cover` may be null.
    void pixels(std::size_t b, const std::uint8_t* hair, std::uint8_t* rank, std::uint8_t* cover) const;

private:
    void setReaching(std::span<const std::uint8_t> blocks);

    const TexelAtlas& m_atlas;
    std::vector<std::uint8_t> m_density;  // one a slot, as all of these; above zero where any hair grows
    std::vector<std::uint8_t> m_opacity;
    std::vector<std::uint8_t> m_reaching;  // share of hairs that reach this near to the border
    LicBorder m_border;
    bool m_soft = false;  // whether there is a border
    std::array<std::uint8_t, 256> m_ranks{};
};

}  // namespace whorl
