// SPDX-License-Identifier: Apache-2.0
// Colour of the drawn hair, from the colours of the groups.
#pragma once

#include "core/lic/texel_atlas.h"
#include "core/model/groom.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace whorl {

using LicColour = std::array<std::uint8_t, 3>;  ///< sRGB

/// Refers to the atlas, which must outlive it.
class LicColours {
public:
    explicit LicColours(const TexelAtlas& atlas) : m_atlas(atlas) {}

    /// Colours of the groom's groups, and of the places of the marked blocks (one a block).
    void set(const Groom& groom, std::span<const std::uint8_t> blocks);
    /// True when hairs of one place differ in colour.
    bool varies() const { return m_varies; }
    /// `rank`: the same along a drawn hair, all equally frequent.
    LicColour at(std::uint32_t slot, std::uint8_t rank) const;

    /// Names of maps that colours depend on.
    static std::vector<std::string> mapNames(const Groom& groom);

private:
    // How hairs of one rank differ from the colour of the place.
    struct Variation {
        float turn[3]{1.0f, 0.0f, 0.0f};  ///< of the hue: a row of a matrix of which the others are turned on
        float mutant = 0.0f;
    };
    struct Entry {
        glm::vec3 mutant{0.0f};
        std::vector<Variation> ranks;  ///< 256
    };
    static Variation variation(float hue, float value, float mutants, float rank);

    const TexelAtlas& m_atlas;
    std::vector<Entry> m_entries;
    std::vector<std::uint8_t> m_groups;    // one a slot; empty: there is only one
    std::vector<glm::vec3> m_places;       // one a slot: linear colour
    std::vector<glm::vec3> m_differences;  // one a slot, hue, value and mutants; empty: as the groups have them
    bool m_varies = false;
};

}  // namespace whorl
