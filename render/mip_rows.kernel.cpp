// SPDX-License-Identifier: Apache-2.0
#include "render/mip_rows.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

// Two bytes of a texel at a time, each with room for sums.
void halveRows(const std::uint32_t* above, const std::uint32_t* below, const std::uint8_t* maskAbove,
               const std::uint8_t* maskBelow, std::size_t count, std::uint32_t* out) {
    constexpr std::uint32_t bytes = 0x00ff00ffu;
    if (maskAbove == nullptr) {
        for (std::size_t x = 0; x < count; ++x) {
            const std::uint32_t a = above[2 * x], b = above[2 * x + 1], c = below[2 * x], d = below[2 * x + 1];
            const std::uint32_t even = (a & bytes) + (b & bytes) + (c & bytes) + (d & bytes) + 0x00020002u;
            const std::uint32_t odd =
                ((a >> 8) & bytes) + ((b >> 8) & bytes) + ((c >> 8) & bytes) + ((d >> 8) & bytes) + 0x00020002u;
            out[x] = ((even >> 2) & bytes) | (((odd >> 2) & bytes) << 8);
        }
        return;
    }
    for (std::size_t x = 0; x < count; ++x) {
        const std::uint32_t ma = maskAbove[2 * x], mb = maskAbove[2 * x + 1];
        const std::uint32_t mc = maskBelow[2 * x], md = maskBelow[2 * x + 1];
        const std::uint32_t a = above[2 * x] & (0u - ma), b = above[2 * x + 1] & (0u - mb);
        const std::uint32_t c = below[2 * x] & (0u - mc), d = below[2 * x + 1] & (0u - md);
        const std::uint32_t n = ma + mb + mc + md;
        // 65536 / n, rounded up: exact for sums of bytes.
        const std::uint32_t share = n == 1 ? 65536u : n == 2 ? 32768u : n == 3 ? 21846u : 16384u;
        const std::uint32_t half = n >> 1;
        const std::uint32_t even = (a & bytes) + (b & bytes) + (c & bytes) + (d & bytes) + half * 0x00010001u;
        const std::uint32_t odd =
            ((a >> 8) & bytes) + ((b >> 8) & bytes) + ((c >> 8) & bytes) + ((d >> 8) & bytes) + half * 0x00010001u;
        const std::uint32_t e0 = ((even & 0xffffu) * share) >> 16, e1 = ((even >> 16) * share) >> 16;
        const std::uint32_t o0 = ((odd & 0xffffu) * share) >> 16, o1 = ((odd >> 16) * share) >> 16;
        out[x] = e0 | (o0 << 8) | (e1 << 16) | (o1 << 24);
    }
}

std::uint8_t halveMask(const std::uint8_t* above, const std::uint8_t* below, std::size_t count, std::uint8_t* out) {
    std::uint8_t all = 1;
    for (std::size_t x = 0; x < count; ++x) {
        const std::uint8_t a = above[2 * x], b = above[2 * x + 1], c = below[2 * x], d = below[2 * x + 1];
        out[x] = static_cast<std::uint8_t>(a | b | c | d);
        all = static_cast<std::uint8_t>(all & a & b & c & d);
    }
    return all;
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
