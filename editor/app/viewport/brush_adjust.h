// SPDX-License-Identifier: Apache-2.0
// Size and strength of the brush by a held key and a move of the pointer.
#pragma once

#include "editor/app/editor_state.h"

#include <glm/vec2.hpp>

namespace whorl {

/// F, B or Shift+F: the circle stays where the pointer was, moving right makes it larger (or stronger). Releasing the
/// key after a move, or a click, keeps the value; Escape brings the old one back.
class BrushAdjust {
public:
    enum class What { None, Size, Strength };

    explicit BrushAdjust(EditorState& state) : m_state(state) {}
    void begin(What what, glm::vec2 pixel);
    void move(glm::vec2 pixel);
    void keep() { m_what = What::None; }
    void drop();
    /// The key was let go: keeps the value if the pointer moved, else waits for a click.
    void keyReleased();
    bool active() const { return m_what != What::None; }
    What what() const { return m_what; }
    glm::vec2 centre() const { return m_start; }

private:
    EditorState& m_state;
    What m_what = What::None;
    glm::vec2 m_start{0.0f};
    BrushOptions m_before;
    bool m_moved = false;
};

}  // namespace whorl
