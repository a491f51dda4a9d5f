// SPDX-License-Identifier: Apache-2.0
// Takes bends out of hairs.
#include "core/hair/modifiers/lanes.h"
#include "core/model/modifiers/rows.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using namespace modifier_lanes;

namespace {

// One step for one coordinate: vertices go towards the middle between their neighbours; the ends stay.
inline void smoothOnce(float* p, std::size_t vertices, const float* share) {
    float before[lanes];
    for (std::size_t l = 0; l < lanes; ++l) before[l] = p[l];
    for (std::size_t v = 1; v + 1 < vertices; ++v) {
        float* here = p + v * lanes;
        const float* next = here + lanes;
        for (std::size_t l = 0; l < lanes; ++l) {
            const float old = here[l];
            const float moved = old + share[l] * (0.5f * (before[l] + next[l]) - old);
            before[l] = old;
            here[l] = share[l] > 0.0f ? moved : old;
        }
    }
}

}  // namespace

void smoothHairs(const ModifierArrays& a) {
    const float *amount = numberRow(a, 1), *strength = numberRow(a, SmoothRows::Strength);
    const bool keep = numberRow(a, SmoothRows::KeepLength)[0] > 0.0f;
    const int steps = static_cast<int>(numberRow(a, SmoothRows::Iterations)[0]);
    // Half of the way at most: all of it would make waves of two pieces swing.
    float share[lanes];
    for (std::size_t l = 0; l < lanes; ++l) share[l] = 0.5f * amount[l] * strength[l];
    if (keep) pieceLengths(a, a.scratch);
    for (int step = 0; step < steps; ++step) {
        smoothOnce(a.x, a.vertices, share);
        smoothOnce(a.y, a.vertices, share);
        smoothOnce(a.z, a.vertices, share);
    }
    if (keep) restoreLengths(a, a.scratch, share);
}

void straightenHairs(const ModifierArrays& a) {
    const float *amount = numberRow(a, 1), *root = numberRow(a, StraightenRows::Root),
                *tip = numberRow(a, StraightenRows::Tip);
    const bool keep = numberRow(a, StraightenRows::KeepLength)[0] > 0.0f;
    const std::size_t last = (a.vertices - 1) * lanes;
    pieceLengths(a, a.scratch);
    float whole[lanes] = {}, ux[lanes], uy[lanes], uz[lanes], stretch[lanes], way[lanes] = {}, strong[lanes];
    for (std::size_t v = 1; v < a.vertices; ++v)
        for (std::size_t l = 0; l < lanes; ++l) whole[l] += a.scratch[v * lanes + l];
    for (std::size_t l = 0; l < lanes; ++l) {
        const float x = a.x[last + l] - a.x[l], y = a.y[last + l] - a.y[l], z = a.z[last + l] - a.z[l];
        const float chord = __builtin_sqrtf(x * x + y * y + z * z);
        // A hair that comes back to its root has no line to lie on.
        const bool good = chord > 1e-3f * whole[l] && chord > 1e-12f;
        const float inverse = 1.0f / (good ? chord : 1.0f);
        ux[l] = x * inverse;
        uy[l] = y * inverse;
        uz[l] = z * inverse;
        stretch[l] = keep ? 1.0f : chord / (whole[l] > 1e-12f ? whole[l] : 1.0f);
        strong[l] = good ? amount[l] : 0.0f;
    }
    for (std::size_t v = 1; v < a.vertices; ++v) {
        const float along = a.along[v];
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = v * lanes + l;
            way[l] += a.scratch[i];
            const float reach = way[l] * stretch[l];
            const float weight = strong[l] * (root[l] + (tip[l] - root[l]) * along);
            const float x = a.x[i] + weight * (a.x[l] + ux[l] * reach - a.x[i]);
            const float y = a.y[i] + weight * (a.y[l] + uy[l] * reach - a.y[i]);
            const float z = a.z[i] + weight * (a.z[l] + uz[l] * reach - a.z[i]);
            const bool on = strong[l] > 0.0f;
            a.x[i] = on ? x : a.x[i];
            a.y[i] = on ? y : a.y[i];
            a.z[i] = on ? z : a.z[i];
        }
    }
    if (keep) restoreLengths(a, a.scratch, strong);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
