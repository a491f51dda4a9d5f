// SPDX-License-Identifier: Apache-2.0
#include "core/commands/strokes.h"

#include "core/field/groom_field.h"
#include "core/surface/parting_line.h"

#include <algorithm>

namespace whorl {
namespace {

Error noStroke(std::uint32_t id) {
    return {"There is no stroke " + std::to_string(id) + "."};
}

Result<std::vector<SurfacePoint>> placesOn(const Surface& surface, std::span<const glm::vec3> points) {
    if (points.size() != 1) return tracedParting(surface, points);
    const auto hit = surface.query.nearest(points.front());
    if (!hit) return Error{"The mesh has no skin to draw a stroke on."};
    return std::vector<SurfacePoint>{hit->point};
}

Result<void> check(const FieldStroke& stroke) {
    if (!(stroke.weight >= FieldStroke::minWeight && stroke.weight <= FieldStroke::maxWeight))
        return Error{"The weight of a stroke must be from 0.01 to 100."};
    if (!(stroke.radius >= 0.0f && stroke.radius <= FieldStroke::maxRadius))
        return Error{"The radius of a stroke must be from 0 to 1000 metres."};
    if (stroke.points.size() < stroke.fewestPoints()) return Error{"A stroke along hair needs two places."};
    return {};
}

}  // namespace

Result<std::uint32_t> addStroke(Groom& groom, const Surface& surface, StrokeKind kind,
                                std::span<const glm::vec3> points, float weight, float radius) {
    if (groom.strokes->size() >= FieldStroke::maxStrokes)
        return Error{"A groom has at most " + std::to_string(FieldStroke::maxStrokes) + " strokes; remove some first."};
    auto places = placesOn(surface, points);
    if (!places) return places.error();
    FieldStroke stroke{nextStrokeId(*groom.strokes), kind, weight, radius, std::move(*places)};
    if (auto right = check(stroke); !right) return right.error();
    const std::uint32_t id = stroke.id;
    groom.strokes.edit().push_back(std::move(stroke));
    return id;
}

const FieldStroke* findStroke(const Groom& groom, std::uint32_t id) {
    const auto found = std::ranges::find(*groom.strokes, id, &FieldStroke::id);
    return found != groom.strokes->end() ? &*found : nullptr;
}

Result<void> removeStroke(Groom& groom, std::uint32_t id) {
    if (!findStroke(groom, id)) return noStroke(id);
    std::erase_if(groom.strokes.edit(), [&](const FieldStroke& stroke) { return stroke.id == id; });
    return {};
}

Result<void> changeStroke(Groom& groom, const FieldStroke& stroke) {
    const FieldStroke* const own = findStroke(groom, stroke.id);
    if (!own) return noStroke(stroke.id);
    if (auto right = check(stroke); !right) return right;
    if (*own == stroke) return {};
    const auto place = static_cast<std::size_t>(own - groom.strokes->data());
    groom.strokes.edit()[place] = stroke;
    return {};
}

Result<void> moveStroke(Groom& groom, const Surface& surface, std::uint32_t id, const glm::vec3& offset) {
    const FieldStroke* const own = findStroke(groom, id);
    if (!own) return noStroke(id);
    std::vector<glm::vec3> points;
    for (const SurfacePoint& point : own->points) points.push_back(positionAt(surface.mesh(), point) + offset);
    auto places = placesOn(surface, points);
    if (!places) return places.error();
    FieldStroke moved = *own;
    moved.points = std::move(*places);
    return changeStroke(groom, moved);
}

std::uint32_t changedStroke(const Groom& before, const Groom& after) {
    if (after.strokes.sameAs(before.strokes)) return 0;
    for (const FieldStroke& stroke : *after.strokes) {
        const FieldStroke* const was = findStroke(before, stroke.id);
        if (!was || !(*was == stroke)) return stroke.id;
    }
    return 0;
}

Result<void> makeStrokesOfGuides(Groom& groom, std::shared_ptr<const Surface> surface, int group, Progress& progress) {
    const auto all = agreedStrokes(groom, std::move(surface), group, progress);
    if (!all) return all.error();
    if (all->empty()) return Error{"No guide lies along the skin; place and comb guides first."};
    const std::size_t every = (all->size() + FieldStroke::maxStrokes - 1) / FieldStroke::maxStrokes;
    std::vector<FieldStroke> strokes;
    for (std::size_t i = 0; i < all->size(); i += every) {
        strokes.push_back((*all)[i]);
        strokes.back().id = static_cast<std::uint32_t>(strokes.size());
    }
    groom.strokes = Cow<std::vector<FieldStroke>>(std::move(strokes));
    if (groom.field->follow) groom.field.edit().follow = false;
    return {};
}

}  // namespace whorl
