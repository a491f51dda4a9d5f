// SPDX-License-Identifier: Apache-2.0
#include "render/offscreen.h"

#include "render/gl/headless.h"
#include "render/gl/objects.h"

#include <algorithm>

namespace whorl {

// Members end in reverse order: the context last.
struct OffscreenRenderer::State {
    gl::HeadlessContext context;
    std::unique_ptr<Renderer> renderer{};
    gl::Texture colour{};
    gl::Framebuffer framebuffer{};

    ~State() { context.makeCurrent(); }
};

OffscreenRenderer::OffscreenRenderer() = default;
OffscreenRenderer::OffscreenRenderer(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer& OffscreenRenderer::operator=(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer::~OffscreenRenderer() = default;

Renderer& OffscreenRenderer::renderer() {
    m_state->context.makeCurrent();
    return *m_state->renderer;
}

Result<OffscreenRenderer> OffscreenRenderer::create() {
    Result<gl::HeadlessContext> context = gl::HeadlessContext::create();
    if (!context) return context.error();
    OffscreenRenderer offscreen;
    offscreen.m_state = std::unique_ptr<State>(new State{std::move(*context)});
    Result<std::unique_ptr<Renderer>> renderer = Renderer::create();
    if (!renderer) return renderer.error();
    offscreen.m_state->renderer = std::move(*renderer);
    return offscreen;
}

Picture OffscreenRenderer::draw(const Camera& camera, const ViewSettings& settings, const OverlayState& overlay,
                                int width, int height) {
    State& state = *m_state;
    state.context.makeCurrent();
    const glm::ivec2 size(std::clamp(width, 1, 16384), std::clamp(height, 1, 16384));
    if (!state.framebuffer || state.framebuffer.size() != size) {
        state.framebuffer = gl::Framebuffer();
        state.colour = gl::Texture::make2D("offscreen colour", gl::Format::Rgba8, size, gl::Wrap::Clamp);
        state.framebuffer = gl::Framebuffer("offscreen", &state.colour, nullptr);
    }
    state.renderer->draw(camera, settings, overlay, state.framebuffer.target(), size);
    Picture picture;
    picture.width = size.x;
    picture.height = size.y;
    picture.pixels = state.framebuffer.readPixels();
    // OpenGL's rows come from the bottom.
    const std::size_t row = static_cast<std::size_t>(size.x) * 4;
    for (int top = 0, bottom = size.y - 1; top < bottom; ++top, --bottom) {
        std::swap_ranges(picture.pixels.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(top)),
                         picture.pixels.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(top + 1)),
                         picture.pixels.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(bottom)));
    }
    return picture;
}

}  // namespace whorl
