// SPDX-License-Identifier: Apache-2.0
// What every change of a guide's shape must respect: segment lengths, and staying out of the skin.
#pragma once

#include "core/surface/surface.h"

#include <glm/vec3.hpp>

#include <span>

namespace whorl {

/// How far a guide keeps from the skin. Near the root the clearance rises smoothly from zero, so that roots stay put.
struct SkinClearance {
    const DistanceField* skin = nullptr;  ///< null: no skin to keep out of
    float clearance = 0.0f;               ///< metres, away from the root
    float ramp = 0.0f;                    ///< along the guide until `clearance` is full, metres

    /// For the skin of `surface`: a seventh of the field's grid step, more than its interpolation can be wrong.
    static SkinClearance of(const Surface& surface);
    /// Asked distance to the skin at `along` metres from the root.
    float at(float along) const;
};

/// Goes along one guide from root to tip. Distance to the skin falls by no more than the way gone, so far from the skin
/// most points need not ask for it.
struct SkinWalk {
    const SkinClearance& skin;
    float along = 0.0f;  ///< metres from the root to the newest point
    float free = 0.0f;   ///< the newest point is at least so far from the skin; 0: not known
};

/// Places the point after `previous`: as near to `target` as a segment of exactly `length` and the skin allow. The skin
/// moves the point along its gradient and the length is restored by turning the segment, so that both hold at once as
/// long as `previous` itself keeps its clearance. `direction` (any length but zero) is used where `target` is on
/// `previous`.
glm::vec3 placeNext(SkinWalk& walk, const glm::vec3& previous, const glm::vec3& target, const glm::vec3& direction,
                    float length);

/// Moves a point out of the skin where it is nearer than asked; no length to keep.
glm::vec3 pushOut(const glm::vec3& point, float along, const SkinClearance& skin);

/// One pass from root to tip over a whole guide: keeps the directions of `points`, gives segment i the length
/// |original[i+1] - original[i]| and keeps out of the skin. What a turn moves, moves the rest of the guide with it.
void settle(std::span<glm::vec3> points, std::span<const glm::vec3> original, const SkinClearance& skin);

/// Length along the curve, metres.
float curveLength(std::span<const glm::vec3> points);

}  // namespace whorl
