// SPDX-License-Identifier: Apache-2.0
// Which places on the mesh the texels of one tile of a map stand for.
#pragma once

#include "core/model/map.h"
#include "core/model/surface_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

struct BoundingBall {
    glm::vec3 centre{0.0f};
    float radius = 0.0f;  ///< metres
};
BoundingBall ballOf(const SurfaceMesh& mesh, std::uint32_t triangle);

/// Texels that a triangle may cover, ends included, shifted by whole maps so that x0 and y0 lie inside. x1 < x0: none
/// (UVs that are not finite, or that span more than two whole maps).
struct TexelBox {
    std::int32_t x0 = 0;
    std::int32_t y0 = 0;
    std::int32_t x1 = -1;
    std::int32_t y1 = -1;
};
TexelBox texelBox(const SurfaceMesh& mesh, const Map& map, std::uint32_t triangle);

struct PaintTile {
    struct Sample {
        glm::vec3 position;   ///< on the mesh
        std::uint16_t texel;  ///< y * 64 + x in the tile
    };
    struct Triangle {
        glm::vec3 normal;
        BoundingBall ball;
        std::uint32_t first = 0;  ///< its samples are [first, last)
        std::uint32_t last = 0;
    };
    std::vector<Triangle> triangles;
    std::vector<Sample> samples;
};

/// Every texel centre of the tile with each triangle that covers it; texels up to `border` texels beyond a chart with
/// the nearest triangle there. `boxes`: texelBox of every triangle; `triangles`: all that come within the border of the
/// tile, ascending. Any thread.
PaintTile buildTile(const SurfaceMesh& mesh, const Map& map, std::span<const TexelBox> boxes,
                    std::span<const std::uint32_t> triangles, int column, int row, int border);

}  // namespace whorl
