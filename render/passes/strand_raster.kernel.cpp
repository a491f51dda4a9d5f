// SPDX-License-Identifier: Apache-2.0
#include "render/passes/strand_raster.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

// Four floats that every processor handles at once: one pixel.
using Pixel = float __attribute__((vector_size(16)));

// The first pixel whose centre lies at or after `edge`, within [low, high].
int pixelFrom(float edge, int low, int high) {
    const float place = edge - 0.5f;
    if (!(place > static_cast<float>(low))) return low;
    if (place > static_cast<float>(high)) return high;
    const int whole = static_cast<int>(place - static_cast<float>(low)) + low;
    return static_cast<float>(whole) < place ? whole + 1 : whole;
}

// Steep: rows are stepped through; else columns. Pixels are mainStep and crossStep apart.
struct Way {
    float main0, cross0, main1, cross1;
    int mainLow, mainHigh, crossLow, crossHigh;
    std::ptrdiff_t mainStep, crossStep, depthMain, depthCross;
};

void draw(const RasterPoint& a, const RasterPoint& b, const Way& way, float fringe, const RasterTile& tile) {
    const float length = way.main1 - way.main0;
    const float slope = (way.cross1 - way.cross0) / length;
    const float cosine = 1.0f / __builtin_sqrtf(1.0f + slope * slope);
    const float perLength = 1.0f / length;
    const float soft = 0.5f / fringe;
    const int first = pixelFrom(way.main0, way.mainLow, way.mainHigh);
    const int last = pixelFrom(way.main1, way.mainLow, way.mainHigh);
    const Pixel colourA = {a.colour[0], a.colour[1], a.colour[2], 1.0f};
    const Pixel colourB = {b.colour[0], b.colour[1], b.colour[2], 1.0f};
    for (int i = first; i < last; ++i) {
        const float along = static_cast<float>(i) + 0.5f - way.main0;
        const float t = along * perLength;
        const float cross = way.cross0 + slope * along;
        const float half = a.halfWidth + (b.halfWidth - a.halfWidth) * t;
        const float reach = (half + fringe) / cosine;
        const float depth = a.depth + (b.depth - a.depth) * t;
        const float opacity = a.colour[3] + (b.colour[3] - a.colour[3]) * t;
        const Pixel colour = colourA + (colourB - colourA) * t;
        const int low = pixelFrom(cross - reach, way.crossLow, way.crossHigh);
        const int high = pixelFrom(cross + reach, way.crossLow, way.crossHigh);
        float* out = tile.pixels + (i - way.mainLow) * way.mainStep + (low - way.crossLow) * way.crossStep;
        const float* hidden = tile.depth + (i - way.mainLow) * way.depthMain + (low - way.crossLow) * way.depthCross;
        for (int j = low; j < high; ++j, out += way.crossStep, hidden += way.depthCross) {
            if (depth > *hidden) continue;
            const float off = static_cast<float>(j) + 0.5f - cross;
            float share = (half + fringe - (off < 0.0f ? -off : off) * cosine) * soft;
            share = share < 1.0f ? share : 1.0f;
            share = share > 0.0f ? share * opacity : 0.0f;
            Pixel* pixel = reinterpret_cast<Pixel*>(out);
            *pixel += (colour - *pixel) * share;
        }
    }
}

}  // namespace

void rasterTile(const RasterPoint* points, const std::uint32_t* segments, std::size_t count, float fringe,
                const RasterTile& tile) {
    for (std::size_t i = 0; i < count; ++i) {
        const RasterPoint* a = points + segments[i];
        const RasterPoint* b = a + 1;
        if (a->halfWidth < 0.0f || b->halfWidth < 0.0f) continue;
        const float dx = a->x < b->x ? b->x - a->x : a->x - b->x;
        const float dy = a->y < b->y ? b->y - a->y : a->y - b->y;
        const bool steep = dy >= dx;
        if ((steep ? dy : dx) < 1e-4f) continue;
        if (steep ? a->y > b->y : a->x > b->x) {
            const RasterPoint* swapped = a;
            a = b;
            b = swapped;
        }
        const std::ptrdiff_t row = std::ptrdiff_t{4} * tile.width;
        const Way way =
            steep ? Way{a->y,
                        a->x,
                        b->y,
                        b->x,
                        tile.y,
                        tile.y + tile.height,
                        tile.x,
                        tile.x + tile.width,
                        row,
                        4,
                        tile.depthPitch,
                        1}
                  : Way{a->x, a->y, b->x, b->y,           tile.x, tile.x + tile.width, tile.y, tile.y + tile.height,
                        4,    row,  1,    tile.depthPitch};
        draw(*a, *b, way, fringe, tile);
    }
}

void packTile(const RasterTile& tile, float scale, std::uint16_t* texels, std::size_t pitch) {
    for (int y = 0; y < tile.height; ++y) {
        const float* row = tile.pixels + std::ptrdiff_t{4} * y * tile.width;
        std::uint16_t* out = texels + static_cast<std::size_t>(y) * pitch * 4;
        for (int x = 0; x < 4 * tile.width; ++x) {
            float value = row[x] * scale * 65535.0f + 0.5f;
            value = value < 65535.0f ? value : 65535.0f;
            out[x] = static_cast<std::uint16_t>(static_cast<std::int32_t>(value > 0.0f ? value : 0.0f));
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
