// SPDX-License-Identifier: Apache-2.0
#include "editor/app/viewport/navigation.h"

#include <cmath>

namespace whorl {

Navigation::Mode Navigation::modeFor(NavigationStyle style, Qt::MouseButton button, Qt::KeyboardModifiers modifiers,
                                     bool looking) {
    if (modifiers & Qt::AltModifier) {
        if (button == Qt::LeftButton) return Mode::Orbit;
        if (button == Qt::MiddleButton) return Mode::Pan;
        if (button == Qt::RightButton) return Mode::Zoom;
    }
    if (style == NavigationStyle::Blender && button == Qt::MiddleButton) {
        if (modifiers & Qt::ShiftModifier) return Mode::Pan;
        if (modifiers & Qt::ControlModifier) return Mode::Zoom;
        return Mode::Orbit;
    }
    if (looking && button == Qt::LeftButton) {
        if (modifiers & Qt::ShiftModifier) return Mode::Pan;
        if (modifiers & Qt::ControlModifier) return Mode::Zoom;
        return Mode::Orbit;
    }
    return Mode::None;
}

void Navigation::begin(Mode mode, glm::vec2 pixel) {
    m_mode = mode;
    m_pixel = pixel;
}

bool Navigation::move(Camera& camera, glm::vec2 pixel, glm::vec2 viewportPixels) {
    const glm::vec2 delta = pixel - m_pixel;
    m_pixel = pixel;
    if (m_mode == Mode::None || (delta.x == 0.0f && delta.y == 0.0f)) return false;
    switch (m_mode) {
        case Mode::Orbit:
            camera.orbit(delta);
            break;
        case Mode::Pan:
            camera.pan(delta, viewportPixels);
            break;
        case Mode::Zoom:
            camera.zoom(std::exp((delta.x - delta.y) * 0.005f));
            break;
        case Mode::None:
            break;
    }
    return true;
}

float Navigation::wheelFactor(int angle) {
    return std::exp(static_cast<float>(angle) * 0.0012f);
}

}  // namespace whorl
