// SPDX-License-Identifier: Apache-2.0
#include "core/surface/adjacency.h"

#include <algorithm>

namespace whorl {

std::vector<std::array<std::uint32_t, 3>> trianglesAcross(const SurfaceMesh& mesh) {
    struct Edge {
        std::uint64_t key;
        std::uint32_t triangle;
        std::uint32_t side;
    };
    std::vector<Edge> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][static_cast<int>(k)];
            const std::uint32_t b = mesh.triangles[t][static_cast<int>((k + 1) % 3)];
            edges.push_back({(std::uint64_t{std::min(a, b)} << 32) | std::max(a, b), t, k});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.key != b.key ? a.key < b.key : a.triangle != b.triangle ? a.triangle < b.triangle : a.side < b.side;
    });
    std::vector<std::array<std::uint32_t, 3>> across(mesh.triangles.size(), {noTriangle, noTriangle, noTriangle});
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].key == edges[i].key) ++end;
        if (end - i == 2) {
            across[edges[i].triangle][edges[i].side] = edges[i + 1].triangle;
            across[edges[i + 1].triangle][edges[i + 1].side] = edges[i].triangle;
        }
        i = end;
    }
    return across;
}

}  // namespace whorl
