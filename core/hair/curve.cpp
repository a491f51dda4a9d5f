// SPDX-License-Identifier: Apache-2.0
#include "core/hair/curve.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

struct Neighbours {
    glm::vec3 a, b, c, d;
};

Neighbours pieceOf(std::span<const glm::vec3> points, std::size_t piece) {
    const std::size_t last = points.size() - 1;
    return {points[piece > 0 ? piece - 1 : 0], points[piece], points[piece + 1], points[std::min(piece + 2, last)]};
}

struct Range {
    double low = 1e300;
    double high = -1e300;
};

// Least and greatest value of the cubic k0 + k1 t + k2 t^2 + k3 t^3 over 0 <= t <= 1.
Range cubicRange(double k0, double k1, double k2, double k3) {
    Range range;
    const auto at = [&](double t) {
        const double value = k0 + t * (k1 + t * (k2 + t * k3));
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    };
    at(0.0);
    at(1.0);
    const auto inside = [&](double t) {
        if (t > 0.0 && t < 1.0) at(t);
    };
    // Roots of the derivative 3 k3 t^2 + 2 k2 t + k1 in the form that does not cancel.
    const double a = 3 * k3, b = 2 * k2, c = k1;
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return range;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0) inside(q / a);
    if (q != 0) inside(c / q);
    return range;
}

}  // namespace

glm::vec3 catmullRom(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, float t) {
    const glm::vec3 k1 = (c - a) * 0.5f;
    const glm::vec3 k2 = a - b * 2.5f + c * 2.0f - d * 0.5f;
    const glm::vec3 k3 = (d - a) * 0.5f + (b - c) * 1.5f;
    return b + (k1 + (k2 + k3 * t) * t) * t;
}

glm::vec3 strandPoint(std::span<const glm::vec3> points, float parameter) {
    if (points.size() < 2) return points[0];
    const float top = static_cast<float>(points.size() - 1);
    const float limited = std::clamp(parameter, 0.0f, top);
    const std::size_t piece = std::min(static_cast<std::size_t>(limited), points.size() - 2);
    const Neighbours n = pieceOf(points, piece);
    return catmullRom(n.a, n.b, n.c, n.d, limited - static_cast<float>(piece));
}

glm::vec3 strandTangent(std::span<const glm::vec3> points, std::size_t vertex, const glm::vec3& fallback) {
    const glm::vec3& before = points[vertex > 0 ? vertex - 1 : 0];
    const glm::vec3& after = points[std::min(vertex + 1, points.size() - 1)];
    const glm::vec3 along = after - before;
    const float squared = glm::dot(along, along);
    return squared > 1e-24f ? along / std::sqrt(squared) : fallback;
}

Bounds strandBounds(std::span<const glm::vec3> points, std::span<const float> widths) {
    Bounds bounds;
    if (points.empty()) return bounds;
    if (points.size() == 1) {
        bounds.add(points[0] - glm::vec3(widths[0] * 0.5f));
        bounds.add(points[0] + glm::vec3(widths[0] * 0.5f));
        return bounds;
    }
    for (std::size_t piece = 0; piece + 1 < points.size(); ++piece) {
        const Neighbours n = pieceOf(points, piece);
        const double r0 = double{widths[piece]} * 0.5, r1 = double{widths[piece + 1]} * 0.5;
        glm::vec3 low(0.0f), high(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const double a = double{n.a[axis]}, b = double{n.b[axis]}, c = double{n.c[axis]}, d = double{n.d[axis]};
            const double k1 = (c - a) * 0.5, k2 = a - 2.5 * b + 2 * c - 0.5 * d, k3 = 0.5 * (d - a) + 1.5 * (b - c);
            const double least = cubicRange(b - r0, k1 - (r1 - r0), k2, k3).low;
            const double most = cubicRange(b + r0, k1 + (r1 - r0), k2, k3).high;
            // Rounding to float must not cut the box.
            low[axis] = std::nextafter(static_cast<float>(least), -1e30f);
            high[axis] = std::nextafter(static_cast<float>(most), 1e30f);
        }
        bounds.add(low);
        bounds.add(high);
    }
    return bounds;
}

}  // namespace whorl
