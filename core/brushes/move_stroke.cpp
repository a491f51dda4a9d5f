// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/drawn_line.h"
#include "core/surface/parting_line.h"

#include <algorithm>

namespace whorl {
namespace {

/// Carries the stroke that lies nearest to where the pointer went down over the skin. With Ctrl a copy of it.
class MoveStrokeBrush : public Brush {
    void step(BrushStep& step) override {
        if (!step.hit || !(step.strength > 0.0f)) return;
        if (m_id == 0) {
            pick(step);
        } else {
            carry(step);
        }
    }

    void pick(BrushStep& step) {
        if (m_missed) return;
        m_id = strokeUnder(step.groom, step.surface, step.view, step.pixel, step.radiusPixels, step.settings.frontOnly);
        m_missed = m_id == 0;
        if (m_missed) return;
        const auto picked = std::ranges::find(*step.groom.strokes, m_id, &FieldStroke::id);
        m_from = *step.hit;
        m_start.clear();
        for (const SurfacePoint& point : picked->points) m_start.push_back(positionAt(step.surface.mesh(), point));
        if (!step.settings.invert || step.groom.strokes->size() >= FieldStroke::maxStrokes) return;
        FieldStroke copy = *picked;
        m_id = copy.id = nextStrokeId(*step.groom.strokes);
        step.groom.strokes.edit().push_back(std::move(copy));
        step.changed = true;
    }

    // As a whole from where it was picked, turned along with the skin, then down onto the skin.
    void carry(BrushStep& step) {
        const std::vector<FieldStroke>& strokes = *step.groom.strokes;
        const auto own = std::ranges::find(strokes, m_id, &FieldStroke::id);
        if (own == strokes.end()) return;
        const SurfaceMesh& mesh = step.surface.mesh();
        const glm::mat3 turn = minimalRotation(normalAt(mesh, m_from.point), normalAt(mesh, step.hit->point));
        std::vector<glm::vec3> places;
        for (const glm::vec3& place : m_start) places.push_back(step.hit->position + turn * (place - m_from.position));
        std::vector<SurfacePoint> points;
        if (places.size() == 1) {
            points.push_back(step.hit->point);
        } else {
            auto line = tracedParting(step.surface, places);
            if (!line) return;
            points = std::move(*line);
        }
        if (own->points == points) return;
        step.groom.strokes.edit()[static_cast<std::size_t>(own - strokes.begin())].points = std::move(points);
        step.changed = true;
    }

    std::uint32_t m_id = 0;
    bool m_missed = false;
    SurfaceHit m_from{};
    std::vector<glm::vec3> m_start;
};

}  // namespace

std::unique_ptr<Brush> makeMoveStroke() {
    return std::make_unique<MoveStrokeBrush>();
}

}  // namespace whorl
