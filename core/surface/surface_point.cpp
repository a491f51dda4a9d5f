// SPDX-License-Identifier: Apache-2.0
#include "core/surface/surface_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

using Vec3d = glm::vec<3, double>;
using Mat3d = glm::mat<3, 3, double>;

// Twice the area times the normal. In double, so that triangles far from the origin and slivers keep their sign.
Vec3d areaVector(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const Vec3d a(mesh.positions[t.x]);
    return glm::cross(Vec3d(mesh.positions[t.y]) - a, Vec3d(mesh.positions[t.z]) - a);
}

template <class T>
T blend(const T& a, const T& b, const T& c, const SurfacePoint& point) {
    return a * (1.0f - point.u - point.v) + b * point.u + c * point.v;
}

}  // namespace

glm::vec3 positionAt(const SurfaceMesh& mesh, const SurfacePoint& point) {
    const glm::uvec3 t = mesh.triangles[point.triangle];
    return blend(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], point);
}

glm::vec3 normalAt(const SurfaceMesh& mesh, const SurfacePoint& point) {
    const glm::uvec3 t = mesh.triangles[point.triangle];
    const glm::vec3 sum = blend(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z], point);
    const float length = glm::length(sum);
    // Opposite corner normals cancel: what is left of them is rounding.
    if (!(length > 1e-3f) || !std::isfinite(length)) return triangleNormal(mesh, point.triangle);
    return sum / length;
}

glm::vec3 triangleNormal(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const Vec3d normal = areaVector(mesh, triangle);
    const double length = glm::length(normal);
    if (!(length > 0.0) || !std::isfinite(length)) return {0.0f, 1.0f, 0.0f};
    return glm::vec3(normal / length);
}

glm::vec2 uvAt(const SurfaceMesh& mesh, const SurfacePoint& point) {
    const std::size_t corner = std::size_t{3} * point.triangle;
    return blend(mesh.cornerUvs[corner], mesh.cornerUvs[corner + 1], mesh.cornerUvs[corner + 2], point);
}

double triangleArea(const SurfaceMesh& mesh, std::uint32_t triangle) {
    return 0.5 * glm::length(areaVector(mesh, triangle));
}

std::uint32_t partOfTriangle(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const auto after = std::upper_bound(mesh.parts.begin(), mesh.parts.end(), triangle,
                                        [](std::uint32_t t, const MeshPart& part) { return t < part.firstTriangle; });
    // Empty parts share their first triangle with the next part; upper_bound passes them, so the last one wins.
    return after == mesh.parts.begin() ? 0 : static_cast<std::uint32_t>(after - mesh.parts.begin() - 1);
}

glm::mat3 minimalRotation(const glm::vec3& from, const glm::vec3& to) {
    const Vec3d f(from);
    const Vec3d w = glm::cross(f, Vec3d(to));
    const double cosine = glm::dot(f, Vec3d(to));
    const double sineSquared = glm::dot(w, w);
    if (!std::isfinite(cosine)) return glm::mat3(1.0f);
    if (cosine < 0.0 && sineSquared < 1e-12) {
        // Opposite: half a turn, 2 a a^T - I, about the axis across `from` and the coordinate axis farthest from it.
        const Vec3d size = glm::abs(f);
        const int far = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        Vec3d other(0.0);
        other[far] = 1.0;
        const Vec3d a = glm::normalize(glm::cross(f, other));
        return glm::mat3(glm::outerProduct(a, a) * 2.0 - Mat3d(1.0));
    }
    // Rodrigues: cosine I + [w] + k w w^T, with k = 1 / (1 + cosine) = (1 - cosine) / sine^2, whichever keeps its
    // digits.
    const double k = cosine < 0.0 ? (1.0 - cosine) / sineSquared : 1.0 / (1.0 + cosine);
    const Mat3d crossMatrix(0.0, w.z, -w.y, -w.z, 0.0, w.x, w.y, -w.x, 0.0);
    return glm::mat3(Mat3d(cosine) + crossMatrix + glm::outerProduct(w, w) * k);
}

void Bounds::add(const glm::vec3& p) {
    // Written so that a NaN coordinate changes nothing.
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] < min[axis]) min[axis] = p[axis];
        if (p[axis] > max[axis]) max[axis] = p[axis];
    }
}

void Bounds::add(const Bounds& other) {
    if (other.empty()) return;
    add(other.min);
    add(other.max);
}

Bounds boundsOf(const SurfaceMesh& mesh) {
    // Only vertices in use: a stray vertex far away must not make the camera and the distance field useless.
    Bounds bounds;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) bounds.add(mesh.positions[t[corner]]);
    }
    return bounds;
}

}  // namespace whorl
