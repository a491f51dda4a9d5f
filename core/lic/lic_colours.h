// SPDX-License-Identifier: Apache-2.0
// Colour of the drawn hair, from the colours of the groups.
#pragma once

#include "core/lic/lic_pixels.kernel.h"
#include "core/lic/texel_atlas.h"
#include "core/model/groom.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace whorl {

/// Refers to the atlas, which must outlive it.
class LicColours {
public:
    explicit LicColours(const TexelAtlas& atlas) : m_atlas(atlas) {}

    /// Colours of the groom's groups, and of the places of the marked blocks (one a block).
    void set(const Groom& groom, std::span<const std::uint8_t> blocks);
    /// True when hairs of one place differ in colour.
    bool varies() const { return m_varies; }
    /// Of the slots of block `b`: red, green * 256 and blue * 65536 of each, sRGB. `rank`: one a slot of the block, the
    /// same along a drawn hair, all equally frequent.
    void pixels(std::size_t b, const std::uint8_t* rank, std::uint32_t* colours) const;

    /// Names of maps that colours depend on.
    static std::vector<std::string> mapNames(const Groom& groom);

private:
    struct Variation {
        float turn[3]{1.0f, 0.0f, 0.0f};
        float share = 0.0f;
    };
    static Variation variation(float hue, float value, float mutants, float rank);

    const TexelAtlas& m_atlas;
    std::vector<LicVariations> m_entries;  // one a group
    std::vector<std::uint8_t> m_groups;    // one a slot; empty: there is only one
    std::vector<float> m_places[3];        // one a slot: linear red, green, blue
    std::vector<glm::vec3> m_differences;  // one a slot, hue, value and mutants; empty: as the groups have them
    bool m_varies = false;
};

}  // namespace whorl
