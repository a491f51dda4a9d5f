// SPDX-License-Identifier: Apache-2.0
#include "render/passes/pick.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <vector>

namespace whorl {
namespace {

struct Candidate {
    float distance;
    std::size_t guide;
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

}  // namespace

std::optional<std::size_t> pickGuide(const GuideSet& guides, const SurfaceQuery* query, const glm::mat4& clipFromGroom,
                                     const glm::vec3& eye, glm::vec2 pixel, float radius, glm::vec2 viewportPixels) {
    std::vector<Candidate> candidates;
    for (std::size_t block = 0; block < guides.blockCount(); ++block) {
        const GuideBlock& b = guides.block(block);
        for (std::size_t i = 0; i < b.count(); ++i) {
            Candidate best{radius, guides.firstOfBlock(block) + i, glm::vec3(0.0f)};
            bool found = false;
            Projected from;
            for (std::uint32_t p = b.firstPoint[i]; p < b.firstPoint[i + 1]; ++p) {
                const Projected to = project(clipFromGroom, b.points[p], viewportPixels);
                if (p > b.firstPoint[i] && from.w > 0.0f && to.w > 0.0f) {
                    const glm::vec2 way = to.pixel - from.pixel;
                    const float square = glm::dot(way, way);
                    const float t =
                        square > 0.0f ? std::clamp(glm::dot(pixel - from.pixel, way) / square, 0.0f, 1.0f) : 0.0f;
                    const float distance = glm::length(pixel - from.pixel - way * t);
                    if (distance < best.distance || (!found && distance <= radius)) {
                        // Even steps in the picture are not even in space: undo the perspective.
                        const float s = t * from.w / ((1.0f - t) * to.w + t * from.w);
                        best.distance = distance;
                        best.place = b.points[p - 1] + (b.points[p] - b.points[p - 1]) * s;
                        found = true;
                    }
                }
                from = to;
            }
            if (found) candidates.push_back(best);
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    for (const Candidate& candidate : candidates) {
        if (query == nullptr) return candidate.guide;
        const glm::vec3 way = candidate.place - eye;
        const float distance = glm::length(way);
        if (distance <= 0.0f) continue;
        // Roots lie on the skin: a little slack keeps them from hiding behind it.
        const float slack = 0.002f * distance + 1e-4f;
        const auto hit = query->raycast(eye, way / distance, distance);
        if (!hit || hit->distance >= distance - slack) return candidate.guide;
    }
    return std::nullopt;
}

}  // namespace whorl
