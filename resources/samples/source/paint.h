// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/sculpt.h"

#include <functional>

namespace whorl::samples {

struct PaintPoint {
    glm::vec3 position;
    glm::vec3 normal;
    int part;
};

/// Evaluates a painter at every texel under the charts, then spreads the border texels outwards.
ScalarImage paintScalar(const Sculpture& sculpture, int size, const std::function<float(const PaintPoint&)>& painter);
ColourImage paintColour(const Sculpture& sculpture, int size,
                        const std::function<glm::vec3(const PaintPoint&)>& painter);

/// Smooth repeatable noise in about -1..1, for uneven borders and colour variation.
float paintNoise(const glm::vec3& p);

}  // namespace whorl::samples
