// SPDX-License-Identifier: Apache-2.0
// The generator written for reading: one hair after another, nothing kept, no lanes. Tests and benchmarks compare the
// fast one with it.
#pragma once

#include "core/hair/generate.h"

namespace whorl {

/// The same hair as Generator::generate, up to rounding, on one thread. `surface` is that of the groom's mesh.
Result<Strands> generateReference(const Groom& groom, std::shared_ptr<const Surface> surface,
                                  const GenerateOptions& options, Progress& progress);

/// The part of `r` across the unit vector `tangent`, unit length; across an axis where less than `least` of its square
/// is left.
glm::vec3 acrossTangent(const glm::vec3& r, const glm::vec3& tangent, float least);

/// Normals of a strand by double reflection (Wang et al. 2008, "Computation of Rotation Minimizing Frames"), one a
/// vertex. The first is the part of the skin's normal across the hair, or an axis where the hair stands upright.
std::vector<glm::vec3> referenceNormals(std::span<const glm::vec3> points, const glm::vec3& surfaceNormal);

}  // namespace whorl
