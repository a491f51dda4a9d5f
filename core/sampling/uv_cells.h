// SPDX-License-Identifier: Apache-2.0
// Which triangles lie on a place of the UV square.
#pragma once

#include "core/model/map_changes.h"
#include "core/model/surface_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// A list of triangles by the cells of TouchedUvs that they lie on. Immutable; any thread.
class UvCells {
public:
    UvCells(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles);

    /// Places in the list, ascending, of all triangles that a map may be sampled on at touched UVs.
    std::vector<std::uint32_t> under(const TouchedUvs& touched) const;
    std::size_t memoryBytes() const;

private:
    struct Wide {
        std::uint32_t place;
        int column, row, columns, rows;
    };
    std::vector<std::uint32_t> m_first;   // by cell, one more at the end
    std::vector<std::uint32_t> m_places;  // of each cell
    std::vector<Wide> m_wide;             // what lies on more than a few cells
};

}  // namespace whorl
