// SPDX-License-Identifier: Apache-2.0
// Smaller versions of hair texture, kept by the processor so that a change makes and sends only what it touches.
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// Averages take in only texels that lie in charts, and the texels around a chart take the mean of those beside them:
// at no distance does a seam let through what lies between the charts.

namespace whorl {

/// Which texels of a square image any triangle touches in its UVs, for the image and all its halves down to one texel.
class ChartMask {
public:
    ChartMask() = default;
    /// Three corners a triangle; row 0 is v = 1. What lies outside 0 to 1 counts as on the border.
    ChartMask(int size, const std::vector<glm::vec2>& cornerUvs);

    int levels() const { return static_cast<int>(m_levels.size()); }
    int side(int level) const { return m_sides[static_cast<std::size_t>(level)]; }
    bool at(int level, int x, int y) const {
        const auto i = static_cast<std::size_t>(level);
        return m_levels[i][static_cast<std::size_t>(y) * static_cast<std::size_t>(m_sides[i]) +
                           static_cast<std::size_t>(x)] != 0;
    }

private:
    std::vector<int> m_sides;
    std::vector<std::vector<std::uint8_t>> m_levels;
};

/// One square image of four bytes a texel. Level 0 is read from its owner, the others are kept.
class MipImage {
public:
    static constexpr int tileSize = 64;
    using Texel = std::array<std::uint8_t, 4>;
    /// How colours are averaged: as numbers, or as the light that they stand for (the fourth byte always as a number).
    enum class Encoding { Linear, Srgb };
    /// Writes texels [first, last) of a row of level 0. Called by many threads.
    using Read = std::function<void(int row, int first, int last, Texel* out)>;
    /// A part of a level for the graphics card; rows are tileSize texels apart.
    struct Piece {
        int level = 0;
        glm::ivec2 from{0};
        glm::ivec2 size{0};
        const Texel* texels = nullptr;
    };
    using Send = std::function<void(const Piece&)>;

    explicit MipImage(Encoding encoding = Encoding::Linear) : m_encoding(encoding) {}

    /// Tiles of level 0 in a row and in a column.
    static int tiles(int side) { return (side + tileSize - 1) / tileSize; }
    /// Makes anew what depends on the tiles of level 0 that `changed` marks (row by row), and sends it. The first time,
    /// and for another mask, all must be marked.
    void update(const ChartMask& mask, const std::vector<std::uint8_t>& changed, const Read& read, const Send& send);

private:
    void average(const ChartMask& mask, int level, glm::ivec2 tile, const Read& read);
    void send(const ChartMask& mask, int level, const std::vector<std::size_t>& tiles, const Read& read,
              const Send& send);

    Encoding m_encoding;
    std::vector<std::vector<Texel>> m_levels;  // of 1 and above; the first is empty
    std::vector<Texel> m_staging;
};

}  // namespace whorl
