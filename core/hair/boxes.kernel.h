// SPDX-License-Identifier: Apache-2.0
// Kernels for boxes of many hairs. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Hairs that follow one another in Strands.
struct BoxArrays {
    const std::uint32_t* firstVertex;  ///< count + 1 entries
    std::size_t count;
    const float* positions;  ///< three a vertex
    const float* widths;
};

/// Two boxes without the widths.
struct HairBoxes {
    float low[3], high[3];            ///< of the vertices
    float outerLow[3], outerHigh[3];  ///< of a hull of the curves, up to rounding: Bezier points of each piece
    float widest;
};

#define WHORL_BOX_KERNELS(level)                                  \
    namespace level {                                             \
    void boxesOfHairs(const BoxArrays& arrays, HairBoxes& boxes); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_BOX_KERNELS)
#undef WHORL_BOX_KERNELS

}  // namespace whorl
