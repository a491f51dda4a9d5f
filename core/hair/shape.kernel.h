// SPDX-License-Identifier: Apache-2.0
// Kernels that give hairs their shape. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// What sixteen hairs of one group are made of, one a lane.
struct HairLanes {
    static constexpr std::size_t lanes = 16;

    float rootX[lanes], rootY[lanes], rootZ[lanes];        ///< on the skin, displaced
    float normalX[lanes], normalY[lanes], normalZ[lanes];  ///< of the skin
    float scale[lanes];
    float frizz[3][lanes];
    float frizzRoot[lanes], frizzTip[lanes];
    float kinkRoot[lanes], kinkTip[lanes];
    float kinkFrequency[3][lanes];
};

/// One guide of each of sixteen hairs.
struct TurnArrays {
    const float* guideNormals;    ///< three a guide
    const std::uint32_t* guides;  ///< one a lane
    const float* weights;
    const HairLanes* hairs;
    // Out.
    float* matrix;  ///< entry k (of nine, rows) of lane l at [k * 16 + l]
    float* cosine;  ///< between the normals; below -0.9 the entries have lost their digits
};

/// Vertices in lanes; `stride` is a multiple of 16.
struct ShapeArrays {
    // Guides: see GuideShapes.
    const float* guideX;
    const float* guideY;
    const float* guideZ;
    // Hairs.
    const HairLanes* hairs;
    std::size_t count;            ///< lanes in use
    const std::uint8_t* counts;   ///< guides of each
    const std::uint32_t* starts;  ///< where the points of guide j of lane l begin, at [j * 16 + l]
    const float* matrices;        ///< entry k of guide j of lane l at [(j * 9 + k) * 16 + l]
    // The group.
    std::size_t stride;
    const float* along;  ///< curve parameter of each vertex, 0 to 1
    const float* ease;   ///< 0 at the root, 1 from a quarter on: what noise is faded in by
    float kinkOffset[3];
    // Out: vertex v of lane l at [l * stride + v].
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
    /* weight x minimalRotation(guide's normal, hair's normal), in single precision. */           \
    void turnGuides(const TurnArrays& arrays);                                                    \
    /* Interpolation, scale, kink and frizz. */                                                   \
    void shapeHairs(const ShapeArrays& arrays);                                                   \
    /* Unit normals by double reflection (Wang et al. 2008), the first from the skin's normal. */ \
    void frameHairs(const FrameArrays& arrays);                                                   \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_SHAPE_KERNELS)
#undef WHORL_SHAPE_KERNELS

}  // namespace whorl
