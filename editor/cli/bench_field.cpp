// SPDX-License-Identifier: Apache-2.0
// The direction field while a stroke is moved, against factorising anew for every move.
#include "core/field/groom_field.h"
#include "core/surface/parting_line.h"
#include "editor/cli/bench.h"
#include "editor/cli/bench_grooms.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {

std::vector<BenchRow> benchField();

namespace {

/// Ten strokes from the crown down, as an artist sketches a coat; the last one `moved` radians on.
std::vector<FieldStroke> sketch(const Surface& surface, float moved) {
    const Bounds& bounds = surface.bounds;
    const glm::vec3 middle(bounds.centre().x, glm::mix(bounds.min.y, bounds.max.y, 0.75f), bounds.centre().z);
    std::vector<FieldStroke> strokes;
    for (int i = 0; i < 10; ++i) {
        std::vector<glm::vec3> places;
        for (int k = 0; k <= 32; ++k) {
            const float around =
                0.6283f * static_cast<float>(i) + 0.015f * static_cast<float>(k) + (i == 9 ? moved : 0);
            const float up = 1.25f - 0.02f * static_cast<float>(k);
            const glm::vec3 out(std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around));
            if (const auto hit = surface.query.raycast(middle + out * glm::length(bounds.size()), -out))
                places.push_back(hit->position);
        }
        auto line = tracedParting(surface, places);
        if (!line) continue;
        FieldStroke stroke;
        stroke.id = static_cast<std::uint32_t>(strokes.size()) + 1;
        stroke.points = std::move(*line);
        strokes.push_back(std::move(stroke));
    }
    return strokes;
}

BenchRow moving(const std::string& name, const Groom& groom) {
    Progress progress;
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    const auto solver = groomFieldSolver(groom, surface, progress), other = groomFieldSolver(groom, surface, progress);
    BenchRow row;
    row.name = "field/" + name + ", one of ten strokes moved";
    row.baseline = "the same system factorised anew";
    row.unit = "fields";
    row.items = 1;
    FieldParams params;
    params.reach = 0.3f * glm::length(surface->bounds.size());
    std::vector<std::vector<FieldStroke>> moves;
    for (int k = 0; k < 50; ++k) moves.push_back(sketch(*surface, 0.004f * static_cast<float>(k)));
    std::size_t at = 0;
    const auto ours = [&] {
        at = (at + 1) % moves.size();
        if (!solver->solve(moves[at], params, progress)) row.correct = false;
    };
    // Another reach changes every equation, so that nothing of the last factorisation holds.
    FieldParams changing = params;
    const auto anew = [&] {
        changing.reach *= 1.001f;
        if (!other->solve(moves[at], changing, progress)) row.correct = false;
    };
    const Medians medians = interleaved(ours, anew, 15);
    const auto kept = solver->solve(moves[at], params, progress), fresh = other->solve(moves[at], params, progress);
    if (!kept || !fresh || !std::ranges::equal(kept->vertices(), fresh->vertices())) row.correct = false;
    row.seconds = medians.ours;
    row.baselineSeconds = medians.baseline;
    row.note = std::to_string(groom.mesh->triangleCount()) + " triangles, hair on " +
               std::to_string(
                   std::ranges::count_if(kept->vertices(), [](const glm::vec3& d) { return d != glm::vec3(0.0f); })) +
               " vertices";
    return row;
}

}  // namespace

std::vector<BenchRow> benchField() {
    const BenchDocument bust = benchDocument("bust");
    // All of it grows, as on an animal.
    Groom ball = benchGroom();
    return {moving(bust.name, bust.groom), moving("ball", ball)};
}

}  // namespace whorl
