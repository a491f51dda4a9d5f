// SPDX-License-Identifier: Apache-2.0
// Draws thin ribbons into one tile of a picture; see core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// A point of a ribbon on the picture, as the shader writes it.
struct RasterPoint {
    float x, y;       ///< pixels from the bottom left
    float depth;      ///< 0 near to 1 far
    float halfWidth;  ///< pixels; negative: not in the picture
    float colour[4];  ///< linear, opacity last, not multiplied
};

/// Part of a picture.
struct RasterTile {
    int x, y, width, height;
    const float* depth;  ///< of the tile's first pixel; ribbons further away are hidden
    int depthPitch;      ///< floats from row to row
    float* pixels;       ///< width * height * 4, multiplied by opacity: drawn over
};

}  // namespace whorl

/// Draws the segments from points[i] to points[i + 1] for all i of `segments`, in their order, over the tile. The
/// pixels across a ribbon are covered as by a box of its width that is seen through a filter of 2 * `fringe` pixels.
/// `packTile` multiplies by `scale` and rounds to 16 bits in rows that lie `pitch` texels apart.
#define WHORL_KERNEL(level)                                                                                    \
    namespace whorl::level {                                                                                   \
    void rasterTile(const RasterPoint* points, const std::uint32_t* segments, std::size_t count, float fringe, \
                    const RasterTile& tile);                                                                   \
    void packTile(const RasterTile& tile, float scale, std::uint16_t* texels, std::size_t pitch);              \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_KERNEL)
#undef WHORL_KERNEL
