// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/style.h"

#include "core/base/random.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl::samples {
namespace {

glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-6f ? v / length : otherwise;
}

glm::vec3 randomVector(std::uint32_t id) {
    return glm::vec3(randomFloat(11, id, 0), randomFloat(11, id, 1), randomFloat(11, id, 2)) * 2.0f - 1.0f;
}

/// Distance to the skin and the direction away from it, also beyond the band of the distance field.
struct Height {
    float above;
    glm::vec3 out;
};

Height heightAt(const Surface& surface, const glm::vec3& p, const glm::vec3& otherwise) {
    const DistanceField& skin = surface.skin();
    const float distance = skin.distance(p);
    if (distance < 0.9f * skin.band()) return {distance, unit(skin.gradient(p), otherwise)};
    const auto hit = surface.query.nearest(p);
    return hit ? Height{hit->distance, unit(p - hit->position, otherwise)} : Height{distance, otherwise};
}

}  // namespace

float ramp(float value, float from, float to) {
    const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

void growGuides(Groom& groom, const Surface& surface, std::uint8_t group, const Style& style) {
    const DistanceField& skin = surface.skin();
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        if (groom.guides.group(i) != group) continue;
        const SurfacePoint place = groom.guides.root(i);
        const glm::vec3 root = positionAt(surface.mesh(), place);
        const glm::vec3 normal = normalAt(surface.mesh(), place);
        const glm::vec3 stray = randomVector(groom.guides.id(i)) * style.stray;
        const auto points = groom.guides.editPoints(i);
        const auto segments = static_cast<float>(points.size() - 1);
        const float step = style.length(root) / segments;

        const auto along = [&](const glm::vec3& p) {
            // The flow without what points into or out of the skin there.
            const glm::vec3 flow = unit(style.flow(p, root) + stray, normal);
            const glm::vec3 out = heightAt(surface, p, normal).out;
            return unit(flow - out * glm::dot(flow, out), flow);
        };
        const float layer = style.layer(root);
        glm::vec3 direction = glm::mix(along(root), normal, std::clamp(style.lift(root), 0.05f, 1.0f));
        direction = unit(direction, normal);
        glm::vec3 p = root;
        points[0] = root;
        for (std::size_t k = 1; k < points.size(); ++k) {
            const float t = static_cast<float>(k) / segments;
            const float turn = style.turn * std::min(1.0f, t * 3.0f);
            const Height height = heightAt(surface, p, normal);
            const float above = std::clamp((height.above - layer) / (layer + 0.004f), 0.0f, 1.0f);
            direction += (along(p) - direction) * turn - glm::vec3(0, style.gravity, 0);
            direction = unit(direction - height.out * (above * style.hug), normal);
            glm::vec3 next = p + direction * step;
            const float clearance = 0.6f * layer * std::min(1.0f, t * 4.0f);
            const float distance = skin.distance(next);
            if (distance < clearance) {
                next += skin.gradient(next) * (clearance - distance);
                next = p + unit(next - p, direction) * step;
            }
            direction = unit(next - p, direction);
            p = next;
            points[k] = p;
        }
    }
}

}  // namespace whorl::samples
