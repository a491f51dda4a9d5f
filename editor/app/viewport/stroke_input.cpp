// SPDX-License-Identifier: Apache-2.0
#include "editor/app/viewport/stroke_input.h"

#include "core/brushes/drawn_line.h"
#include "core/commands/strokes.h"
#include "editor/app/paint_map.h"
#include "editor/app/widgets/param_source.h"

#include <algorithm>

namespace whorl {

const BrushInfo* StrokeInput::brushFor(const EditorState& state, Qt::KeyboardModifiers modifiers) {
    const BrushInfo* brush = state.brush();
    if (brush && !brush->paintsMap && (modifiers & Qt::ShiftModifier)) {
        if (const BrushInfo* smooth = findBrush(brush->drawsStrokes ? "align_strokes" : "smooth")) return smooth;
    }
    return brush;
}

Result<void> StrokeInput::begin(const StrokeView& view, const StrokePoint& point, Qt::KeyboardModifiers modifiers) {
    drop();
    m_brush = brushFor(m_state, modifiers);
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!m_brush || !surface) return {};
    choosePaintMap(m_document, m_state, *m_brush, true);
    BrushSettings settings = m_state.brushOptions().settings(modifiers.testFlag(Qt::ControlModifier));
    if (m_brush->paintsGroups) {
        settings.map = m_document.committed().counts->groupMap.name;
        settings.strength = 1.0f;
        settings.pressureStrength = false;
        settings.value = static_cast<float>(std::max(m_state.group(), 0)) / 255.0f;
    }
    Result<Stroke> stroke = Stroke::begin(*m_brush, m_document.committed(), surface, view, settings);
    if (!stroke) return stroke.error();
    m_stroke.emplace(std::move(*stroke));
    // A press alone must already be a preview: undo and Escape then know that a stroke is on its way.
    m_stroke->moveTo(point);
    m_document.preview(m_stroke->groom());
    if (m_brush->id == "move_stroke") {
        m_state.setPickedStroke(strokeUnder(m_document.committed(), *surface, view, point.pixel, settings.radiusPixels,
                                            settings.frontOnly));
    }
    return {};
}

void StrokeInput::move(const StrokePoint& point) {
    if (m_stroke && m_stroke->moveTo(point)) m_document.preview(m_stroke->groom());
}

void StrokeInput::finish() {
    if (!m_stroke) return;
    Groom after = m_stroke->finish();
    m_stroke.reset();
    if (const std::uint32_t id = m_brush->drawsStrokes ? changedStroke(m_document.committed(), after) : 0)
        m_state.setPickedStroke(id);
    m_document.edit(std::move(after), qtext(m_brush->undoText));
}

void StrokeInput::drop() {
    if (!m_stroke) return;
    m_stroke.reset();
    m_document.revert();
}

}  // namespace whorl
