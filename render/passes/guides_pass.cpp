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

constexpr std::uint32_t fewPieces = 5;

}  // namespace

GuidesPass::Lines GuidesPass::linesThrough(const std::vector<std::uint32_t>& firstPoint, std::uint32_t pieces) {
    std::vector<std::uint32_t> points;
    std::vector<std::uint32_t> indices;
    for (std::size_t guide = 0; guide + 1 < firstPoint.size(); ++guide) {
        const std::uint32_t last = firstPoint[guide + 1] - firstPoint[guide] - 1;
        const std::uint32_t steps = std::min(last, pieces);
        for (std::uint32_t step = 0; step <= steps; ++step) {
            const auto vertex = static_cast<std::uint32_t>(2 * points.size());
            points.push_back(firstPoint[guide] + (steps > 0 ? step * last / steps : 0));
            if (step == steps) continue;
            for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(vertex + corner);
        }
    }
    Lines lines{gl::Buffer("drawn guide points"), gl::Buffer("guide ribbons"), indices.size()};
    lines.points.upload(points);
    lines.indices.upload(indices);
    return lines;
}

Result<GuidesPass> GuidesPass::create() {
    GuidesPass pass;
    Result<gl::Program> lines = gl::Program::draw("guides.vert.glsl", "guides.frag.glsl");
    if (!lines) return lines.error();
    Result<gl::Program> roots = gl::Program::draw("guides.vert.glsl", "guides.frag.glsl", "#define ROOTS\n");
    if (!roots) return roots.error();
    pass.m_lines = std::move(*lines);
    pass.m_roots = std::move(*roots);
    pass.m_points = gl::Buffer("guide points");
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
        m_all = linesThrough(firstPoint, 0xffffffffu);
        m_few = linesThrough(firstPoint, fewPieces);
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

void GuidesPass::draw(const OverlayState& overlay, glm::ivec2 size, glm::vec2 fade, bool coarse) {
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
        program->set("opacityNear", 0.6f);
        program->set("opacityFar", 0.07f);
        program->set("fade", fade);
    }
    m_lines.set("halfWidth", 0.6f);
    m_lines.set("rootColour", glm::vec3(0.95f, 0.42f, 0.08f));
    m_lines.set("tipColour", glm::vec3(1.0f, 0.85f, 0.35f));
    m_lines.use();
    const Lines& lines = coarse ? m_few : m_all;
    lines.points.bindStorage(1);
    lines.indices.bindIndices();
    gl::drawIndexed32(lines.indexCount);
    m_roots.set("halfWidth", 1.5f);
    m_roots.set("rootColour", glm::vec3(0.10f, 0.75f, 0.95f));
    m_roots.set("tipColour", glm::vec3(0.10f, 0.75f, 0.95f));
    m_roots.use();
    m_rootPoints.bindStorage(1);
    gl::drawTriangles(0, (m_firstPoint.size() - 1) * 6);
}

}  // namespace whorl
