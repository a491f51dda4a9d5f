// SPDX-License-Identifier: Apache-2.0
#include "core/lic/texture.h"

#include <cmath>

namespace whorl {

float licTone(float light, float mean, float deviation) {
    // Below half a step of 8 bits nothing varies.
    if (!(deviation > 0.5f / 255.0f)) return 0.0f;
    const float z = (light - mean) / deviation;
    return z / std::sqrt(z * z + 2.25f);
}

}  // namespace whorl
