// SPDX-License-Identifier: Apache-2.0
#include "core/surface/surface_walk.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

using Vec3 = glm::dvec3;

constexpr int mostCrossings = 10000;

}  // namespace

SurfaceWalk::SurfaceWalk(const SurfaceMesh& mesh) : m_across(trianglesAcross(mesh)) {}

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
        const std::uint32_t next = m_across[triangle][static_cast<std::size_t>((exit + 1) % 3)];
        if (next == noTriangle) break;
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
