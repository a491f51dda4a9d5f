// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace whorl::samples {

/// A flat island of triangles; packing moves, turns and scales its points into the unit square.
struct Island {
    std::vector<glm::dvec2> points;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// All islands get the same scale, the largest at which they fit with a margin of at least 1/160 between them.
void packIslands(std::vector<Island>& islands);

}  // namespace whorl::samples
