// SPDX-License-Identifier: Apache-2.0
// What the parameters, maps and random numbers say about one hair.
#pragma once

#include "core/hair/hair_traits.h"
#include "core/hair/roots.h"
#include "core/model/groom.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Channels of randomBits that generation uses for a hair besides its root.
enum class HairChannel : std::uint32_t {
    Scale = 64,
    Hue,
    Value,
    Mutant,
    FrizzX,
    FrizzY,
    FrizzZ,
    NoiseOffset,
    MemberRadius,
    MemberTurn,
    MemberLift,
    StrandTurn,
    FrizzPlace
};

/// Finds the maps of all parameters once, then answers for any root. Refers to the groom, which must outlive it.
class TraitLookup {
public:
    /// `time`: seconds, for what is animated.
    explicit TraitLookup(const Groom& groom, float time = 0.0f);

    /// Every number is finite and inside its parameter's range, whatever the maps hold.
    HairTraits at(const HairRoot& root) const;
    /// The same for many roots. `coloursKnown`: those in `traits` are theirs already, and stay.
    void at(std::span<const HairRoot> roots, std::span<HairTraits> traits, bool coloursKnown = false) const;
    /// Those of the middle of a lock: scale and displacement without anything random, nothing else.
    HairTraits lockAt(const HairRoot& root) const;
    /// Where kink noise starts: depends on the seed only.
    glm::vec3 kinkOffset() const { return m_kinkOffset; }

private:
    struct Number {
        float value = 0.0f;
        const Map* map = nullptr;
        float most = 1.0f;
        float even = 0.0f;  ///< what it is without a map
        float limited(float number) const;
        float mapped(glm::vec2 uv) const;
        float at(glm::vec2 uv) const { return map ? mapped(uv) : even; }
    };
    struct Vector {
        glm::vec3 value{0.0f};
        const Map* map = nullptr;
        glm::vec3 even{0.0f};
        glm::vec3 mapped(glm::vec2 uv) const;
        glm::vec3 at(glm::vec2 uv) const { return map ? mapped(uv) : even; }
    };
    struct Tint {
        glm::vec3 value{0.0f};
        const Map* map = nullptr;
        glm::vec3 even{0.0f};
        glm::vec3 mapped(glm::vec2 uv) const;
        glm::vec3 at(glm::vec2 uv) const { return map ? mapped(uv) : even; }
    };
    struct Entry {
        Number cut, scale, randomScale, rootThickness, tipThickness, displacement;
        Tint rootColour, tipColour;
        glm::vec3 mutant{0.0f};
        Number rootOpacity, tipOpacity, hueVariation, valueVariation, mutants;
        Number frizzRoot, frizzTip, kinkRoot, kinkTip;
        Vector frizzFrequency, kinkFrequency;
        Number animation, speed;
        glm::vec3 direction{0.0f};  ///< unit length or zero
        bool strands = false;
        Number splay[3], twist, offset, aspect, randomise;
    };
    void setColours(const Entry& entry, const HairRoot& root, HairTraits& traits) const;
    /// Where frizz takes its noise from.
    struct FrizzPlace {
        bool wanted = false;
        float own = 0.0f;  ///< share of the hair's own random vector
        glm::vec3 at{0.0f};
    };
    FrizzPlace begin(const HairRoot& root, HairTraits& traits, bool coloursKnown) const;
    FrizzPlace frizzPlace(const Entry& entry, const HairRoot& root, HairTraits& traits) const;
    void endFrizz(const HairRoot& root, const FrizzPlace& place, HairTraits& traits) const;
    void animateFrizz(const Entry& entry, const HairRoot& root, const glm::vec3& place, float own,
                      HairTraits& traits) const;
    void setStrand(const Entry& entry, const HairRoot& root, HairTraits& traits) const;

    std::uint32_t m_seed;
    float m_time;
    glm::vec3 m_frizzOffset;
    glm::vec3 m_kinkOffset;
    std::vector<Entry> m_groups;
};

/// Makes up for hairs that a level of detail (above 0) leaves out: they cover as much together.
void widen(HairTraits& traits, float lod);

/// Where a hair of `segments` pieces ends when it is cut at `cut` (0 to 1 along its parameter).
struct CutEnd {
    std::uint32_t vertices = 0;  ///< 0: no hair; otherwise at least 2
    float parameter = 0.0f;      ///< of the last vertex, 0 to segments
};
CutEnd cutEnd(float cut, int segments);

}  // namespace whorl
