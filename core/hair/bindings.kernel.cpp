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

}  // namespace whorl::WHORL_SIMD_NAMESPACE
