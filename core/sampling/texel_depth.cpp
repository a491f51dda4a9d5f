// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/texel_depth.h"

#include "core/sampling/sub_triangle_positions.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {

int texelDepth(const SurfaceMesh& mesh, std::uint32_t triangle, int width, int height, int maxDepth) {
    const glm::dvec2 scale(width, height);
    const std::size_t corner = std::size_t{3} * triangle;
    const glm::dvec2 a = glm::dvec2(mesh.cornerUvs[corner]) * scale;
    const glm::dvec2 b = glm::dvec2(mesh.cornerUvs[corner + 1]) * scale - a;
    const glm::dvec2 c = glm::dvec2(mesh.cornerUvs[corner + 2]) * scale - a;
    const double area = 0.5 * std::abs(b.x * c.y - b.y * c.x);
    const double longest = std::sqrt(std::max({glm::dot(b, b), glm::dot(c, c), glm::dot(c - b, c - b)}));
    // A sliver has hardly any area and yet crosses many texels; the quarter keeps well-shaped triangles out of this.
    double texels = std::max(area, 0.25 * longest);
    // UVs of strangers can be huge or not numbers. Then no subdivision follows the map, so none is made.
    if (!(texels < 1e15)) return 0;
    int depth = 0;
    for (; texels > 1.0 && depth < maxDepth; ++depth) texels *= 0.25;
    return depth;
}

int allowedDepth(std::span<const std::uint8_t> depths, int maxDepth, std::uint64_t limit) {
    std::array<std::uint64_t, deepestSubdivision + 1> trianglesOfDepth{};
    for (const std::uint8_t depth : depths) ++trianglesOfDepth[depth];
    for (int allowed = maxDepth; allowed > 0; --allowed) {
        std::uint64_t total = 0;
        for (int depth = 0; depth <= deepestSubdivision; ++depth)
            total += trianglesOfDepth[static_cast<std::size_t>(depth)] << (2 * std::min(depth, allowed));
        if (total <= limit) return allowed;
    }
    return 0;
}

}  // namespace whorl
