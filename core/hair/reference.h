// SPDX-License-Identifier: Apache-2.0
// The generator written for reading: one hair after another, nothing kept, no lanes. Tests and benchmarks compare the
// fast one with it.
#pragma once

#include "core/hair/generate.h"
#include "core/hair/guide_index.h"
#include "core/hair/outside.h"
#include "core/hair/traits.h"

#include <string>

namespace whorl {

/// The same hair as Generator::generate, up to rounding, on one thread. `surface` is that of the groom's mesh.
Result<Strands> generateReference(const Groom& groom, std::shared_ptr<const Surface> surface,
                                  const GenerateOptions& options, Progress& progress);

/// The part of `r` across the unit vector `tangent`, unit length; across an axis where less than `least` of its square
/// is left.
glm::vec3 acrossTangent(const glm::vec3& r, const glm::vec3& tangent, float least);

/// The curve of a hair after one step of its making.
struct HairStage {
    std::string name;
    std::vector<glm::vec3> points;
};

/// Every step of one hair, in order, from the guides to the cut; none when no guide reaches it. Of a strand, its base
/// hair. `skin` may be null.
std::vector<HairStage> referenceStages(const Groom& groom, const GuideIndex& index, const HairRoot& root,
                                       const TraitLookup& lookup, const SkinGuard* skin, Progress& progress);

/// Normals of a strand by double reflection (Wang et al. 2008, "Computation of Rotation Minimizing Frames"), one a
/// vertex. The first is the part of the skin's normal across the hair, or an axis where the hair stands upright.
std::vector<glm::vec3> referenceNormals(std::span<const glm::vec3> points, const glm::vec3& surfaceNormal);

}  // namespace whorl
