// SPDX-License-Identifier: Apache-2.0
// A distance field as kernels read it (see core/base/simd.h).
#pragma once

#include <cstdint>

namespace whorl {

/// The field as kernels read it: DistanceField::sample in plain numbers.
struct FieldArrays {
    // Cells lie in bricks of 3 x 3 x 3, whose 4 x 4 x 4 nodes are stored together: a cell is two cache lines. Bricks
    // that are entirely beyond the band have no nodes.
    static constexpr int brickCells = 3;
    static constexpr int brickNodes = 4;
    static constexpr std::int32_t farInside = -2,
                                  farOutside = -1;  // otherwise: place of its nodes, and the bit `flips`
    static constexpr std::int32_t flips = 1;        // the side changes abruptly in one of its cells

    float origin[3];
    float last[3];  ///< size of the grid in cells
    float perMetre;
    float band;
    int brickCounts[2];  ///< along x and y
    const std::int32_t* bricks;
    const float* nodes;
};

}  // namespace whorl
