// SPDX-License-Identifier: Apache-2.0
// Which texels of hair texture lie in charts, in the texture and all its smaller versions.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Texels of a square image that any triangle touches in its UVs, for the image and all its halves down to one texel.
/// Immutable; any thread may ask.
class ChartMask {
public:
    static constexpr int tileSize = 64;
    // A pixel at the edge of a chart may lie most of a pixel outside it, and filtering reaches half a texel further.
    static constexpr int margin = 2;

    ChartMask() = default;
    /// Three corners a triangle; row 0 is v = 1. What lies outside 0 to 1 counts as on the border.
    ChartMask(int size, const std::vector<glm::vec2>& cornerUvs);

    /// Texels of the level before that a texel of a level is the mean of: [first, last) on one axis. All of them belong
    /// to one texel each.
    static glm::ivec2 children(int at, int level, int before) {
        return {static_cast<int>(static_cast<std::int64_t>(at) * before / level),
                static_cast<int>((static_cast<std::int64_t>(at) + 1) * before / level)};
    }
    /// Tiles in a row and in a column of a level so wide.
    static int tiles(int side) { return (side + tileSize - 1) / tileSize; }

    int levels() const { return static_cast<int>(m_levels.size()); }
    int side(int level) const { return m_levels[static_cast<std::size_t>(level)].side; }
    /// 1 where a triangle lies, else 0.
    const std::uint8_t* row(int level, int y) const {
        const Level& l = m_levels[static_cast<std::size_t>(level)];
        return l.texels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(l.side);
    }
    bool at(int level, int x, int y) const { return row(level, y)[x] != 0; }
    /// Level 1 and above: all texels that those of a tile (row by row) are means of lie in charts.
    bool full(int level, std::size_t tile) const { return m_levels[static_cast<std::size_t>(level)].full[tile] != 0; }
    /// Level 1 and above: texels of a tile outside charts, at most `margin` from one; row * tileSize + column.
    std::span<const std::uint16_t> around(int level, std::size_t tile) const {
        const Level& l = m_levels[static_cast<std::size_t>(level)];
        return std::span(l.around).subspan(l.firstAround[tile], l.firstAround[tile + 1] - l.firstAround[tile]);
    }

private:
    struct Level {
        int side = 0;
        std::vector<std::uint8_t> texels;
        std::vector<std::uint8_t> full;
        std::vector<std::uint16_t> around;
        std::vector<std::uint32_t> firstAround;
    };
    void halve(Level& level, const Level& before) const;
    void findAround(Level& level) const;

    std::vector<Level> m_levels;
};

}  // namespace whorl
