// SPDX-License-Identifier: Apache-2.0
// Cover and colour of texels of hair texture. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstdint>

namespace whorl {

/// Up to 256 texels; all values 0 to 255.
struct LicCoverPixels {
    int count;
    const std::uint8_t* ranks;  ///< 256: share of hairs that rank below, by their noise
    const std::uint8_t* hair;   ///< the convolved noise that tells hairs apart
    const std::uint8_t* density;
    const std::uint8_t* reaching;  ///< share of hairs that reach this near to the border
    const std::uint8_t* opacity;
    std::uint8_t* rank;   ///< out
    std::uint8_t* cover;  ///< out; may be null
};

/// How hairs of each rank differ from the colour of the place: mixed with `mutant` by `share`, then turned about the
/// grey axis and brightened by a matrix of which this is the first row; in the others it is turned on.
struct LicVariations {
    float mutant[3]{0.0f, 0.0f, 0.0f};
    float share[256]{};
    float turn[3][256]{};
};

/// Up to 256 texels.
struct LicColourPixels {
    int count;
    const LicVariations* variations;
    const std::uint32_t* encoded;  ///< 4096: a byte of sRGB for linear numbers from 0 to 1
    const std::uint8_t* rank;
    const float* place[3];   ///< linear red, green, blue
    std::uint32_t* colours;  ///< out: red, green * 256, blue * 65536
};

#define WHORL_LIC_PIXELS_KERNELS(level)             \
    namespace level {                               \
    void licCoverPixels(const LicCoverPixels& p);   \
    void licColourPixels(const LicColourPixels& p); \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_LIC_PIXELS_KERNELS)
#undef WHORL_LIC_PIXELS_KERNELS

}  // namespace whorl
