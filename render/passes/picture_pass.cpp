// SPDX-License-Identifier: Apache-2.0
#include "render/passes/picture_pass.h"

#include <algorithm>

namespace whorl {

Result<PicturePass> PicturePass::create() {
    PicturePass pass;
    Result<gl::Program> background = gl::Program::draw("screen.vert.glsl", "background.frag.glsl");
    if (!background) return background.error();
    Result<gl::Program> finish = gl::Program::draw("screen.vert.glsl", "finish.frag.glsl");
    if (!finish) return finish.error();
    Result<gl::Program> layer = gl::Program::draw("screen.vert.glsl", "layer.frag.glsl");
    if (!layer) return layer.error();
    pass.m_layerProgram = std::move(*layer);
    pass.m_background = std::move(*background);
    pass.m_finish = std::move(*finish);
    return pass;
}

void PicturePass::begin(glm::ivec2 size, int samples) {
    if (!m_target || m_target.size() != size || m_samples != samples) {
        m_target = gl::Framebuffer();
        m_resolvedTarget = gl::Framebuffer();
        m_samples = samples;
        m_colour = gl::Texture::make2D("picture", gl::Format::Rgba16F, size, gl::Wrap::Clamp, false, samples);
        m_depth = gl::Texture::make2D("picture depth", gl::Format::Depth32F, size, gl::Wrap::Clamp, false, samples);
        m_target = gl::Framebuffer("picture", &m_colour, &m_depth);
        if (samples > 1) {
            m_resolved = gl::Texture::make2D("resolved picture", gl::Format::Rgba16F, size, gl::Wrap::Clamp);
            m_resolvedDepth = gl::Texture::make2D("resolved depth", gl::Format::Depth32F, size, gl::Wrap::Clamp);
            m_resolvedTarget = gl::Framebuffer("resolved picture", &m_resolved, &m_resolvedDepth);
        }
    }
    m_isResolved = samples <= 1;
    m_target.bind();
    m_target.clearDepth();
}

std::span<const float> PicturePass::resolveDepth() {
    if (!m_isResolved) m_target.resolveTo(m_resolvedTarget, true);
    m_isResolved = true;
    const glm::ivec2 size = m_target.size();
    m_depths.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    (m_samples > 1 ? m_resolvedDepth : m_depth).read(m_depths.data(), m_depths.size() * sizeof(float));
    return m_depths;
}

void PicturePass::drawLayer(const StrandRaster& layer) {
    const StrandRaster::Region region = layer.region();
    if (region.width == 0) return;
    const glm::ivec2 size = m_target.size();
    if (!m_layer || glm::ivec2(m_layer.size()) != size) {
        m_layer = gl::Texture::make2D("layer", gl::Format::Rgba16, size, gl::Wrap::Clamp);
    }
    m_layer.upload({region.x, region.y}, {region.width, region.height}, layer.texels(), size.x);
    (m_samples > 1 ? m_resolvedTarget : m_target).bind();
    m_layer.bind(0);
    m_layerProgram.set("brightest", StrandRaster::brightest);
    m_layerProgram.use();
    gl::scissor({region.x, region.y, region.width, region.height});
    gl::apply({.depth = gl::Depth::None, .blend = gl::Blend::OverPremultiplied});
    gl::drawTriangles(0, 3);
    gl::noScissor();
}

void PicturePass::drawBackground(const ViewSettings& settings) {
    m_background.set("centreColour", settings.background);
    const glm::ivec2 size = m_target.size();
    m_background.set("aspect", static_cast<float>(size.x) / static_cast<float>(std::max(size.y, 1)));
    m_background.use();
    gl::apply({.depth = gl::Depth::None});
    gl::drawTriangles(0, 3);
}

void PicturePass::finish(const ViewSettings& settings, unsigned target, glm::ivec2 size) {
    if (!m_isResolved) m_target.resolveTo(m_resolvedTarget);
    const bool scaled = size != m_target.size();
    if (scaled) {
        if (!m_smallTarget || m_smallTarget.size() != m_target.size()) {
            m_smallTarget = gl::Framebuffer();
            m_small = gl::Texture::make2D("finished picture", gl::Format::Rgba8, m_target.size(), gl::Wrap::Clamp);
            m_smallTarget = gl::Framebuffer("finished picture", &m_small, nullptr);
        }
        m_smallTarget.bind();
    } else {
        gl::bindTarget(target, size);
    }
    (m_samples > 1 ? m_resolved : m_colour).bind(0);
    m_finish.set("exposure", std::max(settings.exposure, 0.0f));
    m_finish.use();
    gl::apply({.depth = gl::Depth::None});
    gl::drawTriangles(0, 3);
    if (scaled) {
        m_smallTarget.stretchTo(target, size);
        gl::bindTarget(target, size);
    }
}

}  // namespace whorl
