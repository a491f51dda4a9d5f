// SPDX-License-Identifier: Apache-2.0
// The convolution: sums of noise along streamlines. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"
#include "core/lic/lic_word.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

struct ConvolveArrays {
    const std::uint32_t* words;  ///< side * side; the first one is zero
    int side;
    const std::uint32_t* firstSpecial;  ///< one for each lic_word::segment words
    const lic_word::Special* specials;
    int steps;                    ///< each way
    const std::int32_t* weights;  ///< steps + 1: that of the place itself, then along the streamline
    const std::int32_t* totals;   ///< steps + 1: sums of the weights from 1 on
};

/// 16 x 16 texels.
struct ConvolveBlock {
    int x, y;                      ///< the first
    const std::uint16_t* lengths;  ///< share of the steps' length, 1024: all of it; null: everywhere
    std::uint8_t light[256];       ///< out: 0 to 255
    std::uint8_t hair[256];
    std::uint8_t grows[256];  ///< out: 0 where streamlines end at once
    static constexpr int mostLandings = 48;
    std::uint32_t landings[mostLandings];  ///< out: blocks (row by row) in which streamlines go on beyond seams
    int onwards[mostLandings];             ///< out: steps that the longest of them has left there
    int landingCount;                      ///< one above `mostLandings`: there are more
    /// Out: texels between which every fourth place of the streamlines lies, as far as they have not gone over a seam;
    /// none where `right` is below `left`.
    int left, right, top, bottom;
    static constexpr int seen = 4;
};

#define WHORL_CONVOLVE_KERNELS(level)                                       \
    namespace level {                                                       \
    /* Zero for texels at which streamlines end. */                         \
    void convolveBlock(const ConvolveArrays& arrays, ConvolveBlock& block); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_CONVOLVE_KERNELS)
#undef WHORL_CONVOLVE_KERNELS

}  // namespace whorl
