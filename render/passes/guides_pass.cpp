// SPDX-License-Identifier: Apache-2.0
#include "render/passes/guides_pass.h"

#include <glm/vec4.hpp>

namespace whorl {
namespace {

// Points with their place along the guide: exactly 0 at roots only.
std::vector<glm::vec4> pointsOf(const GuideBlock& block) {
    std::vector<glm::vec4> points(block.points.size());
    for (std::size_t guide = 0; guide < block.count(); ++guide) {
        const std::uint32_t first = block.firstPoint[guide];
        const std::uint32_t last = block.firstPoint[guide + 1];
        for (std::uint32_t i = first; i < last; ++i) {
            const float along = static_cast<float>(i - first) / static_cast<float>(std::max(last - first, 2u) - 1u);
            points[i] = glm::vec4(block.points[i], along);
        }
    }
    return points;
}

// Two triangles between the two vertices of a point and those of the next one of the same guide.
std::vector<std::uint32_t> ribbonIndices(const std::vector<std::uint32_t>& firstPoint) {
    std::vector<std::uint32_t> indices;
    for (std::size_t guide = 0; guide + 1 < firstPoint.size(); ++guide) {
        for (std::uint32_t point = firstPoint[guide]; point + 1 < firstPoint[guide + 1]; ++point) {
            for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(2 * point + corner);
        }
    }
    return indices;
}

}  // namespace

Result<GuidesPass> GuidesPass::create() {
    GuidesPass pass;
    Result<gl::Program> lines = gl::Program::draw("guides.vert.glsl", "guides.frag.glsl");
    if (!lines) return lines.error();
    Result<gl::Program> roots = gl::Program::draw("guides.vert.glsl", "guides.frag.glsl", "#define ROOTS\n");
    if (!roots) return roots.error();
    pass.m_lines = std::move(*lines);
    pass.m_roots = std::move(*roots);
    pass.m_points = gl::Buffer("guide points");
    pass.m_indices = gl::Buffer("guide ribbons");
    pass.m_rootPoints = gl::Buffer("guide roots");
    return pass;
}

void GuidesPass::setGuides(const GuideSet& guides, Uploads& uploads) {
    if (guides.sameAs(m_guides)) return;
    std::vector<std::size_t> blockStart{0};
    std::vector<std::uint32_t> firstPoint;
    for (std::size_t i = 0; i < guides.blockCount(); ++i) {
        const GuideBlock& block = guides.block(i);
        const auto start = static_cast<std::uint32_t>(blockStart.back());
        for (std::size_t guide = 0; guide < block.count(); ++guide)
            firstPoint.push_back(start + block.firstPoint[guide]);
        blockStart.push_back(blockStart.back() + block.points.size());
    }
    const std::vector<std::uint32_t> roots = firstPoint;
    firstPoint.push_back(static_cast<std::uint32_t>(blockStart.back()));
    const bool all = firstPoint != m_firstPoint || blockStart != m_blockStart;
    if (all) {
        m_points.reserve(blockStart.back() * sizeof(glm::vec4));
        const std::vector<std::uint32_t> indices = ribbonIndices(firstPoint);
        m_indices.upload(indices);
        m_indexCount = indices.size();
        m_rootPoints.upload(roots);
    }
    for (std::size_t i = 0; i < guides.blockCount(); ++i) {
        if (!all && guides.blockSameAs(i, m_guides)) continue;
        const std::vector<glm::vec4> points = pointsOf(guides.block(i));
        m_points.update(blockStart[i] * sizeof(glm::vec4), points.data(), points.size() * sizeof(glm::vec4));
        ++uploads.guideBlocks;
        uploads.bytes += points.size() * sizeof(glm::vec4);
    }
    m_blockStart = std::move(blockStart);
    m_firstPoint = std::move(firstPoint);
    m_guides = guides;
}

void GuidesPass::draw(const OverlayState& overlay, glm::ivec2 size, const GuideLook& look) {
    if (m_guides.empty()) return;
    m_points.bindStorage(0);
    gl::apply({.depth = gl::Depth::Test, .blend = gl::Blend::Over});
    // As shares of the picture, which may be drawn smaller than shown; from the bottom left, as clip space has it.
    const glm::vec2 shown(glm::max(size, glm::ivec2(1)));
    const float radius = overlay.showBrush ? overlay.brushRadius : 0.0f;
    const glm::vec3 brush(overlay.brushPixel.x / shown.x, 1.0f - overlay.brushPixel.y / shown.y, radius / shown.y);
    for (gl::Program* program : {&m_lines, &m_roots}) {
        program->set("brush", brush);
        program->set("shownHeight", shown.y);
        program->set("opacityNear", look.opacityNear);
        program->set("opacityFar", look.opacityFar);
        program->set("fade", look.fade);
    }
    m_lines.set("halfWidth", look.halfWidth);
    m_lines.set("rootColour", look.rootColour);
    m_lines.set("tipColour", look.tipColour);
    m_lines.use();
    m_indices.bindIndices();
    gl::drawIndexed32(m_indexCount);
    m_roots.set("halfWidth", look.rootRadius);
    m_roots.set("rootColour", look.dotColour);
    m_roots.set("tipColour", look.dotColour);
    m_roots.use();
    m_rootPoints.bindStorage(1);
    gl::drawTriangles(0, (m_firstPoint.size() - 1) * 6);
}

}  // namespace whorl
