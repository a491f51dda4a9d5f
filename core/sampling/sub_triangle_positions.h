// SPDX-License-Identifier: Apache-2.0
// Where the sub-triangles of a 1:4 subdivision lie: the shared position table of seed 000 (Sik, section 3.1, figure 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace whorl {

/// A sub-triangle in the (u, v) of its mesh triangle. All of them are like the mesh triangle, either upright
/// (size > 0) or turned by half a turn (size < 0), so its corners are (u, v), (u + size, v) and (u, v + size).
struct SubTrianglePlace {
    float u = 0.0f;
    float v = 0.0f;
    float size = 1.0f;

    /// Children 0, 1, 2 keep the first, second, third corner, 3 is the middle one.
    constexpr SubTrianglePlace child(unsigned j) const {
        const float half = 0.5f * size;
        switch (j) {
            case 0:
                return {u, v, half};
            case 1:
                return {u + half, v, half};
            case 2:
                return {u, v + half, half};
            default:
                return {u + half, v + half, -half};
        }
    }
    constexpr float barycentreU() const { return u + size * (1.0f / 3.0f); }
    constexpr float barycentreV() const { return v + size * (1.0f / 3.0f); }
};

/// Position index of the undivided triangle.
inline constexpr std::uint32_t wholeTriangle = ~0u;
/// Deepest subdivision that the table offers.
inline constexpr int deepestSubdivision = 10;

/// Index of child j: i = 4 (parent + 1) + j. The children of the whole triangle are 0 to 3.
constexpr std::uint32_t childPosition(std::uint32_t parent, unsigned j) {
    return 4 * (parent + 1) + j;
}

/// Subdivisions that lead to a position; 0 for the whole triangle.
constexpr int depthOfPosition(std::uint32_t position) {
    int depth = 0;
    for (; position != wholeTriangle; position = position / 4 - 1) ++depth;
    return depth;
}

/// Places of all positions down to `depth` (0 to deepestSubdivision). Made at the first call, then shared; any thread.
const std::vector<SubTrianglePlace>& subTrianglePlaces(int depth);

}  // namespace whorl
