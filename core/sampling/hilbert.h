// SPDX-License-Identifier: Apache-2.0
// An order of places in space in which neighbours in the order are neighbours in space.
#pragma once

#include "core/model/surface_mesh.h"

#include <cstdint>
#include <vector>

namespace whorl {

/// Distance along the 3D Hilbert curve of order 20 through the cube of coordinates below 2^20 (Skilling, "Programming
/// the Hilbert curve", 2004).
std::uint64_t hilbertIndex(std::uint32_t x, std::uint32_t y, std::uint32_t z);

/// Triangles by the place of their centres on the curve; equal places by number.
std::vector<std::uint32_t> hilbertOrder(const SurfaceMesh& mesh);

}  // namespace whorl
