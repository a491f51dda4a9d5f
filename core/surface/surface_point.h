// SPDX-License-Identifier: Apache-2.0
// Places on the surface and the frames there.
#pragma once

#include "core/model/surface_mesh.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace whorl {

glm::vec3 positionAt(const SurfaceMesh& mesh, const SurfacePoint& point);
/// Interpolated vertex normal, unit length; the triangle's own where that vanishes.
glm::vec3 normalAt(const SurfaceMesh& mesh, const SurfacePoint& point);
/// Unit normal of the triangle; (0, 1, 0) for one without area.
glm::vec3 triangleNormal(const SurfaceMesh& mesh, std::uint32_t triangle);
glm::vec2 uvAt(const SurfaceMesh& mesh, const SurfacePoint& point);
/// Square metres, computed in double.
double triangleArea(const SurfaceMesh& mesh, std::uint32_t triangle);
/// Number of the part that holds the triangle.
std::uint32_t partOfTriangle(const SurfaceMesh& mesh, std::uint32_t triangle);

/// The smallest rotation that turns unit vector `from` into unit vector `to` (for opposite ones, half a turn about an
/// axis that depends on `from` only). Unlike a frame from UV tangents it does not flip at seams.
glm::mat3 minimalRotation(const glm::vec3& from, const glm::vec3& to);

struct Bounds {
    glm::vec3 min{1e30f};
    glm::vec3 max{-1e30f};
    bool empty() const { return min.x > max.x; }
    glm::vec3 centre() const { return (min + max) * 0.5f; }
    glm::vec3 size() const { return max - min; }
    void add(const glm::vec3& p);
    void add(const Bounds& other);
};
Bounds boundsOf(const SurfaceMesh& mesh);

}  // namespace whorl
