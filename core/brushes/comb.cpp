// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/guide_brush.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

/// Points under the brush go with the pointer, in the plane facing the camera at their own depth. A tooth of the comb
/// carries everything beyond it: from the strongest point on, the weight does not fall again towards the tip, and past
/// the brush the rest of the hair follows the last brushed point.
class CombBrush : public GuideBrush {
    bool prepare(const BrushStep& step, const BrushArea&) override { return step.pixel != step.previousPixel; }

    void shape(const BrushStep& step, const BrushArea& area, GuideTouch& touch) const override {
        const glm::vec2 pixels = step.pixel - step.previousPixel;
        const std::span<glm::vec3> points = touch.points;
        std::size_t first = 0, last = 0;  // brushed points
        for (std::size_t i = 1; i < points.size(); ++i) {
            if (!(touch.weights[i] > 0.0f)) continue;
            if (first == 0) first = i;
            last = i;
        }
        if (first == 0) return;
        glm::vec3 old = points[0];  // the previous point before this step
        glm::vec3 direction(0.0f, 1.0f, 0.0f);
        float weight = 0.0f;
        SkinWalk walk{skin()};
        for (std::size_t i = 1; i < points.size(); ++i) {
            const glm::vec3 here = points[i];
            const float length = glm::length(touch.original[i] - touch.original[i - 1]);
            glm::vec3 target = here;
            if (i >= first && i <= last) {
                weight = std::max(weight, touch.weights[i]);
                target = here + area.frame.movement(pixels * weight, std::max(area.frame.depth(here), 0.0f));
            } else if (i > last) {
                target = points[i - 1] + (here - old);
            }
            // Untouched points before the brush stay as they are, bit for bit.
            const bool stays = i < first;
            if (step.settings.keepLength && !stays) {
                points[i] = placeNext(walk, points[i - 1], target, direction, length);
            } else {
                walk.along += length;
                if (!stays) points[i] = pushOut(target, walk.along, skin());
            }
            const glm::vec3 segment = points[i] - points[i - 1];
            if (glm::dot(segment, segment) > 1e-30f) direction = segment;
            old = here;
        }
    }
};

}  // namespace

std::unique_ptr<Brush> makeComb() {
    return std::make_unique<CombBrush>();
}

}  // namespace whorl
