// SPDX-License-Identifier: Apache-2.0
// The Voronoi diagram of guides, restricted to the skin.
#pragma once

#include "core/hair/guide_index.h"

#include <glm/vec3.hpp>

#include <vector>

namespace whorl {

/// The triples of guides (places in index.rootsOf(group), ascending) whose Voronoi cells meet in a point of the growing
/// skin; sorted, each once. See GuideTriangles. Clips each triangle of the mesh by the bisectors between guides as far
/// as they can reach it (Yan et al. 2009, "Isotropic remeshing with fast and exact computation of restricted Voronoi
/// diagram").
std::vector<glm::uvec3> meetingGuides(const Groom& groom, const GuideIndex& index, std::size_t group);

}  // namespace whorl
