// SPDX-License-Identifier: Apache-2.0
// Sums a volume of hair along the light; see core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstdint>

namespace whorl {

/// Cells before a place whose hair may as well lie behind it: a shadow cannot be finer than its grid.
constexpr int nearVoxels = 3;

}  // namespace whorl

/// Rows [yBegin, yEnd) of every slice of a cube of 128 cells a side, x fastest, z with the light: hair before the
/// centre of each cell, spread one cell to both sides in x and y, times `texelsOfCount`, at most 65535. The first and
/// last x are 0. Of that, the hair of the last nearVoxels counts as n / (1 + n * softness).
#define WHORL_KERNEL(level)                                                                                 \
    namespace whorl::level {                                                                                \
    void sumVoxels(const std::uint32_t* counts, std::uint16_t* texels, float texelsOfCount, float softness, \
                   int yBegin, int yEnd);                                                                   \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_KERNEL)
#undef WHORL_KERNEL
