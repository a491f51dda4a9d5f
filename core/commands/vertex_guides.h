// SPDX-License-Identifier: Apache-2.0
// Guides from the mesh itself, and smooth curves through few points.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/groom.h"
#include "core/sampling/triangle_density.h"
#include "core/surface/surface.h"

#include <span>
#include <string>
#include <vector>

namespace whorl {

struct VertexGuides {
    float length = 0.0f;          ///< metres where the map is white; 0: a tenth of the mesh's size
    float perSquareMetre = 0.0f;  ///< wanted at density 1; 0: vertices only
    TriangleDensity density = TriangleDensity::Corners;  ///< how it is measured on a triangle
    std::string lengthMap{};  ///< a map of the groom, or empty; guides are as long as it is bright
};

/// Replaces all guides by one on each vertex where hair grows (seeds 001 and 003). Triangles where density x area x
/// perSquareMetre is above 1 get one more at a random place inside, and so do the three triangles that it makes, until
/// none is too large (seed 001). Guides stand along the normal; their segments grow longer from root to tip, the k-th
/// is k times as long as the first (seed 003). Those of no length are left out. Fails when there is no place, no such
/// map, or there would be more than a million.
Result<void> placeGuidesOnVertices(Groom& groom, const Surface& surface, const VertexGuides& options,
                                   Progress& progress);

/// Gives a group another number of segments. Guides become smooth curves through their points (cubic Bezier pieces with
/// one tangent at a point, seed 003) and are divided evenly along them; roots and tips stay.
Result<void> tessellateGuides(Groom& groom, int group, int segments);

/// `segments` pieces of equal length along the smooth curve through `points` (at least two).
std::vector<glm::vec3> tessellated(std::span<const glm::vec3> points, int segments);

}  // namespace whorl
