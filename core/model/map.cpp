// SPDX-License-Identifier: Apache-2.0
#include "core/model/map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

int wrapped(int value, int size) {
    const int rest = value % size;
    return rest < 0 ? rest + size : rest;
}

/// Finite and small enough for exact integer texels; UVs of 1e9 or not-a-number come from real files.
float tamed(float coordinate) {
    if (!(std::abs(coordinate) < 1e6f)) return 0.0f;
    return coordinate - std::floor(coordinate);
}

void store(std::uint8_t* bytes, TexelFormat format, float value) {
    switch (format) {
        case TexelFormat::U8:
            bytes[0] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
            break;
        case TexelFormat::U16: {
            const auto whole = static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
            std::memcpy(bytes, &whole, 2);
            break;
        }
        case TexelFormat::F32:
            std::memcpy(bytes, &value, 4);
            break;
    }
}

float load(const std::uint8_t* bytes, TexelFormat format) {
    switch (format) {
        case TexelFormat::U8:
            return static_cast<float>(bytes[0]) * (1.0f / 255.0f);
        case TexelFormat::U16: {
            std::uint16_t whole = 0;
            std::memcpy(&whole, bytes, 2);
            return static_cast<float>(whole) * (1.0f / 65535.0f);
        }
        case TexelFormat::F32:
            break;
    }
    float value = 0.0f;
    std::memcpy(&value, bytes, 4);
    return value;
}

}  // namespace

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

Map::Map(int width, int height, int channels, TexelFormat format, float fill)
    : m_width(width), m_height(height), m_channels(channels), m_format(format) {
    assert(width >= 1 && width <= maxSize && height >= 1 && height <= maxSize && (channels == 1 || channels == 3));
    const std::size_t bytes = texelBytes(format);
    std::vector<std::uint8_t> tile(static_cast<std::size_t>(tileSize) * tileSize * static_cast<std::size_t>(channels) *
                                   bytes);
    for (std::size_t i = 0; i < tile.size(); i += bytes) store(tile.data() + i, format, fill);
    // All tiles start as one shared piece of memory.
    const Cow<std::vector<std::uint8_t>> shared(std::move(tile));
    m_tiles.assign(static_cast<std::size_t>(tileColumns()) * static_cast<std::size_t>(tileRows()), shared);
}

float Map::texel(int x, int y, int channel) const {
    const auto& tile = tileBytes(x / tileSize, y / tileSize);
    const int place = ((y % tileSize) * tileSize + x % tileSize) * m_channels + channel;
    return load(tile.data() + static_cast<std::size_t>(place) * texelBytes(m_format), m_format);
}

void Map::setTexel(int x, int y, int channel, float value) {
    auto& tile = editTileBytes(x / tileSize, y / tileSize);
    const int place = ((y % tileSize) * tileSize + x % tileSize) * m_channels + channel;
    store(tile.data() + static_cast<std::size_t>(place) * texelBytes(m_format), m_format, value);
}

glm::vec2 Map::texelFromUv(glm::vec2 uv) const {
    const float v = flipV ? uv.y : 1.0f - uv.y;
    return {uv.x * static_cast<float>(m_width), v * static_cast<float>(m_height)};
}

namespace {

struct Corner {
    int x[2];
    int y[2];
    float fx;
    float fy;
};

Corner cornersAt(const Map& map, glm::vec2 uv) {
    const float v = map.flipV ? tamed(uv.y) : tamed(1.0f - uv.y);
    const float x = tamed(uv.x) * static_cast<float>(map.width()) - 0.5f;
    const float y = v * static_cast<float>(map.height()) - 0.5f;
    const auto column = static_cast<int>(std::floor(x));
    const auto row = static_cast<int>(std::floor(y));
    return {{wrapped(column, map.width()), wrapped(column + 1, map.width())},
            {wrapped(row, map.height()), wrapped(row + 1, map.height())},
            x - static_cast<float>(column),
            y - static_cast<float>(row)};
}

template <class Texel>
auto bilinear(const Corner& c, Texel&& texel) {
    const auto top = texel(c.x[0], c.y[0]) * (1.0f - c.fx) + texel(c.x[1], c.y[0]) * c.fx;
    const auto bottom = texel(c.x[0], c.y[1]) * (1.0f - c.fx) + texel(c.x[1], c.y[1]) * c.fx;
    return top * (1.0f - c.fy) + bottom * c.fy;
}

}  // namespace

float Map::sample(glm::vec2 uv) const {
    if (empty()) return 1.0f;
    const Corner corner = cornersAt(*this, uv);
    if (m_channels == 1) return bilinear(corner, [&](int x, int y) { return texel(x, y); });
    return bilinear(corner, [&](int x, int y) { return (texel(x, y, 0) + texel(x, y, 1) + texel(x, y, 2)) / 3.0f; });
}

float Map::sampleNearest(glm::vec2 uv) const {
    if (empty()) return 0.0f;
    const float v = flipV ? tamed(uv.y) : tamed(1.0f - uv.y);
    const int x = std::min(static_cast<int>(tamed(uv.x) * static_cast<float>(m_width)), m_width - 1);
    const int y = std::min(static_cast<int>(v * static_cast<float>(m_height)), m_height - 1);
    return texel(x, y);
}

glm::vec3 Map::sampleColour(glm::vec2 uv) const {
    if (empty()) return glm::vec3(1.0f);
    const Corner corner = cornersAt(*this, uv);
    const bool decode = srgb && m_format != TexelFormat::F32;
    static const std::array<float, 256> decoded = [] {
        std::array<float, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) table[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
        return table;
    }();
    const auto linear = [&](int x, int y, int channel) {
        const float stored = texel(x, y, channel);
        if (!decode) return stored;
        if (m_format == TexelFormat::U8) return decoded[static_cast<std::size_t>(stored * 255.0f + 0.5f)];
        return linearFromSrgb(stored);
    };
    return bilinear(corner, [&](int x, int y) {
        if (m_channels == 1) return glm::vec3(linear(x, y, 0));
        return glm::vec3(linear(x, y, 0), linear(x, y, 1), linear(x, y, 2));
    });
}

bool Map::sameShape(const Map& other) const {
    return m_width == other.m_width && m_height == other.m_height && m_channels == other.m_channels &&
           m_format == other.m_format;
}

std::size_t Map::bytesNotSharedWith(const Map& before) const {
    std::size_t bytes = m_tiles.size() * sizeof(m_tiles[0]);
    const bool comparable = before.m_tiles.size() == m_tiles.size();
    for (std::size_t i = 0; i < m_tiles.size(); ++i) {
        if (!comparable || !m_tiles[i].sameAs(before.m_tiles[i])) bytes += m_tiles[i]->size();
    }
    return bytes;
}

const Map* MapSet::find(std::string_view name) const {
    for (const Entry& entry : m_entries) {
        if (entry.name == name) return &*entry.map;
    }
    return nullptr;
}

Map* MapSet::edit(std::string_view name) {
    for (Entry& entry : m_entries) {
        if (entry.name == name) return &entry.map.edit();
    }
    return nullptr;
}

void MapSet::set(std::string_view name, Map map) {
    for (Entry& entry : m_entries) {
        if (entry.name == name) {
            entry.map = Cow<Map>(std::move(map));
            return;
        }
    }
    m_entries.push_back({std::string(name), Cow<Map>(std::move(map))});
}

bool MapSet::erase(std::string_view name) {
    return std::erase_if(m_entries, [&](const Entry& entry) { return entry.name == name; }) > 0;
}

bool MapSet::sameAs(const MapSet& other) const {
    return std::equal(m_entries.begin(), m_entries.end(), other.m_entries.begin(), other.m_entries.end(),
                      [](const Entry& a, const Entry& b) { return a.name == b.name && a.map.sameAs(b.map); });
}

std::size_t MapSet::bytesNotSharedWith(const MapSet& before) const {
    std::size_t bytes = 0;
    for (const Entry& entry : m_entries) {
        const Map* old = before.find(entry.name);
        if (old == &*entry.map) continue;
        bytes += sizeof(Entry) + entry.map->bytesNotSharedWith(old ? *old : Map());
    }
    return bytes;
}

}  // namespace whorl
