// SPDX-License-Identifier: Apache-2.0
#include "core/model/map_changes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

// Where rows of `bytes` bytes a texel differ in one tile; empty when they are equal.
TexelRect differenceOf(const std::uint8_t* a, const std::uint8_t* b, std::size_t bytes) {
    constexpr int size = Map::tileSize;
    const std::size_t rowBytes = bytes * size;
    TexelRect rect{size, size, 0, 0};
    for (int y = 0; y < size; ++y, a += rowBytes, b += rowBytes) {
        if (std::memcmp(a, b, rowBytes) == 0) continue;
        std::size_t first = 0, last = rowBytes - 1;
        while (a[first] == b[first]) ++first;
        while (a[last] == b[last]) --last;
        rect.x0 = std::min(rect.x0, static_cast<int>(first / bytes));
        rect.x1 = std::max(rect.x1, static_cast<int>(last / bytes) + 1);
        rect.y0 = std::min(rect.y0, y);
        rect.y1 = y + 1;
    }
    return rect;
}

// First and last cell, not wrapped, that samples around texels [first, last) of `size` can come from. Bilinear
// sampling reaches one texel and a half; one more for rounding.
std::pair<int, int> cellsAround(int first, int last, int size) {
    const double scale = static_cast<double>(TouchedUvs::side) / size;
    return {static_cast<int>(std::floor((first - 2.5) * scale)), static_cast<int>(std::floor((last + 2.5) * scale))};
}

int wrapped(int cell) {
    const int rest = cell % TouchedUvs::side;
    return rest < 0 ? rest + TouchedUvs::side : rest;
}

}  // namespace

bool differInTexels(const Map& before, const Map& after) {
    return !before.empty() && before.sameShape(after) && before.flipV == after.flipV && before.srgb == after.srgb;
}

std::vector<TexelRect> changedTexels(const Map& before, const Map& after) {
    assert(differInTexels(before, after));
    std::vector<TexelRect> changed;
    const std::size_t bytes = texelBytes(after.format()) * static_cast<std::size_t>(after.channels());
    for (int row = 0; row < after.tileRows(); ++row) {
        for (int column = 0; column < after.tileColumns(); ++column) {
            if (after.tileSameAs(column, row, before)) continue;
            TexelRect rect =
                differenceOf(before.tileBytes(column, row).data(), after.tileBytes(column, row).data(), bytes);
            const int x = column * Map::tileSize, y = row * Map::tileSize;
            rect.x0 += x;
            rect.y0 += y;
            // Tiles at the edges are full ones; what lies beyond the map is never seen.
            rect.x1 = std::min(rect.x1 + x, after.width());
            rect.y1 = std::min(rect.y1 + y, after.height());
            if (rect.x0 < rect.x1 && rect.y0 < rect.y1) changed.push_back(rect);
        }
    }
    return changed;
}

int TouchedUvs::cellOf(float coordinate) {
    // As Map::sample takes it.
    const float tamed = std::abs(coordinate) < 1e6f ? coordinate - std::floor(coordinate) : 0.0f;
    return std::min(static_cast<int>(tamed * static_cast<float>(side)), side - 1);
}

void TouchedUvs::add(const Map& map, const TexelRect& texels) {
    if (m_cells.empty()) m_cells.assign(static_cast<std::size_t>(side) * side, 0);
    const auto [firstColumn, lastColumn] = cellsAround(texels.x0, texels.x1, map.width());
    auto [firstRow, lastRow] = cellsAround(texels.y0, texels.y1, map.height());
    if (!map.flipV) {
        const int top = firstRow;
        // 1 - v, give or take the border of a cell.
        firstRow = side - 2 - lastRow;
        lastRow = side - top;
    }
    for (int row = firstRow; row <= std::min(lastRow, firstRow + side - 1); ++row)
        for (int column = firstColumn; column <= std::min(lastColumn, firstColumn + side - 1); ++column)
            m_cells[static_cast<std::size_t>(wrapped(row) * side + wrapped(column))] = 1;
}

bool TouchedUvs::at(glm::vec2 uv) const {
    if (m_cells.empty()) return false;
    // So far out neighbouring numbers are texels apart.
    if (!(std::abs(uv.x) < farOut && std::abs(uv.y) < farOut)) return true;
    return cell(cellOf(uv.x), cellOf(uv.y));
}

bool TouchedMaps::add(std::string_view name) {
    if (name.empty()) return true;
    const Map *before = m_before.find(name), *after = m_after.find(name);
    if (before == after) return true;
    if (!before || !after || !differInTexels(*before, *after)) return false;
    const bool known = std::any_of(m_maps.begin(), m_maps.end(), [&](const Pair& pair) { return pair.after == after; });
    if (!known) m_maps.push_back({before, after});
    return true;
}

TouchedUvs TouchedMaps::where() const {
    TouchedUvs touched;
    for (const Pair& pair : m_maps)
        for (const TexelRect& rect : changedTexels(*pair.before, *pair.after)) touched.add(*pair.after, rect);
    return touched;
}

}  // namespace whorl
