// SPDX-License-Identifier: Apache-2.0
// Which triangles meet at an edge.
#pragma once

#include "core/model/surface_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace whorl {

/// Stands for no triangle.
inline constexpr std::uint32_t noTriangle = UINT32_MAX;

/// For each triangle, those on the other side of its edges, the one from corner k to the next in place k; noTriangle at
/// borders and where more than two meet.
std::vector<std::array<std::uint32_t, 3>> trianglesAcross(const SurfaceMesh& mesh);

}  // namespace whorl
