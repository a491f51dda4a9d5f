// SPDX-License-Identifier: Apache-2.0
#include "render/passes/pick.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace whorl {
namespace {

struct Candidate {
    float order;
    std::size_t index;
    glm::vec3 place;
};

struct Projected {
    glm::vec2 pixel{0.0f};
    float w = 0.0f;  // not above zero: behind the eye
};

Projected project(const glm::mat4& clipFromGroom, const glm::vec3& p, glm::vec2 viewport) {
    const glm::vec4 clip = clipFromGroom * glm::vec4(p, 1.0f);
    if (clip.w <= 1e-6f) return {};
    return {glm::vec2((clip.x / clip.w * 0.5f + 0.5f) * viewport.x, (0.5f - clip.y / clip.w * 0.5f) * viewport.y),
            clip.w};
}

/// Where a polyline comes nearest to `pixel` in the picture.
struct Near {
    float distance;  ///< pixels
    glm::vec3 place{0.0f};
};

/// Nothing when it stays beyond `radius` pixels.
std::optional<Near> nearest(std::span<const glm::vec3> points, const glm::mat4& clipFromGroom, glm::vec2 pixel,
                            float radius, glm::vec2 viewportPixels) {
    std::optional<Near> best;
    Projected from;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Projected to = project(clipFromGroom, points[p], viewportPixels);
        if (p > 0 && from.w > 0.0f && to.w > 0.0f) {
            const glm::vec2 way = to.pixel - from.pixel;
            const float square = glm::dot(way, way);
            const float t = square > 0.0f ? std::clamp(glm::dot(pixel - from.pixel, way) / square, 0.0f, 1.0f) : 0.0f;
            const float distance = glm::length(pixel - from.pixel - way * t);
            if (distance <= radius && (!best || distance < best->distance)) {
                // Even steps in the picture are not even in space: undo the perspective.
                const float s = t * from.w / ((1.0f - t) * to.w + t * from.w);
                best = Near{distance, points[p - 1] + (points[p] - points[p - 1]) * s};
            }
        }
        from = to;
    }
    return best;
}

bool hidden(const SurfaceQuery* query, const glm::vec3& eye, const glm::vec3& place) {
    if (query == nullptr) return false;
    const glm::vec3 way = place - eye;
    const float distance = glm::length(way);
    if (distance <= 0.0f) return true;
    // Roots lie on the skin: a little slack keeps them from hiding behind it.
    const float slack = 0.002f * distance + 1e-4f;
    const auto hit = query->raycast(eye, way / distance, distance);
    return hit && hit->distance < distance - slack;
}

/// The first of the candidates, by their order, that the mesh does not hide.
std::optional<std::size_t> firstSeen(std::vector<Candidate>& candidates, const SurfaceQuery* query,
                                     const glm::vec3& eye) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.order < b.order; });
    for (const Candidate& candidate : candidates) {
        if (!hidden(query, eye, candidate.place)) return candidate.index;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::size_t> pickGuide(const GuideSet& guides, const SurfaceQuery* query, const glm::mat4& clipFromGroom,
                                     const glm::vec3& eye, glm::vec2 pixel, float radius, glm::vec2 viewportPixels) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < guides.count(); ++i) {
        if (const auto near = nearest(guides.points(i), clipFromGroom, pixel, radius, viewportPixels)) {
            candidates.push_back({near->distance, i, near->place});
        }
    }
    return firstSeen(candidates, query, eye);
}

std::optional<std::size_t> pickHair(const Strands& strands, const SurfaceQuery* query, const glm::mat4& clipFromGroom,
                                    const glm::vec3& eye, glm::vec2 pixel, float radius, glm::vec2 viewportPixels) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < strands.count(); ++i) {
        const std::span points(strands.positions.data() + strands.firstVertex[i],
                               strands.firstVertex[i + 1] - strands.firstVertex[i]);
        if (const auto near = nearest(points, clipFromGroom, pixel, radius, viewportPixels)) {
            candidates.push_back({glm::distance(eye, near->place), i, near->place});
        }
    }
    return firstSeen(candidates, query, eye);
}

}  // namespace whorl
