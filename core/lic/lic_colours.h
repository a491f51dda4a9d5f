// SPDX-License-Identifier: Apache-2.0
// Colour of the drawn hair, from the colours of the groups.
#pragma once

#include "core/model/groom.h"
#include "core/sampling/density.h"

#include <array>
#include <cstdint>
#include <vector>

namespace whorl {

using LicColour = std::array<std::uint8_t, 3>;  ///< sRGB

/// Refers to the groom, which must outlive it. Any thread may ask.
class LicColours {
public:
    explicit LicColours(const Groom& groom);

    /// True when hairs of one place differ in colour.
    bool varies() const { return m_varies; }
    /// `rank`: 0 to 1, the same along a drawn hair.
    LicColour at(glm::vec2 uv, float rank) const;

    /// Names of maps that colours depend on.
    static std::vector<std::string> mapNames(const Groom& groom);

private:
    struct Tint {
        glm::vec3 value{0.0f};
        const Map* map = nullptr;
        glm::vec3 at(glm::vec2 uv) const;
    };
    struct Share {
        float value = 0.0f;
        const Map* map = nullptr;
        float at(glm::vec2 uv) const;
    };
    struct Entry {
        Tint root, tip;
        Share hue, value, mutants;
        glm::vec3 mutant{0.0f};
        bool mapped = false;
        std::vector<LicColour> ranks;  ///< without maps: 256 of them
    };
    LicColour evaluate(const Entry& entry, glm::vec2 uv, float rank) const;

    DensityLookup m_groups;
    std::vector<Entry> m_entries;
    float m_place;
    bool m_varies = false;
};

}  // namespace whorl
