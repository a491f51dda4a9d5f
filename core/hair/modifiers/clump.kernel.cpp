// SPDX-License-Identifier: Apache-2.0
// Hairs go to the curve of their lock's middle.
#include "core/hair/modifiers/lanes.h"
#include "core/model/modifiers/rows.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using namespace modifier_lanes;

void clumpHairs(const ModifierArrays& a) {
    const float *amount = numberRow(a, 1), *tip = numberRow(a, ClumpRows::Tightness),
                *root = numberRow(a, ClumpRows::RootTightness), *profile = numberRow(a, ClumpRows::Profile),
                *flyaways = numberRow(a, ClumpRows::Flyaways);
    float pull[lanes];
    for (std::size_t l = 0; l < lanes; ++l) pull[l] = a.random[l] < flyaways[l] ? 0.0f : amount[l] * a.centreWeight[l];
    const bool keep = numberRow(a, ClumpRows::KeepLength)[0] > 0.0f;
    if (keep) pieceLengths(a, a.scratch);
    for (std::size_t v = 1; v < a.vertices; ++v) {
        const float along = a.along[v], ease = a.ease[v];
        const auto vertex = static_cast<std::uint32_t>(v);
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = v * lanes + l;
            const std::uint32_t from = a.centreFirst[l] + vertex;
            const float weight = pull[l] * ease * (root[l] + (tip[l] - root[l]) * bias(along, profile[l]));
            const float x = a.x[i] + weight * (a.centreX[from] - a.x[i]);
            const float y = a.y[i] + weight * (a.centreY[from] - a.y[i]);
            const float z = a.z[i] + weight * (a.centreZ[from] - a.z[i]);
            const bool on = pull[l] > 0.0f;
            a.x[i] = on ? x : a.x[i];
            a.y[i] = on ? y : a.y[i];
            a.z[i] = on ? z : a.z[i];
        }
    }
    if (keep) restoreLengths(a, a.scratch, pull);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
