// SPDX-License-Identifier: Apache-2.0
#include "core/field/groom_field.h"

#include "core/field/grow_guides.h"
#include "core/field/growing_area.h"

namespace whorl {

std::vector<FieldStroke> leadingStrokes(const Groom& groom, const Surface& surface) {
    if (groom.strokes->empty() || groom.field->follow) return strokesFromGuides(groom, surface, -1);
    return *groom.strokes;
}

Result<FieldSolver> groomFieldSolver(const Groom& groom, std::shared_ptr<const Surface> surface, Progress& progress) {
    return FieldSolver::make(std::move(surface), growingTriangles(groom), *groom.partings, progress);
}

Result<DirectionField> groomField(const Groom& groom, std::shared_ptr<const Surface> surface, Progress& progress) {
    const auto solver = groomFieldSolver(groom, surface, progress);
    if (!solver) return solver.error();
    return solver->solve(leadingStrokes(groom, *surface), *groom.field, progress);
}

}  // namespace whorl
