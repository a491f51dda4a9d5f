// SPDX-License-Identifier: Apache-2.0
// Thin ribbons drawn by the processor: without a graphics card that is many times faster than drawing triangles.
#pragma once

#include "render/passes/strand_raster.kernel.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace whorl {

/// Draws batches of ribbons, one over the other, into a layer that is laid over a picture. Tiles of the picture are
/// drawn in parallel; the result does not depend on the number of threads.
class StrandRaster {
public:
    /// Texels hold colours up to this; brighter ones are clipped.
    static constexpr float brightest = 8.0f;

    /// Starts a layer. `depth`: size.x * size.y values, 0 near to 1 far, rows from the bottom; must live until `draw`.
    void begin(glm::ivec2 size, std::span<const float> depth, float fringe);
    /// Segments from points[i] to points[i + 1] for each i of `segments`, far ones first. Both must live until `draw`.
    void add(std::span<const RasterPoint> points, std::span<const std::uint32_t> segments);
    void draw();

    /// After `draw`: the rectangle that was drawn into (x, y, width, height), 0 wide when nothing was; and the first of
    /// its texels in rows of size.x: red, green, blue (times 65535 / brightest) and opacity (times 65535 / brightest)
    /// of the layer, multiplied by opacity.
    struct Region {
        int x = 0, y = 0, width = 0, height = 0;
    };
    Region region() const { return m_region; }
    const std::uint16_t* texels() const;

private:
    struct Batch {
        std::span<const RasterPoint> points;
        std::vector<std::uint32_t> segments;   // tile by tile
        std::vector<std::uint32_t> tileStart;  // of each tile, and the end
    };
    void sort(std::span<const std::uint32_t> segments, Batch& batch) const;
    glm::ivec2 tiles() const;

    glm::ivec2 m_size{0};
    std::span<const float> m_depth;
    float m_fringe = 0.5f;
    std::vector<Batch> m_batches;
    std::vector<std::uint16_t> m_texels;
    Region m_region;
};

}  // namespace whorl
