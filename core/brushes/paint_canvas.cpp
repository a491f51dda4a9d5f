// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/paint_canvas.h"

#include "core/base/parallel.h"
#include "core/brushes/brush.h"
#include "core/brushes/paint_tile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

constexpr std::size_t blockSize = 32;
constexpr int tileSize = Map::tileSize;

float smoothStep(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Stores a number as the map's format does; true when the bytes differ from before.
bool store(std::uint8_t* place, TexelFormat format, float value) {
    std::uint8_t bytes[4];
    const std::size_t size = texelBytes(format);
    if (format == TexelFormat::F32) {
        std::memcpy(bytes, &value, 4);
    } else if (format == TexelFormat::U16) {
        const auto number = static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
        std::memcpy(bytes, &number, 2);
    } else {
        bytes[0] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    }
    if (std::memcmp(place, bytes, size) == 0) return false;
    std::memcpy(place, bytes, size);
    return true;
}

}  // namespace

PaintCanvas::PaintCanvas(const Surface& surface, const Map& base)
    : m_mesh(surface.shared), m_base(base), m_columns(base.tileColumns()), m_rows(base.tileRows()) {
    const SurfaceMesh& mesh = *m_mesh;
    const std::size_t count = mesh.triangles.size();
    m_boxes.resize(count);
    m_blocks.resize((count + blockSize - 1) / blockSize);
    m_tiles.resize(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows));
    m_wanted.resize(m_tiles.size());
    parallelFor(m_blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const std::size_t first = b * blockSize, last = std::min(count, first + blockSize);
            glm::vec3 low(1e30f), high(-1e30f);
            for (std::size_t t = first; t < last; ++t) {
                m_boxes[t] = texelBox(mesh, m_base, static_cast<std::uint32_t>(t));
                for (int k = 0; k < 3; ++k) {
                    low = glm::min(low, mesh.positions[mesh.triangles[t][k]]);
                    high = glm::max(high, mesh.positions[mesh.triangles[t][k]]);
                }
            }
            m_blocks[b] = {(low + high) * 0.5f, glm::length(high - low) * 0.5f};
        }
    });
}

bool PaintCanvas::paint(MapSet& maps, std::string_view name, const PaintDab& dab, float value) {
    const Map* map = maps.find(name);
    if (map == nullptr || !(dab.strength > 0.0f) || !(dab.radius > 0.0f) || !map->sameShape(m_base)) return false;
    findTiles(dab);
    parallelFor(m_touched.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::unique_ptr<PaintTile>& tile = m_tiles[m_touched[i]];
            if (!tile) {
                const int column = static_cast<int>(m_touched[i] % static_cast<std::size_t>(m_columns));
                const int row = static_cast<int>(m_touched[i] / static_cast<std::size_t>(m_columns));
                tile = std::make_unique<PaintTile>(buildTile(*m_mesh, m_base, m_boxes, column, row, border));
            }
            raiseMask(*tile, dab);
        }
    });
    bool changed = false;
    for (const std::size_t index : m_touched) changed |= writeTile(maps, name, index, value);
    return changed;
}

void PaintCanvas::findTiles(const PaintDab& dab) {
    const SurfaceMesh& mesh = *m_mesh;
    m_touched.clear();
    const auto within = [&](const glm::vec3& centre, float radius) {
        const float limit = (dab.radius + radius) * 1.0001f;
        return glm::dot(centre - dab.centre, centre - dab.centre) <= limit * limit;
    };
    const auto wrapped = [](int tile, int tiles) { return ((tile % tiles) + tiles) % tiles; };
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        if (!within(m_blocks[b].centre, m_blocks[b].radius)) continue;
        const std::size_t last = std::min(mesh.triangles.size(), (b + 1) * blockSize);
        for (std::size_t t = b * blockSize; t < last; ++t) {
            const TexelBox& box = m_boxes[t];
            if (box.x1 < box.x0) continue;
            const BoundingBall ball = ballOf(mesh, static_cast<std::uint32_t>(t));
            if (!within(ball.centre, ball.radius)) continue;
            // Columns wrap at the width of the map, which need not be a multiple of the tile size.
            for (int y = box.y0 - border; y <= box.y1 + border;) {
                const int row = wrapped(y, m_base.height()) / tileSize;
                for (int x = box.x0 - border; x <= box.x1 + border;) {
                    const int column = wrapped(x, m_base.width()) / tileSize;
                    const std::size_t index = static_cast<std::size_t>(row) * static_cast<std::size_t>(m_columns) +
                                              static_cast<std::size_t>(column);
                    if (m_wanted[index] == 0) {
                        m_wanted[index] = 1;
                        m_touched.push_back(index);
                    }
                    x += std::min(tileSize * (column + 1), m_base.width()) - wrapped(x, m_base.width());
                }
                y += std::min(tileSize * (row + 1), m_base.height()) - wrapped(y, m_base.height());
            }
        }
    }
    std::sort(m_touched.begin(), m_touched.end());
    for (const std::size_t index : m_touched) m_wanted[index] = 0;
}

void PaintCanvas::raiseMask(PaintTile& tile, const PaintDab& dab) const {
    tile.risen.clear();
    for (const PaintTile::Triangle& triangle : tile.triangles) {
        const glm::vec3 away = triangle.ball.centre - dab.centre;
        const float limit = (dab.radius + triangle.ball.radius) * 1.0001f;
        if (glm::dot(away, away) > limit * limit) continue;
        float strength = dab.strength;
        if (dab.frontOnly) {
            const glm::vec3 toEye = dab.eye - triangle.ball.centre;
            const float distance = glm::length(toEye);
            strength *= distance > 0.0f ? smoothStep(0.0f, 0.2f, glm::dot(triangle.normal, toEye) / distance) : 1.0f;
            if (!(strength > 0.0f)) continue;
        }
        for (std::uint32_t i = triangle.first; i < triangle.last; ++i) {
            const PaintTile::Sample& sample = tile.samples[i];
            const float weight = strength * brushFalloff(glm::length(sample.position - dab.centre) / dab.radius);
            if (weight > tile.mask[sample.texel]) {
                tile.mask[sample.texel] = weight;
                tile.risen.push_back(sample.texel);
            }
        }
    }
}

bool PaintCanvas::writeTile(MapSet& maps, std::string_view name, std::size_t index, float value) {
    const PaintTile& tile = *m_tiles[index];
    if (tile.risen.empty()) return false;
    const int column = static_cast<int>(index % static_cast<std::size_t>(m_columns));
    const int row = static_cast<int>(index / static_cast<std::size_t>(m_columns));
    const TexelFormat format = m_base.format();
    const std::size_t size = texelBytes(format);
    std::uint8_t* bytes = nullptr;
    for (const std::uint16_t texel : tile.risen) {
        const float base = m_base.texel(column * tileSize + texel % tileSize, row * tileSize + texel / tileSize);
        const float painted = base + (value - base) * tile.mask[texel];
        if (bytes == nullptr) {
            // Only a texel whose stored number changes is worth a tile of memory.
            std::uint8_t now[4];
            std::memcpy(now, maps.find(name)->tileBytes(column, row).data() + texel * size, size);
            if (!store(now, format, painted)) continue;
            bytes = maps.edit(name)->editTileBytes(column, row).data();
        }
        store(bytes + texel * size, format, painted);
    }
    return bytes != nullptr;
}

std::size_t PaintCanvas::bytes() const {
    std::size_t sum = m_boxes.size() * sizeof(TexelBox) + m_blocks.size() * sizeof(BoundingBall);
    for (const auto& tile : m_tiles) {
        if (tile) sum += tile->samples.size() * sizeof(PaintTile::Sample) + tile->mask.size() * sizeof(float);
    }
    return sum;
}

}  // namespace whorl
