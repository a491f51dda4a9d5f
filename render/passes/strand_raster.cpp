// SPDX-License-Identifier: Apache-2.0
#include "render/passes/strand_raster.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

constexpr int tileWidth = 64;
constexpr int tileHeight = 32;
constexpr std::size_t block = 8192;  // segments that one thread sorts at a time

// Tiles that a segment may touch: [x0, x1] x [y0, y1]; none when x0 > x1.
struct Touched {
    int x0 = 0, x1 = -1, y0 = 0, y1 = -1;
};

int tileOf(float pixel, float perTile, int tiles) {
    // Shifted by one, so that cutting off the fraction rounds down.
    return static_cast<int>(std::clamp(pixel * perTile + 1.0f, 0.0f, static_cast<float>(tiles + 1))) - 1;
}

Touched touched(const RasterPoint& a, const RasterPoint& b, float fringe, glm::ivec2 tiles) {
    // Also false for places that are not numbers.
    const bool shown = a.halfWidth >= 0.0f && b.halfWidth >= 0.0f && std::abs(a.x + a.y) + std::abs(b.x + b.y) < 1e9f;
    if (!shown) return {};
    // Across a slanted ribbon a row is up to sqrt(2) times as wide as the ribbon.
    const float reach = (std::max(a.halfWidth, b.halfWidth) + fringe) * 1.4143f + 1.0f;
    Touched found;
    found.x0 = std::max(tileOf(std::min(a.x, b.x) - reach, 1.0f / tileWidth, tiles.x), 0);
    found.x1 = std::min(tileOf(std::max(a.x, b.x) + reach, 1.0f / tileWidth, tiles.x), tiles.x - 1);
    found.y0 = std::max(tileOf(std::min(a.y, b.y) - reach, 1.0f / tileHeight, tiles.y), 0);
    found.y1 = std::min(tileOf(std::max(a.y, b.y) + reach, 1.0f / tileHeight, tiles.y), tiles.y - 1);
    return found;
}

}  // namespace

glm::ivec2 StrandRaster::tiles() const {
    return {(m_size.x + tileWidth - 1) / tileWidth, (m_size.y + tileHeight - 1) / tileHeight};
}

void StrandRaster::begin(glm::ivec2 size, std::span<const float> depth, float fringe) {
    m_size = size;
    m_depth = depth;
    m_fringe = std::max(fringe, 0.05f);
    m_batches.clear();
    m_region = {};
}

void StrandRaster::add(std::span<const RasterPoint> points, std::span<const std::uint32_t> segments) {
    if (segments.empty()) return;
    m_batches.emplace_back();
    m_batches.back().points = points;
    sort(segments, m_batches.back());
}

// A counting sort by tile that keeps the order within each tile: blocks are counted, then placed, in parallel.
void StrandRaster::sort(std::span<const std::uint32_t> segments, Batch& batch) const {
    const glm::ivec2 count = tiles();
    const auto tileCount = static_cast<std::size_t>(count.x * count.y);
    const std::size_t blocks = (segments.size() + block - 1) / block;
    std::vector<std::uint32_t> places(blocks * tileCount, 0);
    const auto eachTile = [&](std::uint32_t segment, const auto& visit) {
        const Touched found = touched(batch.points[segment], batch.points[segment + 1], m_fringe, count);
        for (int y = found.y0; y <= found.y1; ++y) {
            for (int x = found.x0; x <= found.x1; ++x) visit(static_cast<std::size_t>(y * count.x + x));
        }
    };
    parallelFor(segments.size(), block, [&](std::size_t begin, std::size_t end) {
        std::uint32_t* own = places.data() + begin / block * tileCount;
        for (std::size_t i = begin; i < end; ++i) eachTile(segments[i], [&](std::size_t tile) { ++own[tile]; });
    });
    batch.tileStart.assign(tileCount + 1, 0);
    std::uint32_t sum = 0;
    for (std::size_t tile = 0; tile < tileCount; ++tile) {
        batch.tileStart[tile] = sum;
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::uint32_t here = places[b * tileCount + tile];
            places[b * tileCount + tile] = sum;
            sum += here;
        }
    }
    batch.tileStart[tileCount] = sum;
    batch.segments.resize(sum);
    parallelFor(segments.size(), block, [&](std::size_t begin, std::size_t end) {
        std::uint32_t* own = places.data() + begin / block * tileCount;
        for (std::size_t i = begin; i < end; ++i) {
            eachTile(segments[i], [&](std::size_t tile) { batch.segments[own[tile]++] = segments[i]; });
        }
    });
}

void StrandRaster::draw() {
    const glm::ivec2 count = tiles();
    int x0 = count.x;
    int x1 = -1;
    int y0 = count.y;
    int y1 = -1;
    for (int y = 0; y < count.y; ++y) {
        for (int x = 0; x < count.x; ++x) {
            const auto tile = static_cast<std::size_t>(y * count.x + x);
            const bool any = std::any_of(m_batches.begin(), m_batches.end(), [&](const Batch& batch) {
                return batch.tileStart[tile + 1] > batch.tileStart[tile];
            });
            if (!any) continue;
            x0 = std::min(x0, x);
            x1 = std::max(x1, x);
            y0 = std::min(y0, y);
            y1 = std::max(y1, y);
        }
    }
    if (x1 < 0) return;
    m_region.x = x0 * tileWidth;
    m_region.y = y0 * tileHeight;
    m_region.width = std::min((x1 + 1) * tileWidth, m_size.x) - m_region.x;
    m_region.height = std::min((y1 + 1) * tileHeight, m_size.y) - m_region.y;
    const auto pitch = static_cast<std::size_t>(m_size.x);
    m_texels.resize(pitch * static_cast<std::size_t>(m_size.y) * 4);
    const auto rasterTile = WHORL_PICK(rasterTile);
    const auto packTile = WHORL_PICK(packTile);
    const int columns = x1 - x0 + 1;
    parallelFor(static_cast<std::size_t>(columns * (y1 - y0 + 1)), 1, [&](std::size_t begin, std::size_t) {
        const int column = x0 + static_cast<int>(begin) % columns;
        const int row = y0 + static_cast<int>(begin) / columns;
        alignas(64) std::array<float, std::size_t{tileWidth} * tileHeight * 4> pixels;
        RasterTile tile{};
        tile.x = column * tileWidth;
        tile.y = row * tileHeight;
        tile.width = std::min(tileWidth, m_size.x - tile.x);
        tile.height = std::min(tileHeight, m_size.y - tile.y);
        const std::size_t first = static_cast<std::size_t>(tile.y) * pitch + static_cast<std::size_t>(tile.x);
        tile.depth = m_depth.data() + first;
        tile.depthPitch = m_size.x;
        tile.pixels = pixels.data();
        std::memset(pixels.data(), 0, sizeof(pixels));
        const auto index = static_cast<std::size_t>(row * count.x + column);
        for (const Batch& batch : m_batches) {
            const std::uint32_t start = batch.tileStart[index];
            rasterTile(batch.points.data(), batch.segments.data() + start, batch.tileStart[index + 1] - start, m_fringe,
                       tile);
        }
        packTile(tile, 1.0f / brightest, m_texels.data() + first * 4, pitch);
    });
}

const std::uint16_t* StrandRaster::texels() const {
    return m_texels.data() + (static_cast<std::size_t>(m_region.y) * static_cast<std::size_t>(m_size.x) +
                              static_cast<std::size_t>(m_region.x)) *
                                 4;
}

}  // namespace whorl
