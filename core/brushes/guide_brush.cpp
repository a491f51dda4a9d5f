// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/guide_brush.h"

#include "core/base/parallel.h"
#include "core/brushes/stroke_scratch.h"

#include <algorithm>
#include <cstring>

namespace whorl {

std::optional<BrushArea> brushArea(BrushStep& step) {
    BrushArea area{ScreenFrame(step.view), step.settings.reach, step.pixel, step.radiusPixels, {}, 0.0f};
    if (area.reach == Reach::Projected) return area;
    const std::optional<glm::vec3> hair = step.scratch->guides.frontPoint(
        step.groom, step.surface, area.frame, step.pixel, std::min(step.radiusPixels, 12.0f), step.view,
        step.settings.frontOnly, step.mirrored);
    if (hair && (!step.hit || glm::length(*hair - step.view.rayOrigin(step.pixel)) < step.hit->distance)) {
        area.centre = *hair;
    } else if (step.hit) {
        area.centre = step.hit->position;
    } else {
        return std::nullopt;
    }
    area.radius = step.radiusPixels * area.frame.metresPerPixel(area.frame.depth(area.centre));
    if (!(area.radius > 0.0f)) return std::nullopt;
    return area;
}

void StrokeSide::follow(const BrushStep& step) {
    if (!m_made) m_partings = PartingIndex(step.surface.mesh(), *step.groom.partings);
    m_made = true;
    if (m_partings.empty() || !step.hit) return;
    const PartingIndex::Root here{step.hit->position, normalAt(step.surface.mesh(), step.hit->point)};
    if (!m_anchor || !m_partings.separated(*m_anchor, here)) m_anchor = here;
}

bool StrokeSide::has(const BrushStep& step, std::uint32_t guide) const {
    if (!m_anchor) return true;
    const SurfacePoint root = step.groom.guides.root(guide);
    return !m_partings.separated(*m_anchor,
                                 {positionAt(step.surface.mesh(), root), normalAt(step.surface.mesh(), root)});
}

bool GuideBrush::prepare(const BrushStep&, const BrushArea&) {
    return true;
}

float GuideBrush::gather(const BrushStep&, float) const {
    return 0.0f;
}

void GuideBrush::step(BrushStep& step) {
    if (!(step.strength > 0.0f) || step.groom.guides.empty()) return;
    if (step.settings.respectPartings) m_side.follow(step);
    const std::optional<BrushArea> area = brushArea(step);
    if (!area || !prepare(step, *area)) return;
    BrushIndex& index = step.scratch->guides;
    GuideSet& guides = step.groom.guides;
    index.select(step.groom, step.surface, *area, step.view, step.settings.frontOnly, step.mirrored, m_selection);
    if (step.settings.respectPartings) {
        std::erase_if(m_selection.guides,
                      [&](const BrushIndex::Touched& touched) { return !m_side.has(step, touched.guide); });
    }
    if (m_selection.guides.empty()) return;
    m_skin = step.settings.keepOutside ? SkinClearance::of(step.surface) : SkinClearance{};

    m_firstPoint.assign(1, 0);
    m_points.clear();
    for (float& weight : m_selection.weights) weight *= step.strength;
    for (BrushIndex::Touched& touched : m_selection.guides) {
        touched.largest *= step.strength;
        index.remember(guides, touched.guide);
        index.amount(touched.guide) += gather(step, touched.largest);
        const std::span<const glm::vec3> points = guides.points(touched.guide);
        m_points.insert(m_points.end(), points.begin(), points.end());
        m_firstPoint.push_back(m_points.size());
    }
    parallelFor(m_selection.guides.size(), 32, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const BrushIndex::Touched& touched = m_selection.guides[i];
            const std::size_t count = m_firstPoint[i + 1] - m_firstPoint[i];
            GuideTouch touch{touched.guide,
                             index.original(touched.guide),
                             std::span<const float>(m_selection.weights).subspan(touched.firstWeight, count),
                             touched.largest,
                             index.amount(touched.guide),
                             std::span<glm::vec3>(m_points).subspan(m_firstPoint[i], count)};
            shape(step, *area, touch);
        }
    });
    m_changed.clear();
    for (std::size_t i = 0; i < m_selection.guides.size(); ++i) {
        const std::uint32_t guide = m_selection.guides[i].guide;
        const std::size_t bytes = (m_firstPoint[i + 1] - m_firstPoint[i]) * sizeof(glm::vec3);
        const glm::vec3* after = m_points.data() + m_firstPoint[i];
        if (std::memcmp(after, guides.points(guide).data(), bytes) == 0) continue;
        std::memcpy(guides.editPoints(guide).data(), after, bytes);
        m_changed.push_back(guide);
    }
    if (m_changed.empty()) return;
    index.update(guides, m_changed);
    step.changed = true;
}

}  // namespace whorl
