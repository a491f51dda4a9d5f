// SPDX-License-Identifier: Apache-2.0
// Grooms from files made to obey the laws of a groom (checkGroom), or refused.
#pragma once

#include "core/base/result.h"
#include "core/model/groom.h"

namespace whorl {

/// A guide as a file holds it.
struct StoredGuides {
    std::vector<std::uint32_t> ids;
    std::vector<SurfacePoint> roots;
    std::vector<std::uint8_t> groups;
    std::vector<std::uint32_t> sizes;  ///< points of each guide
    std::vector<glm::vec3> points;
    std::uint32_t nextId = 1;
};

/// Refuses indices outside and vertices that are not finite; repairs normals, UVs and parts.
Result<void> repairMesh(SurfaceMesh& mesh, std::vector<PartSettings>& settings, Problems& problems);

/// Names become unique and of allowed letters; none at all becomes one group named "hair".
void repairGroups(std::vector<Group>& groups, Problems& problems);

/// Guides of `stored` that can stand on the mesh; points that are not finite, wrong groups, repeated ids and other
/// numbers of points than the group wants are put right. The sum of `sizes` is the number of points.
GuideSet repairedGuides(const StoredGuides& stored, const SurfaceMesh& mesh, const std::vector<Group>& groups,
                        Problems& problems);

/// Leaves out points that are not on the mesh, partings that then have none to join, and those above the most; puts
/// repeated ids right.
void repairPartings(std::vector<Parting>& partings, const SurfaceMesh& mesh, Problems& problems);

/// The same for strokes, whose kinds, weights and radii come into their ranges, too.
void repairStrokes(std::vector<FieldStroke>& strokes, const SurfaceMesh& mesh, Problems& problems);

}  // namespace whorl
