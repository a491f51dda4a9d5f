// SPDX-License-Identifier: Apache-2.0
// Where the sampler placed more or fewer roots than the density asked for, triangle by triangle.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/sampling/root_sampler.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace whorl {

/// Hairs of each triangle of the mesh. The sums of both are equal (but for roots on no triangle).
struct HeatMap {
    std::vector<float> asked;   ///< share of what the density asks for, times the number of roots
    std::vector<float> placed;  ///< roots
};

/// Counts `roots` against what `sampler` (of the same mesh) asks for; then `passes` times each triangle gives half of
/// its counts to its neighbours across edges, a sixth to each (what has no neighbour keeps its share): a triangle alone
/// holds too few roots to compare. Sums stay. Fails only when cancelled.
Result<HeatMap> heatMap(const SurfaceMesh& mesh, const RootSampler& sampler, std::span<const SurfacePoint> roots,
                        int passes, Progress& progress);

/// Linear colour of `placed` roots where `asked` were asked for: white where they agree, blue where half or fewer were
/// placed, red from twice as many on; grey where neither is (below a hundredth of a hair).
glm::vec3 heatColour(float asked, float placed);

}  // namespace whorl
