// SPDX-License-Identifier: Apache-2.0
// Placing rectangles in a square. Private to atlas.cpp.
#pragma once

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace whorl::atlas {

/// Lower left corners of rectangles in a square of side `side`, none overlapping (skyline, tallest first); nothing when
/// they do not fit. Whole texels.
std::optional<std::vector<glm::ivec2>> pack(const std::vector<glm::ivec2>& sizes, int side);

}  // namespace whorl::atlas
