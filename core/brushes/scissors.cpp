// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/cut.h"
#include "core/brushes/guide_brush.h"

#include <algorithm>
#include <array>
#include <vector>

namespace whorl {
namespace {

/// Removes what lies beyond the first place inside the brush. Scissors cut clean at any strength above zero: half a cut
/// is not something that an artist expects of them. Guides of a group share their number of points, so a cut guide is
/// the same curve, shorter, with the same number.
class ScissorsBrush : public GuideBrush {
    bool prepare(const BrushStep& step, const BrushArea&) override {
        m_stub = stubLength(step.surface);
        return true;
    }

    void shape(const BrushStep&, const BrushArea& area, GuideTouch& touch) const override {
        const std::optional<float> inside = firstInside(area, touch.points);
        if (!inside) return;
        const float length = curveLength(touch.points);
        const float cut = std::max(*inside, m_stub);
        // A tip that lies on the border of the brush was cut there by the step before.
        if (cut >= length * 0.9999f) return;
        const std::vector<glm::vec3> whole(touch.points.begin(), touch.points.end());
        withLength(whole, cut, touch.points);
    }

    float m_stub = 0.0f;
};

/// Ctrl turns scissors into their opposite.
class ScissorsOrGrow : public Brush {
    Result<void> begin(const Groom& groom, const BrushSettings& settings) override {
        m_settings = settings;
        m_brush = settings.invert ? makeGrow() : std::make_unique<ScissorsBrush>();
        m_settings.invert = false;
        return m_brush->begin(groom, m_settings);
    }
    void step(BrushStep& step) override {
        BrushStep inner{.groom = step.groom,
                        .surface = step.surface,
                        .view = step.view,
                        .settings = m_settings,
                        .pixel = step.pixel,
                        .previousPixel = step.previousPixel,
                        .hit = step.hit,
                        .radiusPixels = step.radiusPixels,
                        .strength = step.strength,
                        .mirrored = step.mirrored,
                        .scratch = step.scratch};
        m_brush->step(inner);
        step.changed = inner.changed;
    }

    BrushSettings m_settings;
    std::unique_ptr<Brush> m_brush;
};

}  // namespace

std::unique_ptr<Brush> makeScissors() {
    return std::make_unique<ScissorsOrGrow>();
}

}  // namespace whorl
