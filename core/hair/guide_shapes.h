// SPDX-License-Identifier: Apache-2.0
// The guides' points as kernels read them.
#pragma once

#include "core/model/groom.h"

#include <cstdint>
#include <vector>

namespace whorl {

/// Points relative to their guide's root, structure of arrays: coordinate of point v of guide g at [first[g] + v].
/// Each guide takes its group's stride, a whole number of lanes; what is beyond its last point is zero.
struct GuideShapes {
    static constexpr std::size_t lanes = 16;

    std::vector<std::uint32_t> first;
    std::vector<float> x, y, z;
    std::vector<float> normals;  ///< of the skin at the guides' roots, three a guide

    GuideShapes() = default;
    explicit GuideShapes(const Groom& groom);
    /// Reads the guides of one block again. Guide count and segments as they were.
    void update(const Groom& groom, std::size_t block);

    static std::size_t stride(int segments) {
        return (static_cast<std::size_t>(segments) + 1 + lanes - 1) / lanes * lanes;
    }
};

}  // namespace whorl
