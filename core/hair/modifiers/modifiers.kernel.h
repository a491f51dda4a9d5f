// SPDX-License-Identifier: Apache-2.0
// Kernels of the modifiers, one source each. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Sixteen hairs of one group in lanes: coordinate of vertex v of lane l at [v * 16 + l]. Number r of the modifier (see
/// ModifierStep::numbers) of lane l at [r * 16 + l].
struct ModifierArrays {
    static constexpr std::size_t lanes = 16;
    static constexpr std::size_t randomRows = 4;
    static constexpr std::size_t scratchRows = 4;  ///< one row: vertices x 16 floats

    std::size_t vertices;  ///< at least 2
    float* x;              ///< moved by the modifier; the first vertex stays
    float* y;
    float* z;
    float* scratch;
    const float* along;    ///< curve parameter of each vertex, 0 to 1
    const float* ease;     ///< 0 at the root, 1 from a quarter on
    const float* numbers;  ///< row 1 is the amount; a lane whose amount is 0 keeps its bytes
    const float* random;   ///< rows of numbers in 0 to 1, a hair's or a lock's own
    float offset[3];       ///< where noise starts; depends on the seeds
    // Clump only: curve of centre c at [centreFirst[lane] + v]; weight 0 where a lane has no centre, else 1.
    const float* centreX;
    const float* centreY;
    const float* centreZ;
    const std::uint32_t* centreFirst;
    const float* centreWeight;
    // Bend only: root width of a lane over that of its group.
    const float* thickness;
};

#define WHORL_MODIFIER_KERNELS(level)            \
    namespace level {                            \
    void clumpHairs(const ModifierArrays&);      \
    void curlHairs(const ModifierArrays&);       \
    void noiseHairs(const ModifierArrays&);      \
    void bendHairs(const ModifierArrays&);       \
    void lengthHairs(const ModifierArrays&);     \
    void smoothHairs(const ModifierArrays&);     \
    void straightenHairs(const ModifierArrays&); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_MODIFIER_KERNELS)
#undef WHORL_MODIFIER_KERNELS

}  // namespace whorl
