// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/constraints.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

constexpr float noLength = 1e-30f;  // squared

/// `v` scaled to `length`; `direction` of that length where v has none.
glm::vec3 scaledTo(const glm::vec3& v, float length, const glm::vec3& direction) {
    const float squared = glm::dot(v, v);
    if (squared > noLength) return v * (length / std::sqrt(squared));
    return direction * (length / std::max(glm::length(direction), noLength));
}

}  // namespace

SkinClearance SkinClearance::of(const Surface& surface) {
    const DistanceField& skin = surface.skin();
    return {&skin, skin.spacing() * 0.15f, skin.spacing()};
}

float SkinClearance::at(float along) const {
    const float t = std::clamp(along / std::max(ramp, 1e-12f), 0.0f, 1.0f);
    return clearance * t * (2.0f - t);
}

glm::vec3 pushOut(const glm::vec3& point, float along, const SkinClearance& skin) {
    if (skin.skin == nullptr) return point;
    const float asked = skin.at(along);
    glm::vec3 p = point;
    for (int i = 0; i < 8; ++i) {
        const DistanceField::Sample here = skin.skin->sample(p);
        const float missing = asked - here.distance();
        if (missing <= 0.0f) break;
        p += here.gradient() * missing;
    }
    return p;
}

glm::vec3 placeNext(SkinWalk& walk, const glm::vec3& previous, const glm::vec3& target, const glm::vec3& direction,
                    float length) {
    const SkinClearance& skin = walk.skin;
    walk.along += length;
    const glm::vec3 segment = scaledTo(target - previous, length, direction);
    const glm::vec3 free = previous + segment;
    if (skin.skin == nullptr) return free;
    const float asked = skin.at(walk.along);
    // A quarter more than the way, because the field interpolates.
    walk.free -= 1.25f * length;
    if (walk.free >= asked) return free;
    DistanceField::Sample here = skin.skin->sample(free);
    walk.free = here.distance();
    if (here.distance() >= asked) return free;
    walk.free = 0.0f;

    // Slide: out along the gradient, then back to the length.
    glm::vec3 best = free;
    float bestDistance = here.distance();
    glm::vec3 p = free;
    for (int i = 0; i < 6; ++i) {
        const glm::vec3 out = here.gradient();
        if (glm::dot(out, out) == 0.0f) break;
        // A little further than asked, because turning back to the length loses some of it again.
        p = previous + scaledTo(p + out * ((asked - here.distance()) * 1.25f) - previous, length, direction);
        here = skin.skin->sample(p);
        if (here.distance() >= asked) return p;
        if (here.distance() > bestDistance) {
            best = p;
            bestDistance = here.distance();
        }
    }
    // Turn: towards the skin's normal at the previous point, as little as needed. From a point that is outside, a
    // segment along the normal leads further outside.
    glm::vec3 up = skin.skin->gradient(previous);
    if (glm::dot(up, up) == 0.0f) up = skin.skin->gradient(best);
    if (glm::dot(up, up) > 0.0f) {
        const glm::vec3 flat = (best - previous) / std::max(length, 1e-30f);
        const auto turned = [&](float t) { return previous + scaledTo(flat * (1.0f - t) + up * t, length, up); };
        const float upright = skin.skin->distance(turned(1.0f));
        if (upright >= asked) {
            float low = 0.0f, high = 1.0f;
            for (int i = 0; i < 10; ++i) {
                const float middle = 0.5f * (low + high);
                (skin.skin->distance(turned(middle)) >= asked ? high : low) = middle;
            }
            return turned(high);
        }
        if (upright > bestDistance) return turned(1.0f);
    }
    return best;
}

void settle(std::span<glm::vec3> points, std::span<const glm::vec3> original, const SkinClearance& skin) {
    SkinWalk walk{skin};
    glm::vec3 before = points[0];  // the previous point as it was asked for
    glm::vec3 direction(0.0f, 1.0f, 0.0f);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const float length = glm::length(original[i] - original[i - 1]);
        const glm::vec3 segment = points[i] - before;
        before = points[i];
        points[i] = placeNext(walk, points[i - 1], points[i - 1] + segment, direction, length);
        const glm::vec3 placed = points[i] - points[i - 1];
        if (glm::dot(placed, placed) > noLength) direction = placed;
    }
}

float curveLength(std::span<const glm::vec3> points) {
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i)
        length += static_cast<double>(glm::length(points[i] - points[i - 1]));
    return static_cast<float>(length);
}

}  // namespace whorl
