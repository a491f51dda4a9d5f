// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_list.h"
#include "core/brushes/drawn_line.h"

#include <algorithm>

namespace whorl {
namespace {

/// Draws one stroke of a kind; with Ctrl it erases the strokes that it meets. A whorl is one place: it follows the
/// pointer until it is let go. The brush's radius is that of the kinds that have one.
class StrokeBrush : public Brush {
public:
    explicit StrokeBrush(StrokeKind kind) : m_kind(kind) {}

private:
    Result<void> begin(const Groom& groom, const BrushSettings& settings) override {
        if (!settings.invert && groom.strokes->size() >= FieldStroke::maxStrokes)
            return Error{"A groom has at most " + std::to_string(FieldStroke::maxStrokes) +
                         " strokes; erase some with Ctrl first."};
        return {};
    }

    void step(BrushStep& step) override {
        if (!(step.strength > 0.0f)) return;
        if (step.settings.invert) {
            erase(step);
        } else {
            draw(step);
        }
    }

    void draw(BrushStep& step) {
        if (!m_line.add(step)) return;
        std::vector<SurfacePoint> points;
        if (turns(m_kind) || (m_kind != StrokeKind::Along && m_line.size() == 1)) {
            points.push_back(step.hit->point);
        } else {
            if (m_line.size() < 2) return;
            auto line = m_line.traced(step.surface);
            if (!line) return;
            points = std::move(*line);
        }
        const std::vector<FieldStroke>& strokes = *step.groom.strokes;
        auto own = std::ranges::find(strokes, m_id, &FieldStroke::id);
        if (m_id == 0 || own == strokes.end()) {
            // The mirror image may have taken the last place.
            if (strokes.size() >= FieldStroke::maxStrokes) return;
            FieldStroke stroke;
            stroke.id = m_id = nextStrokeId(strokes);
            stroke.kind = kindHere(step);
            if (m_kind != StrokeKind::Along)
                stroke.radius =
                    std::min(step.radiusPixels * step.view.metresPerPixel(step.hit->position), FieldStroke::maxRadius);
            stroke.points = std::move(points);
            step.groom.strokes.edit().push_back(std::move(stroke));
        } else {
            if (own->points == points) return;
            const auto place = own - strokes.begin();
            step.groom.strokes.edit()[static_cast<std::size_t>(place)].points = std::move(points);
        }
        step.changed = true;
    }

    // A mirror turns whorls the other way.
    StrokeKind kindHere(const BrushStep& step) const {
        return m_kind == StrokeKind::Whorl && step.mirrored ? StrokeKind::ClockwiseWhorl : m_kind;
    }

    static void erase(BrushStep& step) {
        const auto under = [&](const FieldStroke& stroke) {
            return pixelsTo(step, stroke.points) <= step.radiusPixels;
        };
        if (std::ranges::none_of(*step.groom.strokes, under)) return;
        std::erase_if(step.groom.strokes.edit(), under);
        step.changed = true;
    }

    StrokeKind m_kind;
    DrawnLine m_line;
    std::uint32_t m_id = 0;
};

}  // namespace

std::unique_ptr<Brush> makeSketch() {
    return std::make_unique<StrokeBrush>(StrokeKind::Along);
}
std::unique_ptr<Brush> makeAttract() {
    return std::make_unique<StrokeBrush>(StrokeKind::Attract);
}
std::unique_ptr<Brush> makeRepel() {
    return std::make_unique<StrokeBrush>(StrokeKind::Repel);
}
std::unique_ptr<Brush> makeWhorl() {
    return std::make_unique<StrokeBrush>(StrokeKind::Whorl);
}

}  // namespace whorl
