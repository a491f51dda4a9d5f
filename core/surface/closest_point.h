// SPDX-License-Identifier: Apache-2.0
// The place of a triangle that is nearest to a point, in double.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace whorl {

using Vec3d = glm::vec<3, double>;

/// Barycentric weights of the second and third corner (as in SurfacePoint) and the squared distance.
struct ClosestPoint {
    double u = 0.0;
    double v = 0.0;
    double distanceSquared = 0.0;
};

/// Exact up to rounding for every triangle, also for ones without area. On an edge or corner, the weights that vanish
/// there are exactly zero, or u + v is 1 up to rounding.
ClosestPoint closestPoint(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p);

}  // namespace whorl
