// SPDX-License-Identifier: Apache-2.0
// Elementary functions in plain arithmetic: the same bytes on every machine, whatever its libm.
#pragma once

// Internal linkage only, so that kernel sources may use them (see core/base/simd.h).

namespace whorl {

struct SinCos {
    double sin;
    double cos;
};

/// Sine and cosine of an angle of at most 2 pi either way; error below 1e-9.
static inline SinCos sinCos(double angle) {
    // Taylor series of an eighth of the angle, doubled three times.
    const double x = angle * 0.125, q = x * x;
    double s =
        x * (1 + q * (-1.0 / 6 +
                      q * (1.0 / 120 +
                           q * (-1.0 / 5040 + q * (1.0 / 362880 + q * (-1.0 / 39916800 + q * (1.0 / 6227020800.0)))))));
    double c =
        1 + q * (-0.5 + q * (1.0 / 24 +
                             q * (-1.0 / 720 + q * (1.0 / 40320 + q * (-1.0 / 3628800 + q * (1.0 / 479001600.0))))));
    for (int i = 0; i < 3; ++i) {
        const double doubled = 2 * s * c;
        c = c * c - s * s;
        s = doubled;
    }
    return {s, c};
}

/// 3t^2 - 2t^3 of t limited to 0 to 1.
static inline float smoothStep(float t) {
    const float low = t < 0.0f ? 0.0f : t;
    const float limited = low > 1.0f ? 1.0f : low;
    return limited * limited * (3.0f - 2.0f * limited);
}

}  // namespace whorl
