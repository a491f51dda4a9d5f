// SPDX-License-Identifier: Apache-2.0
// How near and how far many discs are from one point: the inner loop of searchBand.
#pragma once

#include "core/base/simd.h"

#include <cstddef>

namespace whorl {

/// Discs in separate arrays. A normal of zero makes a ball of a disc.
struct DiscArrays {
    const float* x;
    const float* y;
    const float* z;
    const float* radius;
    const float* normalX;
    const float* normalY;
    const float* normalZ;
};

/// For discs [0, count): squared distances from (x, y, z) that no place of the disc is below (`low`) and above
/// (`high`).
#define WHORL_DISC_RANGES(level)                                                                                     \
    namespace level {                                                                                                \
    void discRanges(const DiscArrays& discs, std::size_t count, float x, float y, float z, float* low, float* high); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_DISC_RANGES)
#undef WHORL_DISC_RANGES

}  // namespace whorl
