// SPDX-License-Identifier: Apache-2.0
// The shape of a new guide: like its neighbours, or standing up.
#pragma once

#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <vector>

namespace whorl {

/// Length of guides where nobody gave one: a tenth of the mesh's size, metres.
float defaultGuideLength(const Surface& surface);

/// Points of a guide of `group` at `root`: the mean of its nearest guides of the group on its own side of partings
/// (Shepard weights), turned with
/// the skin from their roots to this one; along the normal, `length` metres (0: the default), where the group has none.
std::vector<glm::vec3> guideShapeAt(const Groom& groom, const Surface& surface, const SurfacePoint& root,
                                    std::uint8_t group, float length);

/// Index of the guide whose root is nearest to `position` (any group), with the distance; count() when there are none.
struct NearestRoot {
    std::size_t guide = 0;
    float distance = 1e30f;
};
NearestRoot nearestRoot(const GuideSet& guides, const glm::vec3& position);

}  // namespace whorl
