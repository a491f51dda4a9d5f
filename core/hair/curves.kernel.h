// SPDX-License-Identifier: Apache-2.0
// Kernels that bring hairs into lanes and, finished, into the arrays of Strands. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"
#include "core/hair/hair_traits.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Sixteen hairs one after another to hairs in lanes: vertex v of lane l from [l * stride + v] to [v * 16 + l].
struct LaneArrays {
    const float* hairs[3];
    std::size_t stride;  ///< a multiple of 16; so many rows are written
    float* rows[3];
};

/// Vectors of hairs in lanes to three floats a vertex.
struct StoreArrays {
    std::size_t count;              ///< lanes in use
    const float* rows[3];           ///< at least up to the next multiple of four of the most vertices
    const std::uint32_t* vertices;  ///< one a lane
    float* const* out;              ///< where the first vertex of each lane goes
    bool past;                      ///< past the caches
};

/// Widths and colours of hairs and of the members of their strands, which follow each other and are alike.
struct LookArrays {
    std::size_t count;
    std::size_t members;              ///< 1: single hairs
    const HairTraits* const* traits;  ///< one a hair
    const std::uint32_t* vertices;    ///< at least 1
    const float* last;                ///< curve parameter of the last vertex
    const float* along;               ///< of the others
    float* const* widths;             ///< where those of each hair go
    float* const* colours;            ///< four a vertex
    bool past;
};

#define WHORL_CURVE_KERNELS(level)                \
    namespace level {                             \
    void hairsToLanes(const LaneArrays& arrays);  \
    void storeVectors(const StoreArrays& arrays); \
    void lookHairs(const LookArrays& arrays);     \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_CURVE_KERNELS)
#undef WHORL_CURVE_KERNELS

}  // namespace whorl
