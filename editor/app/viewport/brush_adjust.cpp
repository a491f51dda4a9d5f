// SPDX-License-Identifier: Apache-2.0
#include "editor/app/viewport/brush_adjust.h"

#include <algorithm>
#include <cmath>

namespace whorl {

void BrushAdjust::begin(What what, glm::vec2 pixel) {
    if (active()) return;
    m_what = what;
    m_start = pixel;
    m_before = m_state.brushOptions();
    m_moved = false;
}

void BrushAdjust::move(glm::vec2 pixel) {
    if (!active()) return;
    const float right = pixel.x - m_start.x;
    m_moved = m_moved || std::abs(right) > 2.0f;
    BrushOptions options = m_before;
    if (m_what == What::Size) {
        options.radius = std::clamp(m_before.radius + right, 1.0f, 2000.0f);
    } else {
        options.strength = std::clamp(m_before.strength + right / 300.0f, 0.0f, 1.0f);
    }
    m_state.setBrushOptions(options);
}

void BrushAdjust::drop() {
    if (!active()) return;
    m_what = What::None;
    m_state.setBrushOptions(m_before);
}

void BrushAdjust::keyReleased() {
    if (m_moved) keep();
}

}  // namespace whorl
