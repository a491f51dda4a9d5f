// SPDX-License-Identifier: Apache-2.0
// Nearest places for all nodes of a grid that lie close to a mesh.
#pragma once

#include "core/surface/closest_point.h"
#include "core/surface/surface_point.h"

#include <cstddef>
#include <functional>

namespace whorl {

/// Nodes at origin + (x, y, z) spacing, x running fastest.
struct NodeGrid {
    glm::vec3 origin{0.0f};
    float spacing = 1.0f;
    int size[3] = {0, 0, 0};

    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size[0]) +
               static_cast<std::size_t>(x);
    }
    std::size_t count() const { return index(0, 0, size[2]); }
    Vec3d node(int x, int y, int z) const { return Vec3d(origin) + Vec3d(x, y, z) * static_cast<double>(spacing); }
};

/// A node and its nearest place; ties go to the lowest triangle.
struct NodeHit {
    std::size_t index;
    Vec3d position;
    SurfacePoint nearest;
    float distance;
};

/// Calls `visit` once for every node within `band` of the mesh, from several threads and in no fixed order; what it is
/// called with never depends on them. Much faster than one query a node: nodes of a cell share the few triangles that
/// can be nearest to any of them.
void searchBand(const SurfaceMesh& mesh, const NodeGrid& grid, float band,
                const std::function<void(const NodeHit&)>& visit);

}  // namespace whorl
