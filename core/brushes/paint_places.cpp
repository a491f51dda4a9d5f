// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/paint_places.h"

#include "core/base/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace whorl {
namespace {

constexpr std::size_t blockSize = 32;
constexpr int tileSize = Map::tileSize;

Map shapeOf(const Map& map) {
    Map shape(map.width(), map.height(), 1, TexelFormat::U8, 0.0f);
    shape.flipV = map.flipV;
    return shape;
}

// Triangles over more texels than this each way are not listed tile by tile: a mesh of many such triangles would need
// more memory than it is worth.
constexpr std::int32_t wideTexels = 4 * tileSize;

bool isWide(const TexelBox& box) {
    return box.x1 - box.x0 > wideTexels || box.y1 - box.y0 > wideTexels;
}

}  // namespace

std::shared_ptr<PaintPlaces> PaintPlaces::of(const Surface& surface, const Map& shape) {
    std::shared_ptr<PaintPlaces> kept = surface.paintPlaces();
    const bool fits = kept && kept->m_shape.width() == shape.width() && kept->m_shape.height() == shape.height() &&
                      kept->m_shape.flipV == shape.flipV && kept->bytes() < mostBytes;
    if (fits) return kept;
    auto places = std::make_shared<PaintPlaces>(surface.shared, shape);
    surface.setPaintPlaces(places);
    return places;
}

PaintPlaces::PaintPlaces(Cow<SurfaceMesh> shared, const Map& shape)
    : m_mesh(std::move(shared)),
      m_shape(shapeOf(shape)),
      m_columns(shape.tileColumns()),
      m_rows(shape.tileRows()),
      m_tiles(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows)) {
    const SurfaceMesh& mesh = *m_mesh;
    const std::size_t count = mesh.triangles.size();
    m_boxes.resize(count);
    m_blocks.resize((count + blockSize - 1) / blockSize);
    parallelFor(m_blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const std::size_t first = b * blockSize, last = std::min(count, first + blockSize);
            glm::vec3 low(1e30f), high(-1e30f);
            for (std::size_t t = first; t < last; ++t) {
                m_boxes[t] = texelBox(mesh, m_shape, static_cast<std::uint32_t>(t));
                for (int k = 0; k < 3; ++k) {
                    low = glm::min(low, mesh.positions[mesh.triangles[t][k]]);
                    high = glm::max(high, mesh.positions[mesh.triangles[t][k]]);
                }
            }
            m_blocks[b] = {(low + high) * 0.5f, glm::length(high - low) * 0.5f};
        }
    });
    // Triangles by tile: count, then fill. A triangle that goes once around the map meets a tile twice.
    m_firstOfTile.assign(m_tiles.size() + 1, 0);
    for (std::size_t t = 0; t < count; ++t) {
        if (isWide(m_boxes[t])) {
            m_wide.push_back(static_cast<std::uint32_t>(t));
            continue;
        }
        forTilesOf(m_boxes[t], [&](std::size_t tile) { ++m_firstOfTile[tile + 1]; });
    }
    for (std::size_t i = 1; i < m_firstOfTile.size(); ++i) m_firstOfTile[i] += m_firstOfTile[i - 1];
    m_tileTriangles.resize(m_firstOfTile.back());
    std::vector<std::size_t> next(m_firstOfTile.begin(), m_firstOfTile.end() - 1);
    for (std::size_t t = 0; t < count; ++t) {
        if (isWide(m_boxes[t])) continue;
        forTilesOf(m_boxes[t],
                   [&](std::size_t tile) { m_tileTriangles[next[tile]++] = static_cast<std::uint32_t>(t); });
    }
}

template <class Visit>
void PaintPlaces::forTilesOf(const TexelBox& box, Visit&& visit) const {
    if (box.x1 < box.x0) return;
    const auto wrapped = [](int texel, int size) { return ((texel % size) + size) % size; };
    const int width = m_shape.width(), height = m_shape.height();
    // Columns wrap at the width of the map, which need not be a multiple of the tile size.
    for (int y = box.y0 - border; y <= box.y1 + border;) {
        const int row = wrapped(y, height) / tileSize;
        for (int x = box.x0 - border; x <= box.x1 + border;) {
            const int column = wrapped(x, width) / tileSize;
            visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(m_columns) +
                  static_cast<std::size_t>(column));
            x += std::min(tileSize * (column + 1), width) - wrapped(x, width);
        }
        y += std::min(tileSize * (row + 1), height) - wrapped(y, height);
    }
}

void PaintPlaces::findTiles(const glm::vec3& centre, float radius, std::vector<std::uint8_t>& wanted,
                            std::vector<std::size_t>& tiles) const {
    const SurfaceMesh& mesh = *m_mesh;
    wanted.resize(m_tiles.size(), 0);
    tiles.clear();
    const auto within = [&](const BoundingBall& ball) {
        const float limit = (radius + ball.radius) * 1.0001f;
        return glm::dot(ball.centre - centre, ball.centre - centre) <= limit * limit;
    };
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        if (!within(m_blocks[b])) continue;
        const std::size_t last = std::min(mesh.triangles.size(), (b + 1) * blockSize);
        for (std::size_t t = b * blockSize; t < last; ++t) {
            if (!within(ballOf(mesh, static_cast<std::uint32_t>(t)))) continue;
            forTilesOf(m_boxes[t], [&](std::size_t tile) {
                if (wanted[tile] != 0) return;
                wanted[tile] = 1;
                tiles.push_back(tile);
            });
        }
    }
    std::sort(tiles.begin(), tiles.end());
    for (const std::size_t tile : tiles) wanted[tile] = 0;
}

const PaintTile& PaintPlaces::tile(std::size_t index) {
    Slot& slot = m_tiles[index];
    std::call_once(slot.once, [&] {
        const auto columns = static_cast<std::size_t>(m_columns);
        const auto at = [&](std::size_t i) { return m_tileTriangles.begin() + static_cast<std::ptrdiff_t>(i); };
        std::vector<std::uint32_t> triangles(m_wide);
        triangles.insert(triangles.end(), at(m_firstOfTile[index]), at(m_firstOfTile[index + 1]));
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        slot.tile = buildTile(*m_mesh, m_shape, m_boxes, triangles, static_cast<int>(index % columns),
                              static_cast<int>(index / columns), border);
        slot.bytes = slot.tile.samples.size() * sizeof(PaintTile::Sample) +
                     slot.tile.triangles.size() * sizeof(PaintTile::Triangle);
    });
    return slot.tile;
}

std::size_t PaintPlaces::bytes() const {
    std::size_t sum = m_boxes.size() * sizeof(TexelBox) + m_blocks.size() * sizeof(BoundingBall) +
                      m_firstOfTile.size() * sizeof(std::size_t) + m_tileTriangles.size() * sizeof(std::uint32_t);
    for (const Slot& slot : m_tiles) sum += slot.bytes;
    return sum;
}

}  // namespace whorl
