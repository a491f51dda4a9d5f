// SPDX-License-Identifier: Apache-2.0
#include "core/surface/closest_point.h"

#include <algorithm>

namespace whorl {
namespace {

// Share of the way from 0 to `edge` that is nearest to `p`; both relative to the start.
double alongSegment(const Vec3d& edge, const Vec3d& p) {
    const double length = glm::dot(edge, edge);
    return length > 0.0 ? std::clamp(glm::dot(edge, p) / length, 0.0, 1.0) : 0.0;
}

ClosestPoint onBorder(const Vec3d& ab, const Vec3d& ac, const Vec3d& ap) {
    const Vec3d bc = ac - ab;
    const double onAb = alongSegment(ab, ap);
    const double onAc = alongSegment(ac, ap);
    const double onBc = alongSegment(bc, ap - ab);
    ClosestPoint best{onAb, 0.0, 0.0};
    Vec3d gap = ap - ab * onAb;
    best.distanceSquared = glm::dot(gap, gap);
    gap = ap - ac * onAc;
    if (const double d = glm::dot(gap, gap); d < best.distanceSquared) best = {0.0, onAc, d};
    gap = ap - ab - bc * onBc;
    if (const double d = glm::dot(gap, gap); d < best.distanceSquared) best = {1.0 - onBc, onBc, d};
    return best;
}

}  // namespace

// The regions of Ericson, "Real-Time Collision Detection", 5.1.5: inside when the three weights of the projection are
// positive, else somewhere on the border.
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
    // Below this the determinant is rounding, and all that matters is on the border.
    if (area > 1e-14 * bb * cc) {
        const double u = (cc * pb - bc * pc) / area;
        const double v = (bb * pc - bc * pb) / area;
        if (u > 0.0 && v > 0.0 && u + v < 1.0) {
            const Vec3d gap = ap - ab * u - ac * v;
            return {u, v, glm::dot(gap, gap)};
        }
    }
    return onBorder(ab, ac, ap);
}

}  // namespace whorl
