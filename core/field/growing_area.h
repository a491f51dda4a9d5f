// SPDX-License-Identifier: Apache-2.0
// Where the direction field lives.
#pragma once

#include "core/model/groom.h"

#include <cstdint>
#include <vector>

namespace whorl {

/// One a triangle: 1 where the density is above zero at a corner, in the middle of an edge or of the triangle.
std::vector<std::uint8_t> growingTriangles(const Groom& groom);

}  // namespace whorl
