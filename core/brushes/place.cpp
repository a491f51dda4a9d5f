// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/guide_shape.h"
#include "core/brushes/stroke_scratch.h"

#include <algorithm>

namespace whorl {
namespace {

/// Adds a guide under the cursor where no root is nearer than the brush's radius, so that one stroke fills an area
/// evenly and a click sets exactly one.
class PlaceBrush : public Brush {
    void step(BrushStep& step) override {
        if (step.settings.invert) {
            if (!m_delete) m_delete = makeDelete();
            m_delete->step(step);
            return;
        }
        if (!(step.strength > 0.0f) || !step.hit) return;
        Groom& groom = step.groom;
        const SurfaceMesh& mesh = step.surface.mesh();
        if (!groom.growsHair(partOfTriangle(mesh, step.hit->point.triangle))) return;
        const glm::vec3 position = positionAt(mesh, step.hit->point);
        const float spacing = step.radiusPixels * step.view.metresPerPixel(position);
        const NearestRoot nearest = nearestRoot(groom.guides, position);
        if (nearest.distance < std::max(spacing, 1e-9f)) return;
        const std::uint8_t group = groom.guides.empty() ? std::uint8_t{0} : groom.guides.group(nearest.guide);
        groom.guides.append(step.hit->point, group, guideShapeAt(groom, step.surface, step.hit->point, group, 0.0f));
        step.scratch->guides.forget();
        step.changed = true;
    }

    std::unique_ptr<Brush> m_delete;
};

}  // namespace

std::unique_ptr<Brush> makePlace() {
    return std::make_unique<PlaceBrush>();
}

}  // namespace whorl
