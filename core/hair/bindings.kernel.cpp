// SPDX-License-Identifier: Apache-2.0
#include "core/hair/bindings.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

void distancesToGuides(const GuideColumns& g, const float* root, float* squared) {
    const float px = root[0], py = root[1], pz = root[2], nx = root[3], ny = root[4], nz = root[5];
    for (std::size_t start = 0; start < g.count; start += guideLanes) {
        const float *gx = g.x + start, *gy = g.y + start, *gz = g.z + start;
        const float *mx = g.normalX + start, *my = g.normalY + start, *mz = g.normalZ + start;
        float* out = squared + start;
        for (std::size_t i = 0; i < guideLanes; ++i) {
            const float x = px - gx[i], y = py - gy[i], z = pz - gz[i];
            const float cosine = nx * mx[i] + ny * my[i] + nz * mz[i];
            const float half = (1.0f - cosine) * 0.5f;
            const float turned = half > 0.0f ? half : 0.0f;
            const float factor = 1.0f + 8.0f * turned * turned;
            out[i] = (x * x + y * y + z * z) * factor * factor;
        }
    }
}

void weightedTurns(TurnColumns& t) {
    for (std::size_t i = 0; i < guideLanes; ++i) {
        const float fx = t.from[0][i], fy = t.from[1][i], fz = t.from[2][i];
        const float tx = t.to[0][i], ty = t.to[1][i], tz = t.to[2][i];
        const float wx = fy * tz - fz * ty, wy = fz * tx - fx * tz, wz = fx * ty - fy * tx;
        const float cosine = fx * tx + fy * ty + fz * tz;
        const float k = 1.0f / (1.0f + cosine);
        const float weight = t.weight[i];
        const float kx = k * wx, ky = k * wy;
        t.matrix[0][i] = weight * (cosine + kx * wx);
        t.matrix[1][i] = weight * (kx * wy - wz);
        t.matrix[2][i] = weight * (kx * wz + wy);
        t.matrix[3][i] = weight * (kx * wy + wz);
        t.matrix[4][i] = weight * (cosine + ky * wy);
        t.matrix[5][i] = weight * (ky * wz - wx);
        t.matrix[6][i] = weight * (kx * wz - wy);
        t.matrix[7][i] = weight * (ky * wz + wx);
        t.matrix[8][i] = weight * (cosine + k * wz * wz);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
