// SPDX-License-Identifier: Apache-2.0
// Kernels for the numbers of many hairs at once: random ones and noise. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

#define WHORL_NUMBER_KERNELS(level)                                                                       \
    namespace level {                                                                                     \
    /* randomFloat(seed, keys[i], channel), 16 of them. */                                                \
    void randomNumbers(std::uint32_t seed, const std::uint64_t* keys, std::uint32_t channel, float* out); \
    /* perlinVector at `count` places: x, y and z in three arrays, in and out. */                         \
    void noiseVectors(const float* const* places, std::size_t count, float* const* out);                  \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_NUMBER_KERNELS)
#undef WHORL_NUMBER_KERNELS

}  // namespace whorl
