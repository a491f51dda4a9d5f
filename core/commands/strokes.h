// SPDX-License-Identifier: Apache-2.0
// Adding, changing and removing strokes of the direction field.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <glm/vec3.hpp>

#include <memory>
#include <span>

namespace whorl {

/// Adds a stroke over the skin through the places nearest to `points` (see tracedParting); one place is enough for all
/// kinds but Along. `weight` and `radius` (metres) within the limits of FieldStroke. Gives its id.
Result<std::uint32_t> addStroke(Groom& groom, const Surface& surface, StrokeKind kind,
                                std::span<const glm::vec3> points, float weight = 1.0f, float radius = 0.0f);
/// The stroke of that id, or null.
const FieldStroke* findStroke(const Groom& groom, std::uint32_t id);
/// Fails when there is none of that id.
Result<void> removeStroke(Groom& groom, std::uint32_t id);
/// Puts `stroke` in the place of that with its id. Fails when there is none, or for a weight, radius or number of
/// points that none can have.
Result<void> changeStroke(Groom& groom, const FieldStroke& stroke);
/// Carries a stroke by `offset` metres and down onto the skin.
Result<void> moveStroke(Groom& groom, const Surface& surface, std::uint32_t id, const glm::vec3& offset);
/// The id of the first stroke of `after` that is new or differs from that in `before`; 0 for none.
std::uint32_t changedStroke(const Groom& before, const Groom& after);
/// Replaces the strokes by those of agreedStrokes; of more guides than FieldStroke::maxStrokes by evenly picked ones.
/// They lead from then on: FieldParams::follow becomes false. Fails when no guide of the group (-1: of all) lies along
/// the skin, and when cancelled.
Result<void> makeStrokesOfGuides(Groom& groom, std::shared_ptr<const Surface> surface, int group, Progress& progress);

}  // namespace whorl
