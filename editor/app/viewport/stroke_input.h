// SPDX-License-Identifier: Apache-2.0
// From a press to a release of the pointer: one stroke of the brush, one step of the history.
#pragma once

#include "core/brushes/brush.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"

#include <Qt>
#include <optional>

namespace whorl {

class StrokeInput {
public:
    StrokeInput(Document& document, EditorState& state) : m_document(document), m_state(state) {}

    /// Starts a stroke with the picked brush (Shift: the brush that smooths; Ctrl: the opposite). A brush that paints
    /// chooses or makes its map first. The error is a sentence of the brush, for the artist.
    Result<void> begin(const StrokeView& view, const StrokePoint& point, Qt::KeyboardModifiers modifiers);
    void move(const StrokePoint& point);
    /// Ends the stroke: one step in the history when it changed anything.
    void finish();
    /// Everything is as it was before the stroke.
    void drop();
    bool active() const { return m_stroke.has_value(); }
    /// The brush that a press with these modifiers would use; may be null.
    static const BrushInfo* brushFor(const EditorState& state, Qt::KeyboardModifiers modifiers);

private:
    Document& m_document;
    EditorState& m_state;
    std::optional<Stroke> m_stroke;
    const BrushInfo* m_brush = nullptr;
};

}  // namespace whorl
