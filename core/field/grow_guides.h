// SPDX-License-Identifier: Apache-2.0
// Guides laid along a direction field, and a field from guides.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/field/direction_field.h"
#include "core/model/groom.h"

namespace whorl {

struct GrowAlong {
    float length = 0.0f;      ///< metres; 0: every guide keeps the length that it has
    std::string lengthMap{};  ///< a map of the groom that `length` is multiplied by at the root; may be empty
    /// How guides leave the skin: 0 flat along it, 1 straight up; they lie down towards their tips.
    float lift = 0.25f;
    int group = -1;                     ///< guides of this group only; -1: of all
    float bend = 0.0f;                  ///< how much tips are bent to where hair hangs; 1 a lot
    glm::vec3 down{0.0f, -1.0f, 0.0f};  ///< where hair hangs to; unit, or zero for nowhere
};

/// What the artist's parameters ask for. For guides of all groups.
GrowAlong growAlong(const FieldParams& params);

/// Gives every guide of `groom` a new shape from its root: along `field` over the skin, outside of it, with segments of
/// equal length. Hair bends no tighter than a quarter of its length, so that it leaves the middle of a whorl in a
/// spiral; where directions meet head-on it goes straight on; it turns aside at partings; beyond the growing area it
/// comes to hang. Guides where the field has no direction stay as they are.
/// `surface` is that of the groom's mesh. Fails only when cancelled, with `groom` as it was.
Result<void> growGuidesAlong(Groom& groom, const Surface& surface, const DirectionField& field,
                             const GrowAlong& options, Progress& progress);

/// Strokes that follow the guides of a group (-1: all) as they lie over the skin: the field of a groom that is combed.
std::vector<FieldStroke> strokesFromGuides(const Groom& groom, const Surface& surface, int group);

}  // namespace whorl
