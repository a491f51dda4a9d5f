// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

// The greater of both, rounded off where they are within `width` of each other.
float smoothMax(float a, float b, float width) {
    const float over = a - b;
    if (over >= width) return a;
    if (over <= -width) return b;
    return b + (over + width) * (over + width) / (4.0f * width);
}

// Where the way from `from`, which is outside, along `step` meets the skin.
glm::vec3 lastOutside(const DistanceField& skin, const glm::vec3& from, const glm::vec3& step) {
    float out = 0.0f, in = 1.0f;
    for (int i = 0; i < 8; ++i) {
        const float middle = (out + in) * 0.5f;
        (skin.distance(from + step * middle) > 0.0f ? out : in) = middle;
    }
    return from + step * out;
}

}  // namespace

float skinClearance(const DistanceField& skin) {
    return 0.25f * skin.spacing();
}

void keepOutside(const DistanceField& skin, std::span<glm::vec3> points, std::span<const float> ease) {
    const float deep = -0.9f * skin.band();
    const float fullClearance = skinClearance(skin);
    bool diverted = false;
    glm::vec3 wishedBefore = points[0];
    for (std::size_t v = 1; v < points.size(); ++v) {
        const glm::vec3 wished = points[v];
        const glm::vec3 before = points[v - 1];
        const glm::vec3 step = wished - wishedBefore;
        wishedBefore = wished;
        glm::vec3 p = diverted ? before + step : wished;
        float distance = skin.distance(p);
        if (distance < deep) {
            diverted = true;
            const glm::vec3 out = skin.gradient(before);
            const glm::vec3 along = step - out * std::min(0.0f, glm::dot(step, out));
            p = before + along;
            distance = skin.distance(p);
            if (distance < deep) {
                p = lastOutside(skin, before, along);
                distance = skin.distance(p);
            }
        }
        const float clearance = fullClearance * ease[v];
        if (distance < 2.0f * clearance || distance < 0.0f) {
            const float target = clearance > 0.0f ? smoothMax(distance, clearance, clearance) : 0.0f;
            // The field is not quite linear: a few steps reach what one would miss.
            for (int i = 0; i < 4 && target - distance > 0.02f * clearance; ++i) {
                p += skin.gradient(p) * (target - distance);
                distance = skin.distance(p);
            }
        }
        points[v] = p;
    }
}

}  // namespace whorl
