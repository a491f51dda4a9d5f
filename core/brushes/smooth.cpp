// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/guide_brush.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace whorl {
namespace {

/// Turns each segment towards the mean of its neighbours' directions; lengths stay. It has no opposite: Ctrl does the
/// same.
class SmoothBrush : public GuideBrush {
    void shape(const BrushStep&, const BrushArea&, GuideTouch& touch) const override {
        const std::span<glm::vec3> points = touch.points;
        const std::vector<glm::vec3> before(points.begin(), points.end());
        const std::size_t segments = points.size() - 1;
        const auto direction = [&](std::size_t i) {
            const glm::vec3 segment = before[i + 1] - before[i];
            const float length = glm::length(segment);
            return length > 0.0f ? segment / length : glm::vec3(0.0f);
        };
        for (std::size_t i = 0; i < segments; ++i) {
            const glm::vec3 here = direction(i);
            const glm::vec3 mean = 0.5f * (direction(i == 0 ? 0 : i - 1) + direction(std::min(i + 1, segments - 1)));
            const float weight = 0.5f * std::max(touch.weights[i], touch.weights[i + 1]);
            points[i + 1] = points[i] + (here + (mean - here) * weight) * glm::length(before[i + 1] - before[i]);
        }
        settle(points, touch.original, skin());
    }
};

}  // namespace

std::unique_ptr<Brush> makeSmooth() {
    return std::make_unique<SmoothBrush>();
}

}  // namespace whorl
