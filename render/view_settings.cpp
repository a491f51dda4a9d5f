// SPDX-License-Identifier: Apache-2.0
#include "render/view_settings.h"

#include <algorithm>
#include <cmath>

namespace whorl {

glm::vec3 groupColour(int group) {
    // Hues a golden angle apart never come close to each other soon.
    const float hue = 6.0f * (0.08f + 0.61803399f * static_cast<float>(std::max(group, 0)));
    glm::vec3 colour(0.0f);
    for (int i = 0; i < 3; ++i) {
        const float place = std::fmod(hue + 6.0f - 2.0f * static_cast<float>(i), 6.0f);
        const float away = std::min(place, 6.0f - place);
        colour[i] = 0.04f + 0.66f * std::clamp(2.0f - away, 0.0f, 1.0f);
    }
    return colour;
}

}  // namespace whorl
