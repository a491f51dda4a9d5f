// SPDX-License-Identifier: Apache-2.0
// Hair hangs: pieces turn towards a direction, more and more to the tip.
#include "core/hair/modifiers/lanes.h"
#include "core/model/modifiers/rows.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using namespace modifier_lanes;

void bendHairs(const ModifierArrays& a) {
    const float *dx = numberRow(a, BendRows::Direction), *dy = dx + lanes, *dz = dy + lanes;
    const float *amount = numberRow(a, 1), *strength = numberRow(a, BendRows::Strength),
                *stiffness = numberRow(a, BendRows::Stiffness), *byThickness = numberRow(a, BendRows::ByThickness),
                *byLength = numberRow(a, BendRows::ByLength), *reference = numberRow(a, BendRows::ReferenceLength);
    pieceLengths(a, a.scratch);
    float whole[lanes] = {}, force[lanes], late[lanes], gx[lanes], gy[lanes], gz[lanes];
    for (std::size_t v = 1; v < a.vertices; ++v)
        for (std::size_t l = 0; l < lanes; ++l) whole[l] += a.scratch[v * lanes + l];
    for (std::size_t l = 0; l < lanes; ++l) {
        const float squared = dx[l] * dx[l] + dy[l] * dy[l] + dz[l] * dz[l];
        const bool directed = squared > 1e-12f;
        const float inverse = 1.0f / __builtin_sqrtf(directed ? squared : 1.0f);
        gx[l] = dx[l] * inverse;
        gy[l] = dy[l] * inverse;
        gz[l] = dz[l] * inverse;
        const float heavy = 1.0f + byLength[l] * (whole[l] / reference[l] - 1.0f);
        const float thick = a.thickness[l] > 0.05f ? a.thickness[l] : 0.05f;
        const float weak = 1.0f + byThickness[l] * (1.0f / (thick * thick) - 1.0f);
        force[l] = directed ? amount[l] * strength[l] * heavy * weak : 0.0f;
        late[l] = clamped(1.0f - stiffness[l], 0.02f, 0.98f);
    }
    float oldX[lanes], oldY[lanes], oldZ[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        oldX[l] = a.x[l];
        oldY[l] = a.y[l];
        oldZ[l] = a.z[l];
    }
    for (std::size_t v = 1; v < a.vertices; ++v) {
        const float middle = 0.5f * (a.along[v - 1] + a.along[v]);
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = v * lanes + l;
            const float length = a.scratch[i];
            const float pull = length * force[l] * bias(middle, late[l]);
            const float x = a.x[i] - oldX[l] + pull * gx[l], y = a.y[i] - oldY[l] + pull * gy[l],
                        z = a.z[i] - oldZ[l] + pull * gz[l];
            const float squared = x * x + y * y + z * z;
            // A piece that is pulled straight against its own direction has no way to turn.
            const bool good = squared > tiny && force[l] > 0.0f;
            const float stretch = length / __builtin_sqrtf(good ? squared : 1.0f);
            const float stayX = a.x[i] - oldX[l], stayY = a.y[i] - oldY[l], stayZ = a.z[i] - oldZ[l];
            oldX[l] = a.x[i];
            oldY[l] = a.y[i];
            oldZ[l] = a.z[i];
            const bool on = force[l] > 0.0f;
            const float newX = a.x[i - lanes] + (good ? x * stretch : stayX),
                        newY = a.y[i - lanes] + (good ? y * stretch : stayY),
                        newZ = a.z[i - lanes] + (good ? z * stretch : stayZ);
            a.x[i] = on ? newX : a.x[i];
            a.y[i] = on ? newY : a.y[i];
            a.z[i] = on ? newZ : a.z[i];
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
