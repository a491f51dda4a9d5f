// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/cut.h"
#include "core/brushes/guide_brush.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

/// Lengthens a guide at its tip, or shortens it there. The length is the original one times e to the sum of the steps,
/// always taken from the original curve: growing and shrinking undo each other, and no step smears the shape.
class GrowBrush : public GuideBrush {
    bool prepare(const BrushStep& step, const BrushArea&) override {
        m_stub = stubLength(step.surface);
        m_longest = longestLength(step.surface);
        return true;
    }

    float gather(const BrushStep& step, float largest) const override {
        return largest * (step.settings.invert ? -0.06f : 0.06f);
    }

    void shape(const BrushStep&, const BrushArea&, GuideTouch& touch) const override {
        const float before = curveLength(touch.original);
        const float shortest = std::min(before, m_stub), longest = std::max(before, m_longest);
        const float length = std::clamp(before * std::exp(std::clamp(touch.amount, -20.0f, 20.0f)), shortest, longest);
        withLength(touch.original, length, touch.points);
        float along = 0.0f;
        for (std::size_t i = 1; i < touch.points.size(); ++i) {
            along += length / static_cast<float>(touch.points.size() - 1);
            touch.points[i] = pushOut(touch.points[i], along, skin());
        }
    }

    float m_stub = 0.0f;
    float m_longest = 0.0f;
};

}  // namespace

std::unique_ptr<Brush> makeGrow() {
    return std::make_unique<GrowBrush>();
}

}  // namespace whorl
