// SPDX-License-Identifier: Apache-2.0
// Sine and cosine of many turns, in floats. Internal linkage and plain arithmetic only (see core/base/simd.h).
#pragma once

#include <cstdint>

namespace whorl {

struct TurnSinCos {
    float sin;
    float cos;
};

/// Of an angle in whole turns, at most a million either way; error below 1e-6 of the rest after whole turns.
static inline TurnSinCos sinCosOfTurns(float turns) {
    const float nearest = static_cast<float>(static_cast<std::int32_t>(turns + (turns < 0.0f ? -0.5f : 0.5f)));
    const float rest = turns - nearest;  // -0.5 to 0.5
    // Folded to a quarter turn either way.
    const bool high = rest > 0.25f, low = rest < -0.25f;
    const float folded = high ? 0.5f - rest : low ? -0.5f - rest : rest;
    const float x = folded * 6.28318531f, q = x * x;
    const float s =
        x *
        (1.0f + q * (-1.0f / 6 + q * (1.0f / 120 + q * (-1.0f / 5040 + q * (1.0f / 362880 + q * (-1.0f / 39916800))))));
    const float c =
        1.0f + q * (-0.5f + q * (1.0f / 24 + q * (-1.0f / 720 + q * (1.0f / 40320 + q * (-1.0f / 3628800)))));
    return {s, high || low ? -c : c};
}

}  // namespace whorl
