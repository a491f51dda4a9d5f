// SPDX-License-Identifier: Apache-2.0
// Brush circle and hints over the picture, by Dear ImGui.
#pragma once

#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/view_settings.h"

#include <glm/vec2.hpp>

struct ImGuiContext;

namespace whorl {

class OverlayPass {
public:
    static Result<OverlayPass> create();
    OverlayPass(OverlayPass&& other) noexcept;
    OverlayPass& operator=(OverlayPass&& other) noexcept;
    ~OverlayPass();

    /// Into the bound target of `size` pixels.
    void draw(const OverlayState& overlay, glm::ivec2 size);

private:
    OverlayPass() = default;
    ImGuiContext* m_context = nullptr;
    gl::Program m_program;
    gl::Buffer m_vertices;
    gl::Buffer m_indices;
    gl::Texture m_font;
};

}  // namespace whorl
