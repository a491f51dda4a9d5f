// SPDX-License-Identifier: Apache-2.0
// Pictures without a window.
#pragma once

#include "render/renderer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace whorl {

/// RGBA, 8 bit sRGB, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// A surfaceless EGL context (no display needed) with a Renderer in it.
class OffscreenRenderer {
public:
    static Result<OffscreenRenderer> create();
    OffscreenRenderer(OffscreenRenderer&&) noexcept;
    OffscreenRenderer& operator=(OffscreenRenderer&&) noexcept;
    ~OffscreenRenderer();

    Renderer& renderer();
    /// 1 to 16,384 pixels a side.
    Picture draw(const Camera& camera, const ViewSettings& settings, const OverlayState& overlay, int width,
                 int height);

private:
    OffscreenRenderer();
    struct State;
    std::unique_ptr<State> m_state;
};

}  // namespace whorl
