// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/raw_mesh.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace whorl::import {
namespace {

// Above this many corners ear cutting (quadratic) gives way to a fan.
constexpr std::size_t mostEarCorners = 4096;

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Newell's normal: right for bent and concave polygons too.
glm::dvec3 newell(std::span<const glm::vec3> polygon) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin(polygon[0]);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(polygon[i]) - origin;
        const glm::dvec3 b = glm::dvec3(polygon[(i + 1) % polygon.size()]) - origin;
        sum += glm::cross(a, b);
    }
    return sum;
}

// In the plane across the largest component of the normal, counter-clockwise.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> polygon, const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    std::vector<glm::dvec2> flat;
    flat.reserve(polygon.size());
    for (const glm::vec3& p : polygon) {
        const glm::dvec3 q(p);
        if (size.z >= size.x && size.z >= size.y) {
            flat.emplace_back(normal.z > 0.0 ? q.x : -q.x, q.y);
        } else if (size.x >= size.y) {
            flat.emplace_back(normal.x > 0.0 ? q.y : -q.y, q.z);
        } else {
            flat.emplace_back(normal.y > 0.0 ? q.z : -q.z, q.x);
        }
    }
    return flat;
}

struct Ring {
    std::vector<std::uint32_t> before, after;
    explicit Ring(std::size_t count) : before(count), after(count) {
        for (std::size_t i = 0; i < count; ++i) {
            before[i] = static_cast<std::uint32_t>((i + count - 1) % count);
            after[i] = static_cast<std::uint32_t>((i + 1) % count);
        }
    }
    void cut(std::uint32_t corner) {
        after[before[corner]] = after[corner];
        before[after[corner]] = before[corner];
    }
};

bool isEar(const std::vector<glm::dvec2>& flat, const Ring& ring, std::uint32_t corner) {
    const glm::dvec2& a = flat[ring.before[corner]];
    const glm::dvec2& b = flat[corner];
    const glm::dvec2& c = flat[ring.after[corner]];
    if (!(cross(a, b, c) > 0.0)) return false;
    for (std::uint32_t i = ring.after[ring.after[corner]]; i != ring.before[corner]; i = ring.after[i]) {
        const glm::dvec2& p = flat[i];
        if (p == a || p == b || p == c) continue;
        if (cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0) return false;
    }
    return true;
}

}  // namespace

void triangulate(std::span<const glm::vec3> polygon, std::vector<std::uint32_t>& out) {
    const auto count = static_cast<std::uint32_t>(polygon.size());
    if (count < 3) return;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { out.insert(out.end(), {a, b, c}); };
    if (count == 3) return add(0, 1, 2);

    const glm::dvec3 normal = newell(polygon);
    const double length = glm::dot(normal, normal);
    if (!(length > 0.0) || !std::isfinite(length) || count > mostEarCorners) {
        for (std::uint32_t i = 1; i + 1 < count; ++i) add(0, i, i + 1);
        return;
    }
    const std::vector<glm::dvec2> flat = flatten(polygon, normal);
    if (count == 4) {
        // The diagonal inside the quad; of two good ones the shorter.
        const bool first = cross(flat[0], flat[1], flat[2]) > 0.0 && cross(flat[0], flat[2], flat[3]) > 0.0;
        const bool second = cross(flat[1], flat[2], flat[3]) > 0.0 && cross(flat[1], flat[3], flat[0]) > 0.0;
        const glm::dvec3 d02 = glm::dvec3(polygon[0]) - glm::dvec3(polygon[2]);
        const glm::dvec3 d13 = glm::dvec3(polygon[1]) - glm::dvec3(polygon[3]);
        if (second && (!first || glm::dot(d13, d13) < glm::dot(d02, d02))) {
            add(0, 1, 3);
            add(1, 2, 3);
        } else {
            add(0, 1, 2);
            add(0, 2, 3);
        }
        return;
    }
    Ring ring(count);
    std::uint32_t corner = 0;
    std::uint32_t left = count;
    std::uint32_t failures = 0;
    while (left > 3) {
        // A polygon that crosses itself may run out of ears: cut anyway, every corner keeps its triangle.
        if (isEar(flat, ring, corner) || failures > left) {
            add(ring.before[corner], corner, ring.after[corner]);
            ring.cut(corner);
            corner = ring.after[ring.after[corner]];
            --left;
            failures = 0;
        } else {
            corner = ring.after[corner];
            ++failures;
        }
    }
    add(ring.before[corner], corner, ring.after[corner]);
}

}  // namespace whorl::import
