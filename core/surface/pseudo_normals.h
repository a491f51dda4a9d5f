// SPDX-License-Identifier: Apache-2.0
// Which side of a mesh a point is on, from the feature that is nearest to it.
#pragma once

#include "core/surface/closest_point.h"
#include "core/surface/surface_point.h"

#include <vector>

namespace whorl {

/// Angle-weighted pseudo-normals of faces, edges and vertices (Baerentzen and Aanaes, "Signed Distance Computation
/// Using the Angle Weighted Pseudonormal", 2005), made robust to meshes from anywhere:
/// - vertices at equal positions count as one, so that a seam is not a border;
/// - edges and vertices on a border have no inside: beyond the rim of an open mesh everything is outside;
/// - two faces back to back cancel: a sheet drawn from both sides has no inside;
/// - edges of many faces sum all of them; faces without area add nothing.
/// Immutable; any thread may ask.
class PseudoNormals {
public:
    explicit PseudoNormals(const SurfaceMesh& mesh);

    /// True when `position` is behind the surface, `nearest` being its nearest place.
    bool inside(const Vec3d& position, const SurfacePoint& nearest) const;

private:
    const SurfaceMesh& m_mesh;
    std::vector<std::uint32_t> m_vertexOf;  // first vertex at the same position
    std::vector<glm::vec3> m_faces;
    std::vector<glm::vec3> m_edges;  // three a triangle: from corner k to corner k + 1
    std::vector<glm::vec3> m_vertices;
};

}  // namespace whorl
