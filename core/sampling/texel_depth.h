// SPDX-License-Identifier: Apache-2.0
// How finely triangles are subdivided so that the pieces follow a map.
#pragma once

#include "core/model/surface_mesh.h"

#include <cstdint>
#include <span>

namespace whorl {

/// Subdivisions 1:4 after which at most one texel of a width x height map falls on a piece, at most maxDepth (seed 000,
/// section 3.1).
int texelDepth(const SurfaceMesh& mesh, std::uint32_t triangle, int width, int height, int maxDepth);

/// The depth, at most maxDepth, at which all pieces together stay within the limit. `depths`: at most 10 each.
int allowedDepth(std::span<const std::uint8_t> depths, int maxDepth, std::uint64_t limit);

}  // namespace whorl
