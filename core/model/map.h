// SPDX-License-Identifier: Apache-2.0
// A painted or loaded image over the UVs of the mesh.
#pragma once

#include "core/base/cow.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace whorl {

enum class TexelFormat : std::uint8_t { U8, U16, F32 };

constexpr std::size_t texelBytes(TexelFormat format) {
    return format == TexelFormat::U8 ? 1 : format == TexelFormat::U16 ? 2 : 4;
}

/// A map of 1 (data) or 3 (colour) channels in tiles of 64 x 64 that copies share until painted. Row 0 is the top
/// (v = 1). Integers mean 0 to 1. UVs repeat outside 0 to 1.
class Map {
public:
    static constexpr int tileSize = 64;
    static constexpr int maxSize = 16384;

    Map() = default;
    /// All texels `fill`. 1 <= width, height <= maxSize; channels 1 or 3.
    Map(int width, int height, int channels, TexelFormat format, float fill);

    int width() const { return m_width; }
    int height() const { return m_height; }
    int channels() const { return m_channels; }
    TexelFormat format() const { return m_format; }
    bool empty() const { return m_width == 0; }

    /// The image is upside down compared with the UVs: v = 0 is its first row.
    bool flipV = false;
    /// Integer texels hold sRGB-encoded colour; sampling decodes to linear.
    bool srgb = false;

    /// Stored number, 0 to 1 for integer formats; no sRGB decoding. Column x from the left, row y from the top.
    float texel(int x, int y, int channel = 0) const;
    /// Unshares the tile. Values are clamped to 0 to 1 for integer formats.
    void setTexel(int x, int y, int channel, float value);

    /// Bilinear, first channel (mean of three for colour maps).
    float sample(glm::vec2 uv) const;
    /// Nearest texel, first channel: for maps of numbers such as groups.
    float sampleNearest(glm::vec2 uv) const;
    /// Bilinear, linear colour; grey for data maps.
    glm::vec3 sampleColour(glm::vec2 uv) const;
    /// Texel coordinates (x right, y down, centres at halves, not wrapped) of a UV.
    glm::vec2 texelFromUv(glm::vec2 uv) const;

    int tileColumns() const { return (m_width + tileSize - 1) / tileSize; }
    int tileRows() const { return (m_height + tileSize - 1) / tileSize; }
    /// tileSize * tileSize * channels values in `format`, rows of the tile one after another (full tiles also at
    /// edges).
    const std::vector<std::uint8_t>& tileBytes(int column, int row) const { return *m_tiles[tileIndex(column, row)]; }
    std::vector<std::uint8_t>& editTileBytes(int column, int row) { return m_tiles[tileIndex(column, row)].edit(); }
    bool tileSameAs(int column, int row, const Map& other) const {
        return other.m_tiles.size() == m_tiles.size() &&
               m_tiles[tileIndex(column, row)].sameAs(other.m_tiles[tileIndex(column, row)]);
    }
    /// Same size, channels and format.
    bool sameShape(const Map& other) const;
    std::size_t bytesNotSharedWith(const Map& before) const;

private:
    std::size_t tileIndex(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(tileColumns()) +
               static_cast<std::size_t>(column);
    }

    int m_width = 0;
    int m_height = 0;
    int m_channels = 1;
    TexelFormat m_format = TexelFormat::F32;
    std::vector<Cow<std::vector<std::uint8_t>>> m_tiles;
};

/// The groom's maps by unique name, in the order that the artist sees.
class MapSet {
public:
    struct Entry {
        std::string name;
        Cow<Map> map;
    };

    const std::vector<Entry>& entries() const { return m_entries; }
    /// Null when there is none of that name.
    const Map* find(std::string_view name) const;
    /// For writing; null when there is none.
    Map* edit(std::string_view name);
    /// Adds, or replaces the map of that name.
    void set(std::string_view name, Map map);
    bool erase(std::string_view name);
    bool sameAs(const MapSet& other) const;
    std::size_t bytesNotSharedWith(const MapSet& before) const;

private:
    std::vector<Entry> m_entries;
};

/// sRGB to linear (IEC 61966-2-1), 0 to 1.
float linearFromSrgb(float encoded);
float srgbFromLinear(float linear);

}  // namespace whorl
