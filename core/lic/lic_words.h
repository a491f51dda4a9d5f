// SPDX-License-Identifier: Apache-2.0
// The words of all texels: where the field leads on, and the noise.
#pragma once

#include "core/field/direction_field.h"
#include "core/lic/convolve.kernel.h"
#include "core/lic/lic_plan.h"
#include "core/surface/parting_index.h"

#include <span>
#include <vector>

namespace whorl {

/// Refers to the atlas, which must outlive it.
class LicWords {
public:
    explicit LicWords(const TexelAtlas& atlas);

    /// All steps have to be set again afterwards, and the noise too.
    void setPartings(std::span<const Parting> partings);
    /// Steps of the marked blocks (one a block).
    void setSteps(const DirectionField& field, const LicPlan& plan, std::span<const std::uint8_t> blocks);
    /// `grainMap`: may be null.
    void setNoise(const LicPlan& plan, std::uint32_t seed, const Map* grainMap, std::span<const std::uint8_t> blocks);
    ConvolveArrays arrays(const LicPlan& plan) const;
    /// Texels that a step in one of the marked blocks (one a block) leads on at most, to the right or down.
    float longestStep(std::span<const std::uint8_t> blocks) const;

private:
    void findParted();
    void stepsOfBlock(const DirectionField& field, const LicPlan& plan, std::size_t block);
    void noiseOfBlock(const LicPlan& plan, std::uint32_t seed, const Map* grainMap, std::size_t block);
    int setStep(std::uint32_t slot, glm::vec2 step, float longest);

    const TexelAtlas& m_atlas;
    PlainVector<std::uint32_t> m_words;
    PartingIndex m_partings;
    std::vector<std::uint8_t> m_nearParting;  // one a triangle; empty: none is
    std::vector<std::uint8_t> m_special;      // one a slot
    std::vector<int> m_longest;               // one a block: of its steps, 1/512 texel
    std::vector<std::uint32_t> m_firstSpecial;
    std::vector<std::uint32_t> m_specialTexels;
    std::vector<lic_word::Special> m_specials;
};

}  // namespace whorl
