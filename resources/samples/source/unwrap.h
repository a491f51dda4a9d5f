// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/halfmesh.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace whorl::samples {

/// Where the surface is cut open for unwrapping.
struct SeamRules {
    /// Whether the border between two different regions is a seam at this point.
    std::function<bool(uint8_t, uint8_t, const glm::vec3&)> isSeam;
    /// Whether a region continues over the mirror plane at this point (if not, the plane is a seam there).
    std::function<bool(uint8_t, const glm::vec3&)> joinsMirror;
};

/// One chart of a half mesh. Vertices on `onAxis` have u = 0, and the mirrored chart is joined there.
struct Chart {
    std::vector<uint32_t> meshVertex;                // chart vertex -> half mesh vertex
    std::vector<std::array<uint32_t, 3>> triangles;  // chart vertices
    std::vector<uint32_t> meshTriangle;              // chart triangle -> half mesh triangle
    std::vector<char> onAxis;
    std::vector<glm::dvec2> uvs;  // metres
    bool joined = false;
};

std::vector<Chart> cutCharts(const HalfMesh& mesh, const SeamRules& rules);

/// Flattens a disc-shaped chart without folds and with little stretch.
void flatten(const HalfMesh& mesh, Chart& chart);

}  // namespace whorl::samples
