// SPDX-License-Identifier: Apache-2.0
// Which hairs the skin leaves alone. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"
#include "core/surface/field_arrays.h"

#include <cstddef>

namespace whorl {

/// Sixteen hairs in lanes: coordinate of vertex v of lane l at [v * 16 + l].
struct FreeArrays {
    static constexpr std::size_t lanes = 16;
    FieldArrays field;
    const float* x;
    const float* y;
    const float* z;
    std::size_t vertices;
    const float* ease;  ///< one a vertex
    float clearance;
    float deep;  ///< a distance below minus this is a dive
    float far;   ///< and so may be a long step to a distance from this on
    // Out, one a lane.
    int* first;  ///< the first vertex that SkinGuard may have something to do with, `vertices` when there is none
    float* awayBefore;  ///< distance of the vertex before
};

#define WHORL_OUTSIDE_KERNELS(level)           \
    namespace level {                          \
    void freeOfSkin(const FreeArrays& arrays); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_OUTSIDE_KERNELS)
#undef WHORL_OUTSIDE_KERNELS

}  // namespace whorl
