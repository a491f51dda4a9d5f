// SPDX-License-Identifier: Apache-2.0
#include "core/field/groom_field.h"

#include "core/base/parallel.h"
#include "core/field/grow_guides.h"
#include "core/field/growing_area.h"

#include <glm/geometric.hpp>

namespace whorl {

namespace {

/// Weight of the line of one guide. Guides lie over each other's roots and seldom agree to the degree: the field takes
/// the mean of those within a part of their spacing, where strokes would each have their way.
constexpr float guideWeight = 5e-5f;

std::vector<FieldStroke> linesOfGuides(const Groom& groom, const Surface& surface, int group) {
    std::vector<FieldStroke> lines = strokesFromGuides(groom, surface, group);
    for (FieldStroke& line : lines) line.weight = guideWeight;
    return lines;
}

/// A line along `field` with as many points as `line`, from the same start and as long.
std::vector<SurfacePoint> laidAlong(const DirectionField& field, const Surface& surface,
                                    std::span<const SurfacePoint> line) {
    std::vector<SurfacePoint> points{line.front()};
    for (std::size_t k = 1; k < line.size(); ++k) {
        const SurfacePoint& from = points.back();
        const glm::vec3 way = field.at(from);
        const float step = glm::distance(positionAt(surface.mesh(), line[k - 1]), positionAt(surface.mesh(), line[k]));
        const auto hit = surface.query.nearest(positionAt(surface.mesh(), from) + way * step);
        if (way == glm::vec3(0.0f) || !hit || field.parted(from, hit->point)) break;
        points.push_back(hit->point);
    }
    return points;
}

}  // namespace

std::vector<FieldStroke> leadingStrokes(const Groom& groom, const Surface& surface) {
    if (!groom.strokes->empty() && !groom.field->follow) return *groom.strokes;
    return linesOfGuides(groom, surface, -1);
}

Result<std::vector<FieldStroke>> agreedStrokes(const Groom& groom, std::shared_ptr<const Surface> surface, int group,
                                               Progress& progress) {
    const auto solver = groomFieldSolver(groom, surface, progress);
    if (!solver) return solver.error();
    std::vector<FieldStroke> strokes = linesOfGuides(groom, *surface, group);
    const auto field = solver->solve(strokes, *groom.field, progress);
    if (!field) return field.error();
    parallelFor(strokes.size(), 32, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            strokes[i].points = laidAlong(*field, *surface, strokes[i].points);
            strokes[i].weight = 1.0f;
        }
    });
    std::erase_if(strokes, [](const FieldStroke& stroke) { return stroke.points.size() < stroke.fewestPoints(); });
    return strokes;
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
