// SPDX-License-Identifier: Apache-2.0
// The hairs of a strand around their base hair. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Sixteen base hairs in lanes, coordinate of vertex v of lane l at [v * 16 + l]: a member is
/// base + across * U + up * V + lift * W.
struct MemberArrays {
    static constexpr std::size_t lanes = 16;
    std::size_t vertices;
    // In: the base hair, before its cut, and its normals.
    const float* x;
    const float* y;
    const float* z;
    const float* normalX;
    const float* normalY;
    const float* normalZ;
    const float* surfaceX;  ///< normal of the skin, one a lane
    const float* surfaceY;
    const float* surfaceZ;
    const float* along;  ///< one a vertex
    const float* ease;
    // In, one a lane.
    const float* rootSplay;
    const float* centreSplay;
    const float* tipSplay;
    const float* twist;   ///< whole turns from root to tip
    const float* offset;  ///< of the tip along the normal
    // Out, three coordinates each.
    float* u[3];
    float* v[3];
    float* w[3];
};

/// Places of the members of one strand, a member a lane: see memberPlace.
struct PlaceArrays {
    std::uint32_t seed;
    std::uint32_t hair;             ///< its id
    std::uint32_t count;            ///< hairs of the strand
    const std::uint32_t* channels;  ///< of radius, turn and lift
    float randomise;
    float aspect;
    float strandTurn;  ///< random number of the strand
    // Out: up to the next multiple of 16.
    float* across;
    float* up;
    float* lift;
};

#define WHORL_MEMBER_KERNELS(level)               \
    namespace level {                             \
    /* U, V and W of base hairs. */               \
    void strandAxes(const MemberArrays& arrays);  \
    void memberPlaces(const PlaceArrays& arrays); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_MEMBER_KERNELS)
#undef WHORL_MEMBER_KERNELS

}  // namespace whorl
