// SPDX-License-Identifier: Apache-2.0
#include "core/hair/numbers.kernel.h"

#include "core/base/noise.h"
#include "core/base/random_lanes.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

void randomNumbers(std::uint32_t seed, const std::uint64_t* keys, std::uint32_t channel, float* out) {
    for (std::size_t i = 0; i < 16; ++i) out[i] = random_lanes::uniform(seed, keys[i], channel);
}

void noiseVectors(const float* const* places, std::size_t count, float* const* out) {
    constexpr std::size_t lanes = 16;
    for (std::size_t first = 0; first < count; first += lanes) {
        const std::size_t used = count - first < lanes ? count - first : lanes;
        float at[3][lanes] = {}, noise[3][lanes];
        for (int axis = 0; axis < 3; ++axis) __builtin_memcpy(at[axis], places[axis] + first, used * sizeof(float));
        for (std::size_t i = 0; i < lanes; ++i) {
            float vector[3];
            perlinVector(at[0][i], at[1][i], at[2][i], vector);
            noise[0][i] = vector[0];
            noise[1][i] = vector[1];
            noise[2][i] = vector[2];
        }
        for (int axis = 0; axis < 3; ++axis) __builtin_memcpy(out[axis] + first, noise[axis], used * sizeof(float));
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
