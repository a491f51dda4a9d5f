// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/paint_canvas.h"

#include "core/base/parallel.h"
#include "core/brushes/brush.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

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
    : m_places(PaintPlaces::of(surface, base)), m_base(base), m_masks(m_places->tileCount()) {}

bool PaintCanvas::paint(MapSet& maps, std::string_view name, const PaintDab& dab, float value) {
    const Map* map = maps.find(name);
    if (map == nullptr || !(dab.strength > 0.0f) || !(dab.radius > 0.0f) || !map->sameShape(m_base)) return false;
    m_places->findTiles(dab.centre, dab.radius, m_wanted, m_touched);
    parallelFor(m_touched.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) raise(m_masks[m_touched[i]], m_places->tile(m_touched[i]), dab);
    });
    bool changed = false;
    for (const std::size_t index : m_touched) changed |= writeTile(maps, name, index, value);
    return changed;
}

void PaintCanvas::raise(Mask& mask, const PaintTile& tile, const PaintDab& dab) {
    mask.risen.clear();
    mask.strength.resize(static_cast<std::size_t>(tileSize) * tileSize, 0.0f);
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
            const float falloff = brushFalloff(glm::length(sample.position - dab.centre) / dab.radius);
            const float weight = !dab.hard ? strength * falloff : falloff > 0.0f ? 1.0f : 0.0f;
            if (weight > mask.strength[sample.texel]) {
                mask.strength[sample.texel] = weight;
                mask.risen.push_back(sample.texel);
            }
        }
    }
}

bool PaintCanvas::writeTile(MapSet& maps, std::string_view name, std::size_t index, float value) {
    const Mask& mask = m_masks[index];
    if (mask.risen.empty()) return false;
    const auto columns = static_cast<std::size_t>(m_base.tileColumns());
    const int column = static_cast<int>(index % columns), row = static_cast<int>(index / columns);
    const TexelFormat format = m_base.format();
    const std::size_t size = texelBytes(format);
    std::uint8_t* bytes = nullptr;
    for (const std::uint16_t texel : mask.risen) {
        const float base = m_base.texel(column * tileSize + texel % tileSize, row * tileSize + texel / tileSize);
        const float painted = base + (value - base) * mask.strength[texel];
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
    std::size_t sum = m_masks.size() * sizeof(Mask);
    for (const Mask& mask : m_masks)
        sum += mask.strength.size() * sizeof(float) + mask.risen.size() * sizeof(std::uint16_t);
    return sum;
}

}  // namespace whorl
