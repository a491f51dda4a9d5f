// SPDX-License-Identifier: Apache-2.0
#include "render/passes/partings_pass.h"

#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

namespace whorl {

Result<PartingsPass> PartingsPass::create() {
    PartingsPass pass;
    Result<LineRibbons> lines = LineRibbons::create();
    if (!lines) return lines.error();
    pass.m_lines = std::move(*lines);
    return pass;
}

void PartingsPass::setGroom(const Groom& groom, Uploads& uploads) {
    if (groom.partings.sameAs(m_partings) && groom.mesh.sameAs(m_mesh)) return;
    m_partings = groom.partings;
    m_mesh = groom.mesh;
    std::vector<std::vector<glm::vec3>> lines;
    for (const Parting& parting : *m_partings) {
        std::vector<glm::vec3>& line = lines.emplace_back();
        for (std::size_t i = 0; i < parting.points.size(); ++i) {
            const glm::vec3 here = positionAt(*m_mesh, parting.points[i]);
            const glm::vec3 next = positionAt(*m_mesh, parting.points[i > 0 ? i - 1 : 1]);
            // Off the skin, so that pieces between bent triangles do not vanish in it.
            line.push_back(here + normalAt(*m_mesh, parting.points[i]) * (0.2f * glm::distance(here, next)));
        }
    }
    m_lines.set(lines, uploads);
}

void PartingsPass::draw(glm::ivec2 size) {
    m_lines.draw(size, {.root = glm::vec3(0.25f, 0.95f, 0.75f), .tip = glm::vec3(0.25f, 0.95f, 0.75f)});
}

}  // namespace whorl
