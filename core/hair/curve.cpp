// SPDX-License-Identifier: Apache-2.0
#include "core/hair/curve.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

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

// Numbers at the four vertices of a piece.
struct Four {
    float a, b, c, d;
};

Four radiiOf(std::span<const float> widths, std::size_t piece) {
    const std::size_t last = widths.size() - 1;
    return {widths[piece > 0 ? piece - 1 : 0] * 0.5f, widths[piece] * 0.5f, widths[piece + 1] * 0.5f,
            widths[std::min(piece + 2, last)] * 0.5f};
}

// Added to boxes, as a share of the greatest coordinate: four roundings of a float.
constexpr double roundings = 4.8e-7;

/// k0 + k1 t + k2 t^2 + k3 t^3
struct Cubic {
    double k0, k1, k2, k3;
    Cubic operator+(const Cubic& o) const { return {k0 + o.k0, k1 + o.k1, k2 + o.k2, k3 + o.k3}; }
    Cubic operator-(const Cubic& o) const { return {k0 - o.k0, k1 - o.k1, k2 - o.k2, k3 - o.k3}; }
};

Cubic catmullRomOf(const Four& n) {
    const double a = double{n.a}, b = double{n.b}, c = double{n.c}, d = double{n.d};
    return {b, (c - a) * 0.5, a - 2.5 * b + 2 * c - 0.5 * d, 0.5 * (d - a) + 1.5 * (b - c)};
}

struct Range {
    double low = 1e300;
    double high = -1e300;
};

// Least and greatest value over 0 <= t <= 1.
Range rangeOf(const Cubic& cubic) {
    Range range;
    const auto at = [&](double t) {
        const double value = cubic.k0 + t * (cubic.k1 + t * (cubic.k2 + t * cubic.k3));
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    };
    at(0.0);
    at(1.0);
    const auto inside = [&](double t) {
        if (t > 0.0 && t < 1.0) at(t);
    };
    // Roots of the derivative 3 k3 t^2 + 2 k2 t + k1 in the form that does not cancel.
    const double a = 3 * cubic.k3, b = 2 * cubic.k2, c = cubic.k1;
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return range;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0) inside(q / a);
    if (q != 0) inside(c / q);
    return range;
}

// True when a piece can not reach out of the box: it lies between its ends and the two handles of its Bezier form, a
// sixth of the way along the chords of its neighbours. Most pieces of much hair are left out so.
bool insideAlready(const Neighbours& n, const Four& r, const Bounds& bounds) {
    const glm::vec3 out = n.b + (n.c - n.a) * (1.0f / 6.0f), in = n.c - (n.d - n.b) * (1.0f / 6.0f);
    const float reach = std::max({r.b, r.c, r.b + (r.c - r.a) * (1.0f / 6.0f), r.c - (r.d - r.b) * (1.0f / 6.0f)});
    const glm::vec3 low = glm::min(glm::min(n.b, n.c), glm::min(out, in)) - reach;
    const glm::vec3 high = glm::max(glm::max(n.b, n.c), glm::max(out, in)) + reach;
    // Farther than the box itself is from the curve.
    const glm::vec3 room = glm::max(glm::abs(low), glm::abs(high)) * 1.5e-6f;
    return glm::all(glm::greaterThan(low - room, bounds.min)) && glm::all(glm::lessThan(high + room, bounds.max));
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

void addStrandBounds(std::span<const glm::vec3> points, std::span<const float> widths, Bounds& bounds) {
    if (points.size() == 1) {
        bounds.add(points[0] - glm::vec3(widths[0] * 0.5f));
        bounds.add(points[0] + glm::vec3(widths[0] * 0.5f));
    }
    for (std::size_t piece = 0; piece + 1 < points.size(); ++piece) {
        const Neighbours n = pieceOf(points, piece);
        const Four radii = radiiOf(widths, piece);
        if (insideAlready(n, radii, bounds)) continue;
        const Cubic curved = catmullRomOf(radii);
        const Cubic straight{curved.k0, double{radii.c} - double{radii.b}, 0.0, 0.0};
        glm::vec3 low(0.0f), high(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const Cubic p = catmullRomOf({n.a[axis], n.b[axis], n.c[axis], n.d[axis]});
            const double least = std::min(rangeOf(p - curved).low, rangeOf(p - straight).low);
            const double most = std::max(rangeOf(p + curved).high, rangeOf(p + straight).high);
            const double room = roundings * std::max(std::abs(least), std::abs(most));
            low[axis] = static_cast<float>(least - room);
            high[axis] = static_cast<float>(most + room);
        }
        bounds.add(low);
        bounds.add(high);
    }
}

Bounds strandBounds(std::span<const glm::vec3> points, std::span<const float> widths) {
    Bounds bounds;
    addStrandBounds(points, widths, bounds);
    return bounds;
}

}  // namespace whorl
