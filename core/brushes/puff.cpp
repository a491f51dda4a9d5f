// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/guide_brush.h"

#include <glm/geometric.hpp>

#include <vector>

namespace whorl {
namespace {

/// Turns every segment of a guide under the brush towards the skin's normal at its root, or away from it.
class PuffBrush : public GuideBrush {
    void shape(const BrushStep& step, const BrushArea&, GuideTouch& touch) const override {
        const glm::vec3 normal = normalAt(step.surface.mesh(), step.groom.guides.root(touch.guide));
        const std::span<glm::vec3> points = touch.points;
        const std::vector<glm::vec3> before(points.begin(), points.end());
        const float turn = 0.15f * touch.largest;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const glm::vec3 segment = before[i + 1] - before[i];
            const float length = glm::length(segment);
            const glm::vec3 wish =
                step.settings.invert ? segment - normal * glm::dot(segment, normal) : normal * length;
            points[i + 1] = points[i] + segment + (wish - segment) * turn;
        }
        settle(points, touch.original, skin());
    }
};

}  // namespace

std::unique_ptr<Brush> makePuff() {
    return std::make_unique<PuffBrush>();
}

}  // namespace whorl
