// SPDX-License-Identifier: Apache-2.0
// Kernels that bind hairs to guides. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>

namespace whorl {

inline constexpr std::size_t guideLanes = 16;

/// Roots of guides; `count` is a multiple of guideLanes.
struct GuideColumns {
    const float* x;
    const float* y;
    const float* z;
    const float* normalX;
    const float* normalY;
    const float* normalZ;
    std::size_t count;
};

#define WHORL_BINDING_KERNELS(level)                                                       \
    namespace level {                                                                      \
    /* rootDistanceSquared of a root (position and normal, 6 numbers) to every guide. */   \
    void distancesToGuides(const GuideColumns& guides, const float* root, float* squared); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_BINDING_KERNELS)
#undef WHORL_BINDING_KERNELS

}  // namespace whorl
