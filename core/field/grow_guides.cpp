// SPDX-License-Identifier: Apache-2.0
#include "core/field/grow_guides.h"

#include "core/base/parallel.h"
#include "core/brushes/constraints.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace whorl {
namespace {

/// Share of the length that a black texel of the length map leaves.
constexpr float shortest = 0.02f;

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-9f ? v / length : otherwise;
}

/// The guide's new points; empty where the field has no direction at its root.
std::vector<glm::vec3> grown(const Surface& surface, const SkinClearance& skin, const DirectionField& field,
                             const GrowAlong& options, const SurfacePoint& root, std::size_t count, float length) {
    const SurfaceMesh& mesh = surface.mesh();
    glm::vec3 along = field.at(root);
    if (along == glm::vec3(0.0f) || count < 2 || !(length > 0.0f)) return {};
    std::vector<glm::vec3> points{positionAt(mesh, root)};
    glm::vec3 up = normalAt(mesh, root);
    const float step = length / static_cast<float>(count - 1);
    SkinWalk walk{skin};
    const float lift = glm::clamp(options.lift, 0.0f, 1.0f);
    for (std::size_t k = 1; k < count; ++k) {
        const float t = static_cast<float>(k - 1) / static_cast<float>(count - 1);
        // The angle to the skin falls from root to tip and ends lying on it.
        const float angle = lift * (1.0f - t) * (1.0f - t) * std::numbers::pi_v<float> * 0.5f;
        const glm::vec3 heading = along * std::cos(angle) + up * std::sin(angle) + options.gravity * (t * t);
        const glm::vec3 from = points.back();
        const glm::vec3 to = placeNext(walk, from, from + unitOr(heading, along) * step, along, step);
        const auto hit = surface.query.nearest(to);
        if (hit) {
            const glm::vec3 normal = normalAt(mesh, hit->point);
            // Beyond the growing area hair goes on as it came, turned along with the skin.
            const glm::vec3 here = field.at(hit->point);
            along = here != glm::vec3(0.0f) ? here : unitOr(along - normal * glm::dot(normal, along), along);
            up = normal;
        }
        points.push_back(to);
    }
    return points;
}

}  // namespace

GrowAlong growAlong(const FieldParams& params) {
    const float pull = glm::length(params.gravity.value);
    GrowAlong how{.length = params.length.value, .lengthMap = params.length.map, .lift = params.lift};
    if (pull > 0.0f) how.gravity = params.gravity.value * (params.bend / pull);
    return how;
}

Result<void> growGuidesAlong(Groom& groom, const Surface& surface, const DirectionField& field,
                             const GrowAlong& options, Progress& progress) {
    const std::size_t count = groom.guides.count();
    std::vector<std::vector<glm::vec3>> shapes(count);
    const SkinClearance skin = SkinClearance::of(surface);
    const Map* lengths = options.lengthMap.empty() ? nullptr : groom.maps.find(options.lengthMap);
    parallelFor(count, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !progress.cancelled(); ++i) {
            if (options.group >= 0 && groom.guides.group(i) != options.group) continue;
            const auto points = groom.guides.points(i);
            const SurfacePoint root = groom.guides.root(i);
            float length = options.length > 0.0f ? options.length : curveLength(points);
            // A guide keeps a direction even where the map is black.
            if (options.length > 0.0f && lengths && !lengths->empty())
                length *= std::max(lengths->sample(uvAt(surface.mesh(), root)), shortest);
            shapes[i] = grown(surface, skin, field, options, root, points.size(), length);
        }
    });
    if (progress.cancelled()) return cancelledError();
    for (std::size_t i = 0; i < count; ++i) {
        if (!shapes[i].empty()) groom.guides.setPoints(i, shapes[i]);
    }
    return {};
}

std::vector<FieldStroke> strokesFromGuides(const Groom& groom, const Surface& surface, int group) {
    std::vector<FieldStroke> strokes;
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        if (group >= 0 && groom.guides.group(i) != group) continue;
        FieldStroke stroke;
        stroke.points.push_back(groom.guides.root(i));
        for (const glm::vec3& point : groom.guides.points(i).subspan(1)) {
            const auto hit = surface.query.nearest(point);
            if (!hit) break;
            // Only the part that lies near the skin says how hair lies there.
            if (hit->distance > 2.0f * glm::distance(positionAt(surface.mesh(), stroke.points.front()), hit->position))
                break;
            stroke.points.push_back(hit->point);
        }
        if (stroke.points.size() >= 2) strokes.push_back(std::move(stroke));
    }
    return strokes;
}

}  // namespace whorl
