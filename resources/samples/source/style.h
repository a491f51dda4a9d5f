// SPDX-License-Identifier: Apache-2.0
// Grows styled guides on the samples: each guide leaves the skin, follows a flow, sinks under its weight, stays
// outside.
#pragma once

#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <glm/vec3.hpp>

#include <functional>

namespace whorl::samples {

/// How the guides of one group grow. Metres; `root` is the guide's root, `normal` the skin's there.
struct Style {
    std::function<float(const glm::vec3& root)> length;
    /// Direction that the comb gave the hair around `place`; need not be unit or tangential.
    std::function<glm::vec3(const glm::vec3& place, const glm::vec3& root)> flow;
    /// 0: lies on the skin at once, 1: leaves along the normal.
    std::function<float(const glm::vec3& root)> lift;
    /// Height above the skin that the hair lies at: the volume of the style.
    std::function<float(const glm::vec3& root)> layer;
    float turn = 0.35f;     ///< how fast the flow takes over, share a segment
    float gravity = 0.05f;  ///< pull downwards, share a segment
    float hug = 0.6f;       ///< pull back to the layer when the hair is above it
    float stray = 0.05f;    ///< random bend of each guide, radians or so
};

/// Reshapes every guide of `group` from its root.
void growGuides(Groom& groom, const Surface& surface, std::uint8_t group, const Style& style);

/// 0 below `from`, 1 above `to`, smooth between; `from` may be the larger one.
float ramp(float value, float from, float to);

}  // namespace whorl::samples
