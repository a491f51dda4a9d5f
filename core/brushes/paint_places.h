// SPDX-License-Identifier: Apache-2.0
// Where the texels of maps of one shape lie on a mesh: what does not change from stroke to stroke.
#pragma once

#include "core/brushes/paint_tile.h"
#include "core/surface/surface.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace whorl {

/// Finds the tiles of a map near a place on the mesh, and makes the places of a tile's texels when a stroke first
/// reaches it. Any thread may ask.
class PaintPlaces {
public:
    static constexpr int border = 5;

    /// Those that the surface keeps if they are for maps of this size and direction, otherwise new ones, which it keeps
    /// from now on. A new shape of map replaces the old one; so does reaching `mostBytes`.
    static std::shared_ptr<PaintPlaces> of(const Surface& surface, const Map& shape);
    static constexpr std::size_t mostBytes = std::size_t{256} << 20;

    PaintPlaces(Cow<SurfaceMesh> mesh, const Map& shape);

    std::size_t tileCount() const { return m_tiles.size(); }
    /// The tiles that have texels (or border texels) of triangles within the ball, ascending and each once. `wanted`:
    /// memory to use again, all zero or empty.
    void findTiles(const glm::vec3& centre, float radius, std::vector<std::uint8_t>& wanted,
                   std::vector<std::size_t>& tiles) const;
    /// Made at the first call.
    const PaintTile& tile(std::size_t index);
    /// Memory of all tiles made so far.
    std::size_t bytes() const;

private:
    struct Slot {
        std::once_flag once;
        std::atomic<std::size_t> bytes{0};
        PaintTile tile;
    };

    template <class Visit>
    void forTilesOf(const TexelBox& box, Visit&& visit) const;

    Cow<SurfaceMesh> m_mesh;
    Map m_shape;  // without texels of its own
    int m_columns;
    int m_rows;
    std::vector<TexelBox> m_boxes;
    std::vector<BoundingBall> m_blocks;  // around each few triangles
    // Triangles of tile i, ascending: m_tileTriangles[m_firstOfTile[i]] on; one may come twice.
    std::vector<std::size_t> m_firstOfTile;
    std::vector<std::uint32_t> m_tileTriangles;
    std::vector<std::uint32_t> m_wide;  // may be in any tile
    std::vector<Slot> m_tiles;
};

}  // namespace whorl
