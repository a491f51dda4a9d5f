// SPDX-License-Identifier: Apache-2.0
// Solid white noise in cells, for many places. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

struct CellNoise {
    const float* x;
    const float* y;
    const float* z;
    const float* grain;  ///< side of a cell at each place
    float white;         ///< share of cells
    std::uint32_t seed;
    std::uint8_t* values;  ///< out: bit 0 as solidNoise, bit 1 another of even odds, bits 4 to 7 random
};

#define WHORL_NOISE_KERNELS(level)                             \
    namespace level {                                          \
    void cellNoise(const CellNoise& noise, std::size_t count); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_NOISE_KERNELS)
#undef WHORL_NOISE_KERNELS

}  // namespace whorl
