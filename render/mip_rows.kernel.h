// SPDX-License-Identifier: Apache-2.0
// Halves rows of texels; see core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

/// Means of two by two texels of four bytes, rounded: `count` texels from 2 * count of the row above and below. With
/// masks (one a texel, 0 or 1; both or none) only texels of mask 1 count, and those without any become 0.
/// halveMask: 1 where any of two by two texels of a mask is; gives 1 when all of them are.
#define WHORL_KERNEL(level)                                                                               \
    namespace whorl::level {                                                                              \
    void halveRows(const std::uint32_t* above, const std::uint32_t* below, const std::uint8_t* maskAbove, \
                   const std::uint8_t* maskBelow, std::size_t count, std::uint32_t* out);                 \
    std::uint8_t halveMask(const std::uint8_t* above, const std::uint8_t* below, std::size_t count,       \
                           std::uint8_t* out);                                                            \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_KERNEL)
#undef WHORL_KERNEL
