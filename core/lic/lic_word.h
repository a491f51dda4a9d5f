// SPDX-License-Identifier: Apache-2.0
// What a texel tells a streamline that comes by. Plain numbers, so that kernels may read them.
#pragma once

#include <cstdint>

// A word: 12 bits step to the right, 12 bits step down (two's complement, 1/512 texel), 3 bits of noise that
// tells one hair from another, 5 bits of noise for the light. A step to the right of -2048 marks a special texel: the
// next 12 bits are its number among those of the same 1024 texels, or say that streamlines end.

namespace whorl::lic_word {

inline constexpr int one = 512;  ///< a texel
inline constexpr std::uint32_t mark = 0x800u << 20;
inline constexpr std::uint32_t end = mark | (0xfffu << 8);
inline constexpr std::uint32_t noise = 0xffu;
inline constexpr int lightMost = 31, hairMost = 7;
inline constexpr int segment = 1024;    ///< texels whose special ones are counted together
inline constexpr int weightSum = 2000;  ///< of a kernel: sums of noise fit into 16 bits

/// A special texel.
struct Special {
    std::int32_t stepX, stepY;
    std::uint32_t parted;   ///< bit (y + 2) * 5 + x + 2: a parting lies between here and the texel that far away, or
                            ///< that far from where this one jumps to
    std::uint32_t jumps;    ///< the place is beyond a seam: before the step streamlines go on there
    std::int32_t toX, toY;  ///< where the middle of the texel goes
    float turn[4];          ///< rows; of what lies around the middle
};

}  // namespace whorl::lic_word
