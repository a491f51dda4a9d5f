// SPDX-License-Identifier: Apache-2.0
// Kernels that give hairs their shape. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"
#include "core/hair/hair_traits.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Hairs of one group on their way from guides to curves. Vertices in lanes; `stride` is a multiple of 16.
struct ShapeArrays {
    // Guides: see GuideShapes.
    const float* guideX;
    const float* guideY;
    const float* guideZ;
    const std::size_t* firstOfGuide;
    // Hairs: see Bindings.
    std::size_t perHair;
    const std::uint8_t* counts;
    const std::uint32_t* guides;
    const float* matrices;
    const HairTraits* traits;
    // The hairs wanted, and for each of them its root on the skin, displaced.
    const std::uint32_t* hairs;
    const float* roots;
    // The group.
    std::size_t stride;
    const float* along;  ///< curve parameter of each vertex, 0 to 1
    const float* ease;   ///< 0 at the root, 1 from a quarter on: what noise is faded in by
    float kinkOffset[3];
    // Out: vertex v of the i-th wanted hair at [i * stride + v].
    float* x;
    float* y;
    float* z;
};

/// Sixteen hairs in lanes: coordinate of vertex v of lane l at [v * 16 + l].
struct FrameArrays {
    const float* x;
    const float* y;
    const float* z;
    const float* surfaceX;  ///< normal of the skin, one a lane
    const float* surfaceY;
    const float* surfaceZ;
    std::size_t vertices;  ///< rows to frame; one row more is read
    float* normalX;
    float* normalY;
    float* normalZ;
};

#define WHORL_SHAPE_KERNELS(level)                                                                \
    namespace level {                                                                             \
    /* Interpolation, scale, kink and frizz of hairs [begin, end) of the wanted ones. */          \
    void shapeHairs(const ShapeArrays& arrays, std::size_t begin, std::size_t end);               \
    /* Unit normals by double reflection (Wang et al. 2008), the first from the skin's normal. */ \
    void frameHairs(const FrameArrays& arrays);                                                   \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_SHAPE_KERNELS)
#undef WHORL_SHAPE_KERNELS

}  // namespace whorl
