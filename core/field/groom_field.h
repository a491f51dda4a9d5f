// SPDX-License-Identifier: Apache-2.0
// The direction field of a groom: the one that is drawn, grown along and baked.
#pragma once

#include "core/field/direction_field.h"
#include "core/model/groom.h"

namespace whorl {

/// The strokes that decide which way the groom's hair lies: those drawn, or its guides as they lie where none are drawn
/// or combing leads (FieldParams::follow). Empty where neither says anything: then hair hangs. `surface` is that of the
/// groom's mesh.
std::vector<FieldStroke> leadingStrokes(const Groom& groom, const Surface& surface);

/// Strokes that lie as the guides of a group (-1: all) do: from their roots, as long as they lie along the skin. Guides
/// that lie over each other seldom agree; these follow the field that the guides lead together, so that they do. Fewer
/// where that has no direction. `surface` is that of the groom's mesh. Fails only when cancelled.
Result<std::vector<FieldStroke>> agreedStrokes(const Groom& groom, std::shared_ptr<const Surface> surface, int group,
                                               Progress& progress);

/// Solver for the groom's mesh, growing area and partings. `surface` is that of the groom's mesh. Fails only when
/// cancelled.
Result<FieldSolver> groomFieldSolver(const Groom& groom, std::shared_ptr<const Surface> surface, Progress& progress);

/// The groom's field: leadingStrokes over groomFieldSolver with the groom's FieldParams. Fails only when cancelled.
Result<DirectionField> groomField(const Groom& groom, std::shared_ptr<const Surface> surface, Progress& progress);

}  // namespace whorl
