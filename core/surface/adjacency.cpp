// SPDX-License-Identifier: Apache-2.0
#include "core/surface/adjacency.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

using Vec3 = glm::dvec3;

constexpr int mostCrossings = 10000;

}  // namespace

SurfaceWalk::SurfaceWalk(const SurfaceMesh& mesh) {
    struct Edge {
        std::uint32_t low, high, slot;
    };
    std::vector<Edge> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][static_cast<int>(k)];
            const std::uint32_t b = mesh.triangles[t][static_cast<int>((k + 1) % 3)];
            edges.push_back({std::min(a, b), std::max(a, b), t * 3 + k});
        }
    }
    std::ranges::sort(edges, [](const Edge& a, const Edge& b) {
        return std::array{a.low, a.high, a.slot} < std::array{b.low, b.high, b.slot};
    });
    m_across.assign(edges.size(), none);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
        if (end - i == 2) {
            m_across[edges[i].slot] = edges[i + 1].slot / 3;
            m_across[edges[i + 1].slot] = edges[i].slot / 3;
        }
        i = end;
    }
}

SurfaceWalk::Step SurfaceWalk::go(const SurfaceMesh& mesh, const SurfacePoint& from, const glm::vec3& direction,
                                  float metres) const {
    Step step{from, {}, 0.0f};
    std::uint32_t triangle = from.triangle;
    // Shares of the three corners.
    Vec3 share(1.0 - static_cast<double>(from.u) - static_cast<double>(from.v), from.u, from.v);
    Vec3 heading(direction);
    double left = metres;
    int entered = -1;  // corner opposite the edge that we came over: its share can only grow
    for (int crossing = 0; crossing < mostCrossings; ++crossing) {
        const glm::uvec3 corners = mesh.triangles[triangle];
        const Vec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
        const Vec3 e1 = b - a, e2 = c - a, normal = glm::cross(e1, e2);
        const double area = glm::dot(normal, normal);
        if (!(area > 0.0)) break;
        heading -= normal * (glm::dot(heading, normal) / area);
        const double length = glm::length(heading);
        if (!(length > 0.0)) break;
        heading /= length;
        // Shares gained a metre.
        const double dv = glm::dot(glm::cross(heading, e2), normal) / area;
        const double dw = glm::dot(glm::cross(e1, heading), normal) / area;
        const Vec3 rate(-dv - dw, dv, dw);
        double way = left;
        int exit = -1;  // corner whose share runs out
        for (int k = 0; k < 3; ++k) {
            if (k == entered || !(rate[k] < 0.0)) continue;
            const double until = std::max(share[k], 0.0) / -rate[k];
            if (until < way) {
                way = until;
                exit = k;
            }
        }
        share += rate * way;
        left -= way;
        step.direction = glm::vec3(heading);
        if (exit < 0) break;
        share[exit] = 0.0;
        const std::uint32_t next = across(triangle, (exit + 1) % 3);
        if (next == none) break;
        // The edge's own corners keep their shares; the way over it turns about it.
        const std::uint32_t first = corners[(exit + 1) % 3], second = corners[(exit + 2) % 3];
        const glm::uvec3 there = mesh.triangles[next];
        Vec3 moved(0.0);
        int opposite = -1;
        for (int k = 0; k < 3; ++k) {
            if (there[k] == first) {
                moved[k] = share[(exit + 1) % 3];
            } else if (there[k] == second) {
                moved[k] = share[(exit + 2) % 3];
            } else {
                opposite = k;
            }
        }
        if (opposite < 0) break;
        const Vec3 from1(mesh.positions[first]), to1(mesh.positions[second]);
        const double edgeLength = glm::length(to1 - from1);
        if (!(edgeLength > 0.0)) break;
        const Vec3 edge = (to1 - from1) / edgeLength;
        const double along = glm::dot(heading, edge);
        Vec3 inward = Vec3(mesh.positions[there[opposite]]) - from1;
        inward -= edge * glm::dot(inward, edge);
        const double height = glm::length(inward);
        if (!(height > 0.0)) break;
        heading = edge * along + inward / height * std::sqrt(std::max(1.0 - along * along, 0.0));
        triangle = next;
        share = moved;
        entered = opposite;
        if (!(left > 0.0)) break;
    }
    share = glm::max(share, Vec3(0.0));
    share /= share.x + share.y + share.z;
    step.point = {triangle, static_cast<float>(share.y), static_cast<float>(share.z)};
    step.walked = metres - static_cast<float>(left);
    return step;
}

}  // namespace whorl
