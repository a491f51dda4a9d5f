// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/drawn_line.h"

#include "core/brushes/brush_index.h"
#include "core/surface/parting_line.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace whorl {
namespace {

constexpr std::size_t mostPlaces = 2000;

}  // namespace

bool DrawnLine::add(const BrushStep& step) {
    if (!step.hit || m_places.size() >= mostPlaces) return false;
    if (!m_places.empty() && glm::distance(m_places.back(), step.hit->position) < partingStep(step.surface) * 0.25f)
        return false;
    m_places.push_back(step.hit->position);
    return true;
}

Result<std::vector<SurfacePoint>> DrawnLine::traced(const Surface& surface) const {
    std::vector<glm::vec3> places = m_places;
    for (int pass = 0; pass < 2 && !places.empty(); ++pass) {
        glm::vec3 before = places.front();
        for (std::size_t i = 1; i + 1 < places.size(); ++i) {
            const glm::vec3 here = places[i];
            places[i] = (before + here * 2.0f + places[i + 1]) * 0.25f;
            before = here;
        }
    }
    return tracedParting(surface, places);
}

namespace {

float pixelsBetween(const Surface& surface, const StrokeView& view, glm::vec2 pixel, bool frontOnly,
                    std::span<const SurfacePoint> points) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const SurfacePoint& point : points) {
        const auto place = view.pixelFromGroom(positionAt(surface.mesh(), point));
        if (!place) continue;
        const float distance = glm::distance(*place, pixel);
        if (distance < nearest && (!frontOnly || rootFacesEye(surface, view, point))) nearest = distance;
    }
    return nearest;
}

}  // namespace

float pixelsTo(const BrushStep& step, std::span<const SurfacePoint> points) {
    return pixelsBetween(step.surface, step.view, step.pixel, step.settings.frontOnly, points);
}

std::uint32_t strokeUnder(const Groom& groom, const Surface& surface, const StrokeView& view, glm::vec2 pixel,
                          float radius, bool frontOnly) {
    std::uint32_t id = 0;
    for (const FieldStroke& stroke : *groom.strokes) {
        const float pixels = pixelsBetween(surface, view, pixel, frontOnly, stroke.points);
        if (pixels > radius || (id != 0 && pixels == radius)) continue;
        radius = pixels;
        id = stroke.id;
    }
    return id;
}

}  // namespace whorl
