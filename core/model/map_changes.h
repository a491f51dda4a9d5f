// SPDX-License-Identifier: Apache-2.0
// Where two states of maps differ, so that a dab of paint makes nothing again but what it touches.
#pragma once

#include "core/model/groom.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace whorl {

/// Texels [x0, x1) x [y0, y1).
struct TexelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// True when only texels can differ: same size, channels, format, orientation and encoding.
bool differInTexels(const Map& before, const Map& after);

/// Where texels differ: at most one rectangle for every tile that the maps do not share. Only for maps that
/// `differInTexels`.
std::vector<TexelRect> changedTexels(const Map& before, const Map& after);

/// Places on the UV square where sampling maps may give other values than before: cells of a grid over 0 to 1, with all
/// that repeats. It may say yes where nothing differs, never no where something does.
class TouchedUvs {
public:
    static constexpr int side = 128;
    static constexpr float farOut = 1000.0f;  ///< UVs beyond this count as touched

    bool empty() const { return m_cells.empty(); }
    /// Bilinear and nearest sampling of `map` around those texels.
    void add(const Map& map, const TexelRect& texels);
    bool at(glm::vec2 uv) const;
    bool cell(int column, int row) const {
        return !m_cells.empty() && m_cells[static_cast<std::size_t>(row * side + column)] != 0;
    }
    /// Of that coordinate (which repeats) as maps take it.
    static int cellOf(float coordinate);

private:
    std::vector<std::uint8_t> m_cells;  // rows of v, empty or side * side
};

/// Maps of a groom that differ from those of an earlier one in texels only, collected by name while the two are
/// compared (see core/hair/changes.h). Keeps both states of all maps while it lives.
class TouchedMaps {
public:
    TouchedMaps(const Groom& before, const Groom& after) : m_before(before.maps), m_after(after.maps) {}

    /// True when the map of that name is the same in both or differs in texels only; it is remembered then.
    bool add(std::string_view name);
    bool empty() const { return m_maps.empty(); }
    /// Where any of them differs.
    TouchedUvs where() const;

    struct Pair {
        const Map* before;
        const Map* after;
    };
    const std::vector<Pair>& maps() const { return m_maps; }

private:
    MapSet m_before;
    MapSet m_after;
    std::vector<Pair> m_maps;
};

}  // namespace whorl
