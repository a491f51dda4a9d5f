// SPDX-License-Identifier: Apache-2.0
// Catmull-Rom curves of strands: points, tangents, exact boxes.
#pragma once

#include "core/surface/surface_point.h"

#include <glm/vec3.hpp>

#include <span>

// A strand has one piece between each two neighbouring vertices. The first and the last vertex are repeated as the
// missing neighbours of the end pieces, as renderers do; the curve starts and ends there with the direction of the
// first and the last chord.

namespace whorl {

/// Uniform Catmull-Rom at t (0 to 1) between b and c.
glm::vec3 catmullRom(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, float t);

/// Point of the strand at `parameter` from 0 to points.size() - 1. At least one point.
glm::vec3 strandPoint(std::span<const glm::vec3> points, float parameter);

/// Unit direction of the curve at a vertex; `fallback` where neighbouring vertices coincide.
glm::vec3 strandTangent(std::span<const glm::vec3> points, std::size_t vertex, const glm::vec3& fallback);

/// Adds the exact box of the curve swept by a ball whose diameter goes from width to width, linearly or along the same
/// kind of curve: renderers do either. A few roundings wide of it, so that points worked out in floats are inside.
void addStrandBounds(std::span<const glm::vec3> points, std::span<const float> widths, Bounds& bounds);
Bounds strandBounds(std::span<const glm::vec3> points, std::span<const float> widths);

}  // namespace whorl
