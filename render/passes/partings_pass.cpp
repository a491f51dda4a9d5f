// SPDX-License-Identifier: Apache-2.0
#include "render/passes/partings_pass.h"

#include "core/surface/surface_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <utility>

namespace whorl {

Result<PartingsPass> PartingsPass::create() {
    PartingsPass pass;
    Result<gl::Program> lines = gl::Program::draw("guides.vert.glsl", "guides.frag.glsl");
    if (!lines) return lines.error();
    pass.m_lines = std::move(*lines);
    pass.m_points = gl::Buffer("parting points");
    pass.m_indices = gl::Buffer("parting ribbons");
    return pass;
}

void PartingsPass::setGroom(const Groom& groom, Uploads& uploads) {
    if (groom.partings.sameAs(m_partings) && groom.mesh.sameAs(m_mesh)) return;
    m_partings = groom.partings;
    m_mesh = groom.mesh;
    std::vector<glm::vec4> points;
    std::vector<std::uint32_t> indices;
    for (const Parting& parting : *m_partings) {
        for (std::size_t i = 0; i < parting.points.size(); ++i) {
            const glm::vec3 here = positionAt(*m_mesh, parting.points[i]);
            const glm::vec3 next = positionAt(*m_mesh, parting.points[i > 0 ? i - 1 : 1]);
            // Off the skin, so that pieces between bent triangles do not vanish in it.
            const glm::vec3 lifted = here + normalAt(*m_mesh, parting.points[i]) * (0.2f * glm::distance(here, next));
            // Two triangles between the two vertices of a point and those of the next one.
            const auto first = static_cast<std::uint32_t>(2 * points.size());
            points.emplace_back(lifted, static_cast<float>(i) / static_cast<float>(parting.points.size() - 1));
            if (i + 1 == parting.points.size()) continue;
            for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + corner);
        }
    }
    m_indexCount = indices.size();
    if (indices.empty()) return;
    m_points.upload(points);
    m_indices.upload(indices);
    uploads.bytes += points.size() * sizeof(glm::vec4) + indices.size() * sizeof(std::uint32_t);
}

void PartingsPass::draw(glm::ivec2 size) {
    if (m_indexCount == 0) return;
    m_points.bindStorage(0);
    m_lines.set("brush", glm::vec3(0.0f));
    m_lines.set("shownHeight", static_cast<float>(glm::max(size.y, 1)));
    m_lines.set("fade", glm::vec2(1e6f, 2e6f));
    m_lines.set("halfWidth", 1.6f);
    m_lines.set("rootColour", glm::vec3(0.25f, 0.95f, 0.75f));
    m_lines.set("tipColour", glm::vec3(0.25f, 0.95f, 0.75f));
    for (const auto& [depth, opacity] : {std::pair(gl::Depth::None, 0.2f), std::pair(gl::Depth::Test, 0.9f)}) {
        gl::apply({.depth = depth, .blend = gl::Blend::Over});
        m_lines.set("opacityNear", opacity);
        m_lines.set("opacityFar", opacity);
        m_lines.use();
        m_indices.bindIndices();
        gl::drawIndexed32(m_indexCount);
    }
}

}  // namespace whorl
