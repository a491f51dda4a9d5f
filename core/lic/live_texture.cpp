// SPDX-License-Identifier: Apache-2.0
#include "core/lic/live_texture.h"

#include "core/base/parallel.h"
#include "core/field/growing_area.h"

#include <algorithm>
#include <span>

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

/// LicTexture::sides. A texel of a margin follows the place beside its triangle.
LicTexture::Layer<std::uint8_t> sidesOfPartings(const Groom& groom, const DirectionField& field,
                                                const TexelAtlas& atlas) {
    if (groom.partings->empty()) return nullptr;
    constexpr std::uint8_t all = 7;
    const auto size = static_cast<std::size_t>(atlas.size());
    std::vector<std::uint8_t> sides(size * size, all);
    const std::span<const TexelAtlas::Slot> slots = atlas.slots();
    const auto width = static_cast<std::uint32_t>(atlas.side());
    parallelFor(slots.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const TexelAtlas::Slot& slot = slots[i];
            const std::uint32_t x = slot.texel % width - TexelAtlas::pad, y = slot.texel / width - TexelAtlas::pad;
            if (x >= size || y >= size) continue;
            SurfacePoint here{slot.triangle, std::clamp(slot.u, 0.0f, 1.0f), std::clamp(slot.v, 0.0f, 1.0f)};
            const float sum = here.u + here.v;
            if (sum > 1.0f) here = {slot.triangle, here.u / sum, here.v / sum};
            std::uint8_t own = 0;
            for (int k = 0; k < 3; ++k) {
                const SurfacePoint corner{slot.triangle, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f};
                if (!field.parted(here, corner)) own = static_cast<std::uint8_t>(own | (1 << k));
            }
            const auto triangle = static_cast<std::uint8_t>(slot.triangle % 32 * 8);
            sides[y * size + x] = static_cast<std::uint8_t>((own != 0 ? own : all) | triangle);
        }
    });
    return std::make_shared<const std::vector<std::uint8_t>>(std::move(sides));
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

Result<DirectionField> LiveTexture::field(const Groom& groom, const std::shared_ptr<const Surface>& surface,
                                          Progress& progress) {
    if (auto made = updateField(groom, surface, progress); !made) return made.error();
    return m_field;
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
    if (otherMesh || !m_texture || !groom.partings.sameAs(m_painted.partings)) {
        texture->sides = sidesOfPartings(groom, m_field, m_painter->atlas());
    } else {
        texture->sides = m_texture->sides;
    }
    m_texture = std::make_shared<const LicTexture>(std::move(*texture));
    m_painted = groom;
    return m_texture;
}

}  // namespace whorl
