// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_pixels.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

// How fast a hair ends where it ranks too low: over a quarter of the ranks.
constexpr std::int32_t sharpness = 4;
constexpr int atOnce = 64;

void coverOf(const std::uint8_t* __restrict rank, const std::uint8_t* __restrict density,
             const std::uint8_t* __restrict reaching, const std::uint8_t* __restrict opacity,
             std::uint8_t* __restrict cover, int count) {
    for (int i = 0; i < count; ++i) {
        const std::int32_t share = (density[i] * reaching[i] + 127) / 255;
        const std::int32_t above = (rank[i] - (255 - share)) * sharpness + share;
        const std::int32_t low = above < 0 || share == 0 ? 0 : above;
        const std::int32_t hairs = low > 255 ? 255 : low;
        cover[i] = static_cast<std::uint8_t>((hairs * opacity[i] + 127) / 255);
    }
}

void gatherFloats(const float* __restrict table, const std::int32_t* __restrict at, float* __restrict out) {
    for (int i = 0; i < atOnce; ++i) out[i] = table[at[i]];
}

void mixed(const float* __restrict place, float mutant, const float* __restrict share, float* __restrict out) {
    for (int i = 0; i < atOnce; ++i) out[i] = place[i] * (1.0f - share[i]) + mutant * share[i];
}

// Row by row a x + b y + c z, as a number of the table.
void turned(const float* __restrict a, const float* __restrict b, const float* __restrict c, const float* __restrict x,
            const float* __restrict y, const float* __restrict z, std::int32_t* __restrict out) {
    for (int i = 0; i < atOnce; ++i) {
        const float linear = a[i] * x[i] + b[i] * y[i] + c[i] * z[i];
        const float above = linear > 0.0f ? linear : 0.0f;
        const float limited = above > 1.0f ? 1.0f : above;
        out[i] = static_cast<std::int32_t>(limited * 4095.0f + 0.5f);
    }
}

void encoded(const std::uint32_t* __restrict table, const std::int32_t* __restrict red,
             const std::int32_t* __restrict green, const std::int32_t* __restrict blue, std::uint32_t* __restrict out) {
    for (int i = 0; i < atOnce; ++i) out[i] = table[red[i]] | table[green[i]] << 8 | table[blue[i]] << 16;
}

}  // namespace

void licCoverPixels(const LicCoverPixels& p) {
    for (int i = 0; i < p.count; ++i) p.rank[i] = p.ranks[p.hair[i]];
    if (p.cover) coverOf(p.rank, p.density, p.reaching, p.opacity, p.cover, p.count);
}

void licColourPixels(const LicColourPixels& p) {
    const LicVariations& v = *p.variations;
    for (int first = 0; first < p.count; first += atOnce) {
        const int some = p.count - first < atOnce ? p.count - first : atOnce;
        std::int32_t rank[atOnce], numbers[3][atOnce];
        float place[3][atOnce], share[atOnce], turn[3][atOnce], colour[3][atOnce];
        for (int i = 0; i < atOnce; ++i) rank[i] = i < some ? p.rank[first + i] : 0;
        gatherFloats(v.share, rank, share);
        for (int k = 0; k < 3; ++k) {
            gatherFloats(v.turn[k], rank, turn[k]);
            const float* from = p.place[k] + first;
            for (int i = 0; i < some; ++i) place[k][i] = from[i];
            for (int i = some; i < atOnce; ++i) place[k][i] = 0.0f;
            mixed(place[k], v.mutant[k], share, colour[k]);
        }
        turned(turn[0], turn[1], turn[2], colour[0], colour[1], colour[2], numbers[0]);
        turned(turn[2], turn[0], turn[1], colour[0], colour[1], colour[2], numbers[1]);
        turned(turn[1], turn[2], turn[0], colour[0], colour[1], colour[2], numbers[2]);
        std::uint32_t colours[atOnce];
        encoded(p.encoded, numbers[0], numbers[1], numbers[2], colours);
        for (int i = 0; i < some; ++i) p.colours[first + i] = colours[i];
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
