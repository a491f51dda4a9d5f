// SPDX-License-Identifier: Apache-2.0
#include "core/lic/texture.h"

#include <glm/common.hpp>

#include <cmath>

namespace whorl {

float licTone(float light, float mean, float deviation) {
    // Below half a step of 8 bits nothing varies.
    if (!(deviation > 0.5f / 255.0f)) return 0.0f;
    const float z = (light - mean) / deviation;
    return z / std::sqrt(z * z + 2.25f);
}

// As resources/shaders/lic.glsl has it.
glm::vec3 licColour(const glm::vec3& own, float white) {
    const float grey = glm::smoothstep(0.5f, 1.0f, white);
    return glm::mix(own * glm::mix(0.22f, 1.0f, glm::min(white * 2.0f, 1.0f)),
                    glm::vec3(0.62f, 0.60f, 0.57f) + 0.2f * own, grey * grey);
}

}  // namespace whorl
