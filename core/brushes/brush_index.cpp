// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/brush_index.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace whorl {
namespace {

BrushIndex::Ball ballAround(std::span<const glm::vec3> points) {
    glm::vec3 low = points[0], high = points[0];
    for (const glm::vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    BrushIndex::Ball ball{(low + high) * 0.5f, 0.0f};
    float squared = 0.0f;
    for (const glm::vec3& p : points) squared = std::max(squared, glm::dot(p - ball.centre, p - ball.centre));
    ball.radius = std::sqrt(squared) * 1.00001f;
    return ball;
}

}  // namespace

bool rootFacesEye(const Surface& surface, const StrokeView& view, const SurfacePoint& root) {
    const glm::vec3 position = positionAt(surface.mesh(), root);
    const std::optional<glm::vec2> pixel = view.pixelFromGroom(position);
    if (!pixel) return false;
    const glm::vec3 origin = view.rayOrigin(*pixel);
    const glm::vec3 way = position - origin;
    const float distance = glm::length(way);
    if (!(distance > 0.0f)) return false;
    const glm::vec3 direction = way / distance;
    if (glm::dot(normalAt(surface.mesh(), root), direction) >= 0.0f) return false;
    const std::optional<SurfaceHit> hit = surface.query.raycast(origin, direction, distance * 1.01f);
    if (!hit || hit->point.triangle == root.triangle) return true;
    return hit->distance > distance - 1e-3f * glm::length(surface.bounds.size());
}

void BrushIndex::forget() {
    m_made = false;
    m_guides.clear();
    m_blocks.clear();
    m_shows[0].clear();
    m_shows[1].clear();
    m_memoryOf.clear();
    m_memories.clear();
    m_points.clear();
}

void BrushIndex::follow(const GuideSet& guides) {
    if (m_made && m_guides.size() == guides.count() && m_blocks.size() == guides.blockCount()) return;
    forget();
    m_made = true;
    m_guides.resize(guides.count());
    m_blocks.resize(guides.blockCount());
    m_shows[0].resize(guides.count());
    m_shows[1].resize(guides.count());
    m_memoryOf.assign(guides.count(), ~0u);
    parallelFor(guides.blockCount(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const GuideBlock& block = guides.block(b);
            const std::span<const glm::vec3> points(block.points);
            for (std::size_t i = 0; i < block.count(); ++i) {
                m_guides[guides.firstOfBlock(b) + i] =
                    ballAround(points.subspan(block.firstPoint[i], block.firstPoint[i + 1] - block.firstPoint[i]));
            }
            ballOfBlock(guides, b);
        }
    });
}

void BrushIndex::ballOfBlock(const GuideSet& guides, std::size_t block) {
    const std::size_t first = guides.firstOfBlock(block), last = first + guides.block(block).count();
    glm::vec3 low(1e30f), high(-1e30f);
    for (std::size_t i = first; i < last; ++i) {
        low = glm::min(low, m_guides[i].centre - m_guides[i].radius);
        high = glm::max(high, m_guides[i].centre + m_guides[i].radius);
    }
    Ball ball{(low + high) * 0.5f, 0.0f};
    for (std::size_t i = first; i < last; ++i) {
        ball.radius = std::max(ball.radius, glm::length(m_guides[i].centre - ball.centre) + m_guides[i].radius);
    }
    m_blocks[block] = ball;
}

bool BrushIndex::rootShows(const Groom& groom, const Surface& surface, const StrokeView& view, std::size_t guide,
                           bool mirrored) {
    std::uint8_t& shows = m_shows[mirrored ? 1 : 0][guide];
    if (shows == 0) shows = rootFacesEye(surface, view, groom.guides.root(guide)) ? 1 : 2;
    return shows == 1;
}

void BrushIndex::select(const Groom& groom, const Surface& surface, const BrushArea& area, const StrokeView& view,
                        bool frontOnly, bool mirrored, Selection& selection) {
    const GuideSet& guides = groom.guides;
    follow(guides);
    selection.guides.clear();
    selection.weights.clear();
    m_candidates.clear();
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        if (area.mayTouch(m_blocks[b].centre, m_blocks[b].radius)) m_candidates.push_back(b);
    }
    if (m_found.size() < m_candidates.size()) m_found.resize(m_candidates.size());

    const auto searchBlock = [&](std::size_t b, Selection& found) {
        const GuideBlock& block = guides.block(b);
        const std::size_t first = guides.firstOfBlock(b);
        found.guides.clear();
        found.weights.clear();
        for (std::size_t i = 0; i < block.count(); ++i) {
            const Ball& ball = m_guides[first + i];
            if (!area.mayTouch(ball.centre, ball.radius)) continue;
            Touched touched{static_cast<std::uint32_t>(first + i), static_cast<std::uint32_t>(found.weights.size()),
                            0.0f};
            for (std::uint32_t p = block.firstPoint[i]; p < block.firstPoint[i + 1]; ++p) {
                found.weights.push_back(area.weight(block.points[p]));
                touched.largest = std::max(touched.largest, found.weights.back());
            }
            if (touched.largest > 0.0f && (!frontOnly || rootShows(groom, surface, view, first + i, mirrored))) {
                found.guides.push_back(touched);
            } else {
                found.weights.resize(touched.firstWeight);
            }
        }
    };
    parallelFor(m_candidates.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) searchBlock(m_candidates[c], m_found[c]);
    });
    for (std::size_t c = 0; c < m_candidates.size(); ++c) {
        const auto offset = static_cast<std::uint32_t>(selection.weights.size());
        for (Touched touched : m_found[c].guides) {
            touched.firstWeight += offset;
            selection.guides.push_back(touched);
        }
        selection.weights.insert(selection.weights.end(), m_found[c].weights.begin(), m_found[c].weights.end());
    }
}

std::optional<glm::vec3> BrushIndex::frontPoint(const Groom& groom, const Surface& surface, const ScreenFrame& frame,
                                                glm::vec2 pixel, float radiusPixels, const StrokeView& view,
                                                bool frontOnly, bool mirrored) {
    const GuideSet& guides = groom.guides;
    follow(guides);
    std::optional<glm::vec3> best;
    float bestDistance = 1e30f;
    const glm::vec3 origin = view.rayOrigin(pixel), direction = view.rayDirection(pixel);
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        if (!frame.ballMayTouch(m_blocks[b].centre, m_blocks[b].radius, pixel, radiusPixels)) continue;
        const GuideBlock& block = guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i) {
            const std::size_t guide = guides.firstOfBlock(b) + i;
            if (!frame.ballMayTouch(m_guides[guide].centre, m_guides[guide].radius, pixel, radiusPixels)) continue;
            for (std::uint32_t p = block.firstPoint[i]; p < block.firstPoint[i + 1]; ++p) {
                const float depth = frame.depth(block.points[p]);
                const float distance = glm::dot(block.points[p] - origin, direction);
                if (!frame.visible(depth) || distance >= bestDistance ||
                    glm::length(frame.pixel(block.points[p], depth) - pixel) > radiusPixels) {
                    continue;
                }
                if (frontOnly && !rootShows(groom, surface, view, guide, mirrored)) break;
                best = block.points[p];
                bestDistance = distance;
            }
        }
    }
    return best;
}

void BrushIndex::update(const GuideSet& guides, std::span<const std::uint32_t> changed) {
    parallelFor(changed.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) m_guides[changed[i]] = ballAround(guides.points(changed[i]));
    });
    std::size_t block = 0;
    std::size_t i = 0;
    while (i < changed.size()) {
        while (guides.firstOfBlock(block + 1) <= changed[i]) ++block;
        while (i < changed.size() && changed[i] < guides.firstOfBlock(block + 1)) ++i;
        ballOfBlock(guides, block);
    }
}

void BrushIndex::remember(const GuideSet& guides, std::uint32_t guide) {
    if (m_memoryOf[guide] != ~0u) return;
    m_memoryOf[guide] = static_cast<std::uint32_t>(m_memories.size());
    const std::span<const glm::vec3> points = guides.points(guide);
    m_memories.push_back({m_points.size(), points.size(), 0.0f});
    m_points.insert(m_points.end(), points.begin(), points.end());
}

std::span<const glm::vec3> BrushIndex::original(std::uint32_t guide) const {
    const Memory& memory = m_memories[m_memoryOf[guide]];
    return std::span<const glm::vec3>(m_points).subspan(memory.firstPoint, memory.count);
}

}  // namespace whorl
