// SPDX-License-Identifier: Apache-2.0
#include "core/lic/live_texture.h"

#include "core/field/growing_area.h"

namespace whorl {
namespace {

bool growthDiffers(const Groom& a, const Groom& b) {
    return !a.mesh.sameAs(b.mesh) || !a.partSettings.sameAs(b.partSettings) || !a.maps.sameAs(b.maps) ||
           !a.groups.sameAs(b.groups) || !a.counts.sameAs(b.counts);
}

bool guidesLead(const Groom& groom) {
    return groom.strokes->empty() || groom.field->follow;
}

/// Of the solver's answer, not of the solver.
bool strokesDiffer(const Groom& a, const Groom& b) {
    if (!a.field.sameAs(b.field) || !a.strokes.sameAs(b.strokes)) return true;
    return guidesLead(b) && !a.guides.sameAs(b.guides);
}

}  // namespace

bool LiveTexture::differs(const Groom& a, const Groom& b) {
    return growthDiffers(a, b) || !a.partings.sameAs(b.partings) || !a.lic.sameAs(b.lic) || strokesDiffer(a, b);
}

Result<bool> LiveTexture::updateField(const Groom& groom, const std::shared_ptr<const Surface>& surface,
                                      Progress& progress) {
    const bool otherMesh = !m_solver || !groom.mesh.sameAs(m_solved.mesh);
    bool other = otherMesh || !groom.partings.sameAs(m_solved.partings);
    if (otherMesh || growthDiffers(groom, m_solved)) {
        // Most paint changes how much hair grows, not where.
        std::vector<std::uint8_t> grows = growingTriangles(groom);
        other = other || grows != m_grows;
        m_grows = std::move(grows);
    }
    if (!other && !strokesDiffer(m_solved, groom)) {
        m_solved = groom;
        return false;
    }
    if (other) {
        m_solver.reset();
        auto solver = FieldSolver::make(surface, m_grows, *groom.partings, progress);
        if (!solver) return solver.error();
        m_solver = std::move(*solver);
    }
    auto field = m_solver->solve(leadingStrokes(groom, *surface), *groom.field, progress);
    if (!field) {
        m_solver.reset();  // what it was asked for is not what is kept
        return field.error();
    }
    m_field = std::move(*field);
    m_solved = groom;
    return true;
}

Result<std::shared_ptr<const LicTexture>> LiveTexture::update(const Groom& groom,
                                                              std::shared_ptr<const Surface> surface, int size,
                                                              Progress& progress) {
    const bool otherMesh = !m_painter || !groom.mesh.sameAs(m_painted.mesh) || m_painter->size() != size;
    if (!otherMesh && m_texture && !differs(m_painted, groom)) return m_texture;
    if (auto made = updateField(groom, surface, progress); !made) return made.error();
    if (otherMesh) {
        m_painter.reset();
        m_texture = nullptr;
        auto painter = LicPainter::make(surface, size, progress);
        if (!painter) return painter.error();
        m_painter = std::move(*painter);
        m_painted = Groom();
        m_painted.mesh = groom.mesh;
    }
    auto texture = m_painter->paint(groom, m_field, m_texture.get(), progress);
    if (!texture) return texture.error();
    m_texture = std::make_shared<const LicTexture>(std::move(*texture));
    m_painted = groom;
    return m_texture;
}

}  // namespace whorl
