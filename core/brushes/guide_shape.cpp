// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/guide_shape.h"

#include "core/brushes/constraints.h"
#include "core/surface/parting_index.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace whorl {

float defaultGuideLength(const Surface& surface) {
    return glm::length(surface.bounds.size()) * 0.1f;
}

NearestRoot nearestRoot(const GuideSet& guides, const glm::vec3& position) {
    NearestRoot nearest{guides.count(), 1e30f};
    float squared = 1e30f;
    for (std::size_t b = 0; b < guides.blockCount(); ++b) {
        const GuideBlock& block = guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i) {
            const glm::vec3 away = block.points[block.firstPoint[i]] - position;
            if (glm::dot(away, away) < squared) {
                squared = glm::dot(away, away);
                nearest.guide = guides.firstOfBlock(b) + i;
            }
        }
    }
    if (nearest.guide < guides.count()) nearest.distance = std::sqrt(squared);
    return nearest;
}

std::vector<glm::vec3> guideShapeAt(const Groom& groom, const Surface& surface, const SurfacePoint& root,
                                    std::uint8_t group, float length) {
    struct Near {
        float squared = 1e30f;
        std::size_t guide = 0;
    };
    const SurfaceMesh& mesh = surface.mesh();
    const glm::vec3 position = positionAt(mesh, root), normal = normalAt(mesh, root);
    const GuideSet& guides = groom.guides;
    std::array<Near, 4> nearest{};
    std::size_t found = 0;
    const PartingIndex partings(mesh, *groom.partings);
    for (std::size_t b = 0; b < guides.blockCount(); ++b) {
        const GuideBlock& block = guides.block(b);
        for (std::size_t i = 0; i < block.count(); ++i) {
            if (block.groups[i] != group) continue;
            const glm::vec3 away = block.points[block.firstPoint[i]] - position;
            if (partings.separated({position, normal},
                                   {block.points[block.firstPoint[i]], normalAt(mesh, block.roots[i])}))
                continue;
            Near candidate{glm::dot(away, away), guides.firstOfBlock(b) + i};
            found = std::min(found + 1, nearest.size());
            for (std::size_t k = 0; k < found; ++k) {
                if (candidate.squared < nearest[k].squared) std::swap(candidate, nearest[k]);
            }
        }
    }
    const std::size_t index = std::min<std::size_t>(group, groom.groups->size() - 1);
    const int segments = std::max((*groom.groups)[index].params.general.segments, 1);
    const std::size_t count = static_cast<std::size_t>(segments) + 1;
    std::vector<glm::vec3> points(count, position);
    if (found == 0) {
        if (!(length > 0.0f)) length = defaultGuideLength(surface);
        for (std::size_t i = 1; i < count; ++i) {
            points[i] = position + normal * (length * static_cast<float>(i) / static_cast<float>(segments));
        }
        return points;
    }
    double total = 0.0;
    const float nearestSquared = std::max(nearest[0].squared, 1e-20f);
    for (std::size_t k = 0; k < found; ++k) {
        total += static_cast<double>(nearestSquared / std::max(nearest[k].squared, nearestSquared));
    }
    for (std::size_t k = 0; k < found; ++k) {
        const float weight = static_cast<float>(
            static_cast<double>(nearestSquared / std::max(nearest[k].squared, nearestSquared)) / total);
        const glm::mat3 turn = minimalRotation(normalAt(mesh, guides.root(nearest[k].guide)), normal);
        const std::vector<glm::vec3> shape = resampled(guides.points(nearest[k].guide), segments);
        for (std::size_t i = 1; i < count; ++i) points[i] += turn * (shape[i] - shape[0]) * weight;
    }
    const SkinClearance skin = SkinClearance::of(surface);
    const std::vector<glm::vec3> original = points;
    settle(points, original, skin);
    return points;
}

}  // namespace whorl
