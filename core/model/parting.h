// SPDX-License-Identifier: Apache-2.0
// Lines on the skin that no hair crosses.
#pragma once

#include "core/model/surface_mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace whorl {

/// A polyline on the skin. Hair on one side of it takes nothing from guides on the other (core/surface/parting_index.h
/// says where "side" ends). It has no width. First and last point on one place: a closed line.
struct Parting {
    static constexpr std::size_t maxPoints = 4096;
    static constexpr std::size_t maxPartings = 1000;

    std::uint32_t id = 0;              ///< unique in the groom, above zero
    std::string name{};                ///< may be empty
    std::vector<SurfacePoint> points;  ///< 2 to maxPoints; see tracedParting for how dense
    bool operator==(const Parting&) const = default;
};

/// The id that a new parting gets: one more than the largest.
std::uint32_t nextPartingId(std::span<const Parting> partings);

}  // namespace whorl
