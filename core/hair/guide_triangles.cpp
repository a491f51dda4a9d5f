// SPDX-License-Identifier: Apache-2.0
#include "core/hair/guide_triangles.h"

#include "core/hair/guide_voronoi.h"
#include "core/surface/closest_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace whorl {
namespace {

constexpr std::uint32_t leafTriangles = 4;

float squaredToBox(const Bounds& box, const glm::vec3& p) {
    const glm::vec3 off = glm::max(glm::max(box.min - p, p - box.max), glm::vec3(0.0f));
    return glm::dot(off, off);
}

}  // namespace

GuideTriangles::GuideTriangles(const Groom& groom, const GuideIndex& index, std::size_t group) {
    const std::span<const GuideRoot> roots = index.rootsOf(group);
    for (const glm::uvec3& triple : meetingGuides(groom, index, group)) {
        const GuideRoot &a = roots[triple.x], &b = roots[triple.y], &c = roots[triple.z];
        Corners corners{a.position, b.position, c.position,
                        glm::cross(b.position - a.position, c.position - a.position)};
        const float area = glm::length(corners.normal);
        // Guides on one line or on one place have no triangle.
        if (!(area > 1e-30f)) continue;
        corners.normal /= area;
        if (glm::dot(corners.normal, a.normal + b.normal + c.normal) < 0.0f) corners.normal = -corners.normal;
        m_triangles.push_back(triple);
        m_corners.push_back(corners);
    }
    if (m_triangles.empty()) return;
    build(0, static_cast<std::uint32_t>(m_triangles.size()));
}

std::uint32_t GuideTriangles::build(std::uint32_t first, std::uint32_t last) {
    const auto index = static_cast<std::uint32_t>(m_nodes.size());
    Bounds box, middles;
    for (std::uint32_t i = first; i < last; ++i) {
        const Corners& t = m_corners[i];
        for (const glm::vec3& p : {t.a, t.b, t.c}) box.add(p);
        middles.add(t.a + t.b + t.c);
    }
    m_nodes.push_back({box, first, last, 0});
    if (last - first <= leafTriangles) return index;
    const glm::vec3 size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // Triangles move together with their corners, so the order is that of a list of both.
    std::vector<std::uint32_t> order(last - first);
    std::iota(order.begin(), order.end(), first);
    const auto middle = order.begin() + (last - first) / 2;
    const auto place = [&](std::uint32_t i) {
        return m_corners[i].a[axis] + m_corners[i].b[axis] + m_corners[i].c[axis];
    };
    std::nth_element(order.begin(), middle, order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return place(a) != place(b) ? place(a) < place(b) : a < b;
    });
    std::vector<glm::uvec3> triangles;
    std::vector<Corners> corners;
    for (const std::uint32_t i : order) {
        triangles.push_back(m_triangles[i]);
        corners.push_back(m_corners[i]);
    }
    std::copy(triangles.begin(), triangles.end(), m_triangles.begin() + first);
    std::copy(corners.begin(), corners.end(), m_corners.begin() + first);
    const std::uint32_t half = first + (last - first) / 2;
    build(first, half);
    const std::uint32_t second = build(half, last);
    m_nodes[index].second = second;
    return index;
}

std::optional<GuideTriangles::Place> GuideTriangles::nearest(const glm::vec3& position, const glm::vec3& normal) const {
    if (m_nodes.empty()) return std::nullopt;
    const Vec3d p(position);
    ClosestPoint best;
    best.distanceSquared = 1e300;
    std::uint32_t which = ~std::uint32_t{0};
    std::array<std::pair<std::uint32_t, float>, 64> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, squaredToBox(m_nodes[0].box, position)};
    while (count > 0) {
        const auto [index, squared] = waiting[--count];
        // The margin is for rounding of the boxes' distances.
        if (static_cast<double>(squared) * 0.999 > best.distanceSquared) continue;
        const Node& node = m_nodes[index];
        if (node.second != 0) {
            std::pair<std::uint32_t, float> near{index + 1, squaredToBox(m_nodes[index + 1].box, position)};
            std::pair<std::uint32_t, float> far{node.second, squaredToBox(m_nodes[node.second].box, position)};
            if (far.second < near.second) std::swap(near, far);
            waiting[count++] = far;
            waiting[count++] = near;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            const Corners& t = m_corners[i];
            if (!(glm::dot(t.normal, normal) > 0.0f)) continue;
            const ClosestPoint here = closestPoint(Vec3d(t.a), Vec3d(t.b), Vec3d(t.c), p);
            if (here.distanceSquared > best.distanceSquared ||
                (here.distanceSquared == best.distanceSquared && i > which))
                continue;
            best = here;
            which = i;
        }
    }
    if (which == ~std::uint32_t{0}) return std::nullopt;
    const auto u = static_cast<float>(best.u), v = static_cast<float>(best.v);
    // On the edge across from the first corner, what is left of its weight is rounding.
    const float rest = 1.0f - u - v;
    return Place{m_triangles[which], {rest > 1e-6f ? rest : 0.0f, u, v}};
}

}  // namespace whorl
