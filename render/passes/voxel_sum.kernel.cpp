// SPDX-License-Identifier: Apache-2.0
#include "render/passes/voxel_sum.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

void sumVoxels(const std::uint32_t* counts, std::uint16_t* texels, float texelsOfCount, float softness, int yBegin,
               int yEnd) {
    constexpr int side = 128;
    for (int y = yBegin; y < yEnd; ++y) {
        std::uint32_t sum[side];
        float before[nearVoxels][side];  // the last cells, around and around
        float middle[side];
        float spread[side];
        for (int x = 0; x < side; ++x) sum[x] = 0;
        for (auto& cells : before) {
            for (int x = 0; x < side; ++x) cells[x] = 0.0f;
        }
        for (int z = 0; z < side; ++z) {
            const std::uint32_t* row = counts + (z * side + y) * side;
            const std::uint32_t* above = y > 0 ? row - side : row;
            const std::uint32_t* below = y + 1 < side ? row + side : row;
            std::uint16_t* out = texels + (z * side + y) * side;
            float* far = before[z % nearVoxels];
            for (int x = 0; x < side; ++x) {
                const std::uint32_t here = (above[x] + 2 * row[x] + below[x]) >> 2;
                // Half of a cell's own hair lies before its centre.
                const float all = static_cast<float>(static_cast<std::int32_t>(sum[x] + (here >> 1)));
                const float near = all - far[x];
                middle[x] = far[x] + near / (1.0f + near * softness);
                far[x] = all;
                sum[x] += here;
            }
            spread[0] = 0.0f;
            spread[side - 1] = 0.0f;
            for (int x = 1; x < side - 1; ++x) {
                spread[x] = (0.25f * (middle[x - 1] + middle[x + 1]) + 0.5f * middle[x]) * texelsOfCount;
            }
            for (int x = 0; x < side; ++x) {
                const float most = spread[x] < 65535.0f ? spread[x] : 65535.0f;
                out[x] = static_cast<std::uint16_t>(static_cast<std::int32_t>(most));
            }
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
