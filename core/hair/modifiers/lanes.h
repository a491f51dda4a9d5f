// SPDX-License-Identifier: Apache-2.0
// What kernels of modifiers share. Internal linkage and plain arithmetic only (see core/base/simd.h).
#pragma once

#include "core/hair/modifiers/modifiers.kernel.h"

namespace whorl::modifier_lanes {

static constexpr std::size_t lanes = ModifierArrays::lanes;
static constexpr float tiny = 1e-24f;

/// t with its middle moved: straight for b = 0.5, late below, early above (Schlick's bias). t and b from 0 to 1, b not
/// at its ends.
static inline float bias(float t, float b) {
    return t / ((1.0f / b - 2.0f) * (1.0f - t) + 1.0f);
}

static inline float clamped(float value, float least, float most) {
    const float low = value < least ? least : value;
    return low > most ? most : low;
}

/// Row `r` of the modifier's numbers.
static inline const float* numberRow(const ModifierArrays& a, std::size_t r) {
    return a.numbers + r * lanes;
}

/// Length of the piece that ends at vertex v, at [v * 16 + l]; 0 at the first vertex.
static inline void pieceLengths(const ModifierArrays& a, float* lengths) {
    for (std::size_t l = 0; l < lanes; ++l) lengths[l] = 0.0f;
    for (std::size_t i = lanes; i < a.vertices * lanes; ++i) {
        const float x = a.x[i] - a.x[i - lanes], y = a.y[i] - a.y[i - lanes], z = a.z[i] - a.z[i - lanes];
        lengths[i] = __builtin_sqrtf(x * x + y * y + z * z);
    }
}

/// Stretches and shrinks pieces to these lengths from the root on; their directions stay. A piece without a direction
/// takes that of the one before. Lanes whose `active` is 0 keep their bytes.
static inline void restoreLengths(const ModifierArrays& a, const float* lengths, const float* active) {
    float oldX[lanes], oldY[lanes], oldZ[lanes], unitX[lanes], unitY[lanes], unitZ[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        oldX[l] = a.x[l];
        oldY[l] = a.y[l];
        oldZ[l] = a.z[l];
        unitX[l] = unitY[l] = unitZ[l] = 0.0f;
    }
    for (std::size_t v = 1; v < a.vertices; ++v) {
        const std::size_t row = v * lanes;
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = row + l;
            const float x = a.x[i] - oldX[l], y = a.y[i] - oldY[l], z = a.z[i] - oldZ[l];
            oldX[l] = a.x[i];
            oldY[l] = a.y[i];
            oldZ[l] = a.z[i];
            const float squared = x * x + y * y + z * z;
            const bool good = squared > tiny;
            const float inverse = 1.0f / __builtin_sqrtf(good ? squared : 1.0f);
            unitX[l] = good ? x * inverse : unitX[l];
            unitY[l] = good ? y * inverse : unitY[l];
            unitZ[l] = good ? z * inverse : unitZ[l];
            const float newX = a.x[i - lanes] + unitX[l] * lengths[i], newY = a.y[i - lanes] + unitY[l] * lengths[i],
                        newZ = a.z[i - lanes] + unitZ[l] * lengths[i];
            const bool on = active[l] > 0.0f;
            a.x[i] = on ? newX : a.x[i];
            a.y[i] = on ? newY : a.y[i];
            a.z[i] = on ? newZ : a.z[i];
        }
    }
}

}  // namespace whorl::modifier_lanes
