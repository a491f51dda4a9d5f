// SPDX-License-Identifier: Apache-2.0
// Keeps hair out of the head.
#pragma once

#include "core/surface/distance_field.h"

#include <glm/vec3.hpp>

#include <span>

namespace whorl {

/// Distance that hair keeps from the skin once it has left its root: a part of the distance field's spacing, which is
/// about what the field can be wrong by.
float skinClearance(const DistanceField& skin);

/// Moves vertices that are inside the skin, or nearer than the clearance, outwards. `ease` (one a vertex, 0 at the
/// root, growing to 1) scales the clearance, so that hair leaves its root without a step. Vertices farther than twice
/// the clearance stay where they are, those between are eased over; the first vertex never moves. A hair that dives
/// deeper than the field reaches is laid along the skin instead, and goes on from there in its own directions.
void keepOutside(const DistanceField& skin, std::span<glm::vec3> points, std::span<const float> ease);

}  // namespace whorl
