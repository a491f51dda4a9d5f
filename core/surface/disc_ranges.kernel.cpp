// SPDX-License-Identifier: Apache-2.0
#include "core/surface/disc_ranges.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

float larger(float a, float b) {
    return a > b ? a : b;
}

// With one restricted parameter an array, the compiler sees that they do not overlap and makes vectors of the loop.
void rangesOf(std::size_t count, const float* __restrict discX, const float* __restrict discY,
              const float* __restrict discZ, const float* __restrict radius, const float* __restrict normalX,
              const float* __restrict normalY, const float* __restrict normalZ, float x, float y, float z,
              float* __restrict low, float* __restrict high) {
    for (std::size_t i = 0; i < count; ++i) {
        const float dx = discX[i] - x;
        const float dy = discY[i] - y;
        const float dz = discZ[i] - z;
        const float height = dx * normalX[i] + dy * normalY[i] + dz * normalZ[i];
        const float heightSquared = height * height;
        const float besideSquared = dx * dx + dy * dy + dz * dz - heightSquared;
        const float beside = __builtin_sqrtf(larger(besideSquared, 0.0f));
        const float inner = larger(beside - radius[i], 0.0f);
        const float outer = beside + radius[i];
        low[i] = heightSquared + inner * inner;
        high[i] = heightSquared + outer * outer;
    }
}

}  // namespace

void discRanges(const DiscArrays& discs, std::size_t count, float x, float y, float z, float* low, float* high) {
    rangesOf(count, discs.x, discs.y, discs.z, discs.radius, discs.normalX, discs.normalY, discs.normalZ, x, y, z, low,
             high);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
