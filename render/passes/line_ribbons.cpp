// SPDX-License-Identifier: Apache-2.0
#include "render/passes/line_ribbons.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <utility>

namespace whorl {

Result<LineRibbons> LineRibbons::create() {
    LineRibbons ribbons;
    Result<gl::Program> lines = gl::Program::draw("guides.vert.glsl", "guides.frag.glsl");
    if (!lines) return lines.error();
    ribbons.m_lines = std::move(*lines);
    ribbons.m_points = gl::Buffer("line points");
    ribbons.m_indices = gl::Buffer("line ribbons");
    return ribbons;
}

void LineRibbons::set(std::span<const std::vector<glm::vec3>> lines, Uploads& uploads) {
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> indices;
    for (const std::vector<glm::vec3>& line : lines) {
        if (line.size() < 2) continue;
        for (std::size_t i = 0; i < line.size(); ++i) {
            // Two triangles between the two vertices of a point and those of the next one.
            const auto first = static_cast<std::uint32_t>(2 * points.size());
            points.emplace_back(line[i], static_cast<float>(i) / static_cast<float>(line.size() - 1));
            if (i + 1 == line.size()) continue;
            for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
        }
    }
    m_indexCount = indices.size();
    if (indices.empty()) return;
    m_points.upload(points);
    m_indices.upload(indices);
    uploads.bytes += points.size() * sizeof(glm::vec4) + indices.size() * sizeof(std::uint32_t);
}

void LineRibbons::draw(glm::ivec2 size, const Look& look) {
    if (m_indexCount == 0) return;
    m_points.bindStorage(0);
    m_lines.set("brush", glm::vec3(0.0f));
    m_lines.set("shownHeight", static_cast<float>(glm::max(size.y, 1)));
    m_lines.set("fade", glm::vec2(1e6f, 2e6f));
    m_lines.set("halfWidth", look.halfWidth);
    m_lines.set("rootColour", look.root);
    m_lines.set("tipColour", look.tip);
    for (const auto& [depth, opacity] :
         {std::pair(gl::Depth::None, look.hiddenOpacity), std::pair(gl::Depth::Test, look.opacity)}) {
        gl::apply({.depth = depth, .blend = gl::Blend::Over});
        m_lines.set("opacityNear", opacity);
        m_lines.set("opacityFar", opacity);
        m_lines.use();
        m_indices.bindIndices();
        gl::drawIndexed32(m_indexCount);
    }
}

}  // namespace whorl
