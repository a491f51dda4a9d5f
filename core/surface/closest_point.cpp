// SPDX-License-Identifier: Apache-2.0
#include "core/surface/closest_point.h"

#include <algorithm>

namespace whorl {
namespace {

// Share of the way from 0 to `edge` that is nearest to `p`; both relative to the start.
double alongSegment(const Vec3d& edge, const Vec3d& p) {
    const double along = glm::dot(edge, p);
    const double length = glm::dot(edge, edge);
    // Also for an edge without length, where `along` is zero.
    if (along <= 0.0) return 0.0;
    return along >= length ? 1.0 : along / length;
}

}  // namespace

// The projection of p on the plane has three barycentric weights. All positive: it is the answer. Else the answer lies
// on an edge that p's projection is outside of, that is, one whose weight is not positive.
ClosestPoint closestPoint(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
    const Vec3d ab = b - a;
    const Vec3d ac = c - a;
    const Vec3d ap = p - a;
    const double bb = glm::dot(ab, ab);
    const double bc = glm::dot(ab, ac);
    const double cc = glm::dot(ac, ac);
    const double pb = glm::dot(ap, ab);
    const double pc = glm::dot(ap, ac);
    const double area = bb * cc - bc * bc;  // four times the squared area
    double u = cc * pb - bc * pc;           // weights times that
    double v = bb * pc - bc * pb;
    // Below this the determinant is rounding, the triangle a line, and all of it border.
    const bool flat = !(area > 1e-14 * bb * cc);
    if (!flat && u > 0.0 && v > 0.0 && u + v < area) {
        u /= area;
        v /= area;
        const Vec3d gap = ap - ab * u - ac * v;
        return {u, v, glm::dot(gap, gap)};
    }
    ClosestPoint best{0.0, 0.0, glm::dot(ap, ap)};
    if (flat || v <= 0.0) {
        const double t = alongSegment(ab, ap);
        const Vec3d gap = ap - ab * t;
        best = {t, 0.0, glm::dot(gap, gap)};
    }
    if (flat || u <= 0.0) {
        const double t = alongSegment(ac, ap);
        const Vec3d gap = ap - ac * t;
        if (const double d = glm::dot(gap, gap); d < best.distanceSquared) best = {0.0, t, d};
    }
    if (flat || u + v >= area) {
        const double t = alongSegment(ac - ab, ap - ab);
        const Vec3d gap = ap - ab - (ac - ab) * t;
        if (const double d = glm::dot(gap, gap); d < best.distanceSquared) best = {1.0 - t, t, d};
    }
    return best;
}

}  // namespace whorl
