// SPDX-License-Identifier: Apache-2.0
// Shortening and lengthening a curve along itself.
#pragma once

#include "core/brushes/screen.h"

#include <glm/vec3.hpp>

#include <span>

namespace whorl {

/// The shortest guide that cutting leaves: a two-hundredth of the mesh's size, metres.
float stubLength(const Surface& surface);
/// The longest that growing makes: four times the mesh's size, metres.
float longestLength(const Surface& surface);

/// Writes to `out` the curve `from` cut to `length` or, where that is longer, drawn out straight at its tip; `out` has
/// the same number of points, equally spaced. `out` must not overlap `from`.
void withLength(std::span<const glm::vec3> from, float length, std::span<glm::vec3> out);

/// Metres along the curve to the first place inside the brush; nothing when there is none.
std::optional<float> firstInside(const BrushArea& area, std::span<const glm::vec3> points);

}  // namespace whorl
