// SPDX-License-Identifier: Apache-2.0
#include "core/surface/parting_line.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace whorl {
namespace {

constexpr int deepest = 12;

// The skin's place between two of its places: straight up or down from the middle, which keeps a line in its plane, or
// the nearest one. Nothing when it is no way from one to the other.
std::optional<SurfaceHit> between(const Surface& surface, const SurfaceHit& a, const SurfaceHit& b) {
    const glm::vec3 middle = (a.position + b.position) * 0.5f;
    const float reach = 0.75f * glm::distance(a.position, b.position);
    const glm::vec3 up = normalAt(surface.mesh(), a.point) + normalAt(surface.mesh(), b.point);
    std::optional<SurfaceHit> best;
    if (glm::dot(up, up) > 1e-2f) {
        for (const glm::vec3& way : {glm::normalize(up), -glm::normalize(up)}) {
            const auto hit = surface.query.raycast(middle, way, reach);
            if (hit && (!best || hit->distance < best->distance)) best = hit;
        }
    }
    if (!best) best = surface.query.nearest(middle);
    if (!best || glm::distance(best->position, a.position) > reach || glm::distance(best->position, b.position) > reach)
        return std::nullopt;
    return best;
}

// Adds the way from the last place of `way` to `to`, which is added as well. Halves on the skin, because most of a long
// straight piece may be deep inside.
void addWay(const Surface& surface, const SurfaceHit& to, float step, int depth, std::vector<SurfaceHit>& way) {
    const SurfaceHit from = way.back();
    if (glm::distance(from.position, to.position) > step && depth < deepest && way.size() <= Parting::maxPoints) {
        if (const auto middle = between(surface, from, to)) {
            addWay(surface, *middle, step, depth + 1, way);
            addWay(surface, to, step, depth + 1, way);
            return;
        }
    }
    way.push_back(to);
}

}  // namespace

float partingStep(const Surface& surface) {
    const glm::vec3 size = surface.bounds.size();
    return std::max({size.x, size.y, size.z}) / 128.0f;
}

Result<std::vector<SurfacePoint>> tracedParting(const Surface& surface, std::span<const glm::vec3> points) {
    const float step = partingStep(surface);
    std::vector<SurfaceHit> way;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3& point = points[i];
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
            return Error{"A point of the parting is not a finite number."};
        const auto hit = surface.query.nearest(point);
        if (!hit) return Error{"The parting has no skin to lie on."};
        if (way.empty()) {
            way.push_back(*hit);
            continue;
        }
        const float distance = glm::distance(way.back().position, hit->position);
        if (distance < step / 3.0f && i + 1 < points.size()) continue;
        if (distance < step * 1e-3f) continue;
        addWay(surface, *hit, step, 0, way);
        if (way.size() > Parting::maxPoints)
            return Error{"The parting is too long: it would have more than " + std::to_string(Parting::maxPoints) +
                         " points. Draw it in several pieces."};
    }
    if (way.size() < 2) return Error{"A parting needs two places on the skin that are apart from each other."};
    std::vector<SurfacePoint> line;
    for (const SurfaceHit& hit : way) line.push_back(hit.point);
    return line;
}

std::vector<glm::vec3> partingPositions(const SurfaceMesh& mesh, const Parting& parting) {
    std::vector<glm::vec3> positions;
    for (const SurfacePoint& point : parting.points) positions.push_back(positionAt(mesh, point));
    return positions;
}

float partingLength(const SurfaceMesh& mesh, const Parting& parting) {
    const std::vector<glm::vec3> positions = partingPositions(mesh, parting);
    float length = 0.0f;
    for (std::size_t i = 1; i < positions.size(); ++i) length += glm::distance(positions[i - 1], positions[i]);
    return length;
}

}  // namespace whorl
