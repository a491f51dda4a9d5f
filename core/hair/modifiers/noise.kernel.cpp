// SPDX-License-Identifier: Apache-2.0
// A noise vector at every vertex.
#include "core/base/noise.h"

#include "core/hair/modifiers/lanes.h"
#include "core/model/modifiers/rows.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using namespace modifier_lanes;

namespace {

// Adds noise at the places of one row, each lane's weighted.
inline void addNoise(const float* x, const float* y, const float* z, const float* weight, float* outX, float* outY,
                     float* outZ) {
    for (std::size_t l = 0; l < lanes; ++l) {
        float noise[3];
        perlinVector(x[l], y[l], z[l], noise);
        outX[l] += weight[l] * noise[0];
        outY[l] += weight[l] * noise[1];
        outZ[l] += weight[l] * noise[2];
    }
}

}  // namespace

void noiseHairs(const ModifierArrays& a) {
    const float *amount = numberRow(a, 1), *root = numberRow(a, NoiseRows::RootAmplitude),
                *tip = numberRow(a, NoiseRows::TipAmplitude), *fx = numberRow(a, NoiseRows::Frequency),
                *fy = fx + lanes, *fz = fy + lanes, *together = numberRow(a, NoiseRows::Correlation);
    const bool keep = numberRow(a, NoiseRows::KeepLength)[0] > 0.0f;
    const int octaves = static_cast<int>(numberRow(a, NoiseRows::Octaves)[0]);
    if (keep) pieceLengths(a, a.scratch);
    bool anyTogether = false, anyAlone = false;
    for (std::size_t l = 0; l < lanes; ++l) {
        anyTogether = anyTogether || together[l] > 0.0f;
        anyAlone = anyAlone || together[l] < 1.0f;
    }
    for (std::size_t v = 1; v < a.vertices; ++v) {
        const float along = a.along[v], ease = a.ease[v];
        float *x = a.x + v * lanes, *y = a.y + v * lanes, *z = a.z + v * lanes;
        float pushX[lanes] = {}, pushY[lanes] = {}, pushZ[lanes] = {};
        float scale = 1.0f, share = 1.0f;
        for (int octave = 0; octave < octaves; ++octave) {
            float px[lanes], py[lanes], pz[lanes], weight[lanes];
            for (std::size_t l = 0; l < lanes; ++l) {
                px[l] = x[l] * fx[l] * scale + a.offset[0];
                py[l] = y[l] * fy[l] * scale + a.offset[1];
                pz[l] = z[l] * fz[l] * scale + a.offset[2];
                weight[l] = share * together[l];
            }
            if (anyTogether) addNoise(px, py, pz, weight, pushX, pushY, pushZ);
            for (std::size_t l = 0; l < lanes; ++l) {
                px[l] += 251.0f * a.random[l];
                py[l] += 241.0f * a.random[lanes + l];
                pz[l] += 239.0f * a.random[2 * lanes + l];
                weight[l] = share * (1.0f - together[l]);
            }
            if (anyAlone) addNoise(px, py, pz, weight, pushX, pushY, pushZ);
            scale *= 2.0f;
            share *= 0.5f;
        }
        for (std::size_t l = 0; l < lanes; ++l) {
            const float strength = amount[l] * ease * (root[l] + (tip[l] - root[l]) * along);
            const bool on = amount[l] > 0.0f;
            x[l] = on ? x[l] + strength * pushX[l] : x[l];
            y[l] = on ? y[l] + strength * pushY[l] : y[l];
            z[l] = on ? z[l] + strength * pushZ[l] : z[l];
        }
    }
    if (keep) restoreLengths(a, a.scratch, amount);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
