// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace whorl::samples {

using Field = std::function<float(const glm::vec3&)>;

/// The x >= 0 half of a mirror-symmetric surface; where the surface crosses the mirror plane the mesh is open and its
/// border lies exactly on x = 0. Triangles carry a region label; region borders are kept through remeshing, so that
/// they can serve as clean chart seams.
struct HalfMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint8_t> labels;
};

struct MeshEdge {
    uint32_t a, b;        // a < b
    int32_t left, right;  // triangles; right is -1 on the border
};

/// Every edge once, in an order that depends on the mesh only.
std::vector<MeshEdge> collectEdges(const std::vector<std::array<uint32_t, 3>>& triangles);

/// Gradient of the field; its length is 1 where the field is a true distance.
glm::vec3 fieldGradient(const Field& surface, const glm::vec3& p);

/// Unit gradient of the field; on the mirror plane its x component is exactly zero.
glm::vec3 fieldNormal(const Field& surface, const glm::vec3& p);

/// Moves a point onto the zero set along the gradient.
glm::vec3 projectToSurface(const Field& surface, glm::vec3 p, int steps);

/// Zero set of the field inside the box, by marching tetrahedra. lo.x must be 0.
HalfMesh polygonise(const Field& surface, const glm::vec3& lo, const glm::vec3& hi, float cell);

/// Gives label `to` to that part of region `from` where `cut` is positive, cutting triangles along its zero line.
void splitRegion(HalfMesh& mesh, uint8_t from, uint8_t to, const Field& cut);

/// Gives stray specks of a region, left where a cut grazes the surface, to the region around them.
void absorbSpecks(HalfMesh& mesh);

/// Isotropic remeshing towards the wanted edge length, staying on the surface and keeping region borders.
void remesh(HalfMesh& mesh, const Field& surface, const Field& edgeLength, int iterations);

/// Appends other with its labels raised by labelOffset.
void append(HalfMesh& mesh, const HalfMesh& other, uint8_t labelOffset);

}  // namespace whorl::samples
