// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/heat_map.h"

#include "core/base/parallel.h"
#include "core/surface/surface_point.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace whorl {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Triangles across the three edges of each triangle; `none` at borders and where more than two share an edge.
std::vector<std::array<std::uint32_t, 3>> neighbours(const SurfaceMesh& mesh) {
    struct Edge {
        std::uint64_t ends;
        std::uint32_t triangle, side;
    };
    std::vector<Edge> edges;
    edges.reserve(std::size_t{3} * mesh.triangleCount());
    for (std::uint32_t triangle = 0; triangle < mesh.triangleCount(); ++triangle) {
        const glm::uvec3 corners = mesh.triangles[triangle];
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint32_t a = corners[static_cast<int>(side)];
            const std::uint32_t b = corners[static_cast<int>((side + 1) % 3)];
            edges.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), triangle, side});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.ends != b.ends ? a.ends < b.ends : a.triangle * 4ull + a.side < b.triangle * 4ull + b.side;
    });
    std::vector<std::array<std::uint32_t, 3>> found(mesh.triangleCount(), {none, none, none});
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
        if (end - i == 2) {
            found[edges[i].triangle][edges[i].side] = edges[i + 1].triangle;
            found[edges[i + 1].triangle][edges[i + 1].side] = edges[i].triangle;
        }
        i = end;
    }
    return found;
}

// Gathered rather than given, so that triangles do not wait for each other: what is given across an edge is the same
// both ways.
void smooth(const std::vector<std::array<std::uint32_t, 3>>& around, std::vector<float>& values) {
    std::vector<float> after(values.size());
    parallelFor(values.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            float sum = 0.5f * values[i];
            for (const std::uint32_t other : around[i]) sum += values[other == none ? i : other] / 6.0f;
            after[i] = sum;
        }
    });
    values.swap(after);
}

}  // namespace

Result<HeatMap> heatMap(const SurfaceMesh& mesh, const RootSampler& sampler, std::span<const SurfacePoint> roots,
                        int passes, Progress& progress) {
    HeatMap map;
    const std::vector<double> shares = sampler.sharesByTriangle(mesh.triangleCount());
    map.asked.assign(mesh.triangleCount(), 0.0f);
    map.placed.assign(mesh.triangleCount(), 0.0f);
    std::size_t counted = 0;
    for (const SurfacePoint& root : roots) {
        if (root.triangle >= mesh.triangleCount()) continue;
        map.placed[root.triangle] += 1.0f;
        ++counted;
    }
    for (std::size_t i = 0; i < shares.size(); ++i)
        map.asked[i] = static_cast<float>(shares[i] * static_cast<double>(counted));
    if (progress.cancelled()) return cancelledError();
    const auto around = neighbours(mesh);
    for (int pass = 0; pass < passes; ++pass) {
        if (progress.cancelled()) return cancelledError();
        smooth(around, map.asked);
        smooth(around, map.placed);
    }
    return map;
}

glm::vec3 heatColour(float asked, float placed) {
    constexpr float least = 0.01f;
    if (!(asked >= least) && !(placed >= least)) return glm::vec3(0.18f);
    const float ratio = std::log2(std::max(placed, 1e-6f) / std::max(asked, 1e-6f));
    const float t = std::clamp(ratio, -1.0f, 1.0f);
    const glm::vec3 white(0.85f);
    return t < 0.0f ? glm::mix(white, glm::vec3(0.02f, 0.10f, 0.75f), -t)
                    : glm::mix(white, glm::vec3(0.75f, 0.03f, 0.02f), t);
}

}  // namespace whorl
