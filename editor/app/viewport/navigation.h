// SPDX-License-Identifier: Apache-2.0
// Which button and key move the camera, in the way the artist knows.
#pragma once

#include "editor/app/editor_state.h"
#include "render/camera.h"

#include <glm/vec2.hpp>

#include <Qt>

namespace whorl {

/// One drag of the camera.
class Navigation {
public:
    enum class Mode { None, Orbit, Pan, Zoom };

    /// What this press starts. `looking`: no brush is picked, so the left button is free.
    static Mode modeFor(NavigationStyle style, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, bool looking);

    void begin(Mode mode, glm::vec2 pixel);
    /// True when the camera moved.
    bool move(Camera& camera, glm::vec2 pixel, glm::vec2 viewportPixels);
    void end() { m_mode = Mode::None; }
    bool active() const { return m_mode != Mode::None; }

    /// Factor of Camera::zoom for a turn of the wheel (eighths of a degree).
    static float wheelFactor(int angle);

private:
    Mode m_mode = Mode::None;
    glm::vec2 m_pixel{0.0f};
};

}  // namespace whorl
