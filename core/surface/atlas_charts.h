// SPDX-License-Identifier: Apache-2.0
// Cutting a mesh into pieces that lie flat without overlap. Private to atlas.cpp.
#pragma once

#include "core/model/surface_mesh.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace whorl::atlas {

/// Triangles that are flattened together. Metres; the lower left corner is (0, 0).
struct Chart {
    std::vector<std::uint32_t> triangles;
    std::vector<glm::dvec2> corners;  ///< three a triangle
    glm::dvec2 size{0.0};
};

/// Charts that hold every triangle with area exactly once. Inside a chart no two triangles overlap.
std::vector<Chart> makeCharts(const SurfaceMesh& mesh);

}  // namespace whorl::atlas
