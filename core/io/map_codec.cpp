// SPDX-License-Identifier: Apache-2.0
#include "core/io/map_codec.h"

#include "core/base/parallel.h"
#include "core/io/groom_codec.h"
#include "core/io/json_text.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <optional>

namespace whorl {
namespace {

using nlohmann::json;

constexpr const char* formatNames[] = {"u8", "u16", "f32"};

std::size_t tileByteCount(int channels, TexelFormat format) {
    return std::size_t{Map::tileSize} * Map::tileSize * static_cast<std::size_t>(channels) * texelBytes(format);
}

/// The number whose texel has these bits.
float texelFromBits(std::uint32_t bits, TexelFormat format) {
    if (format == TexelFormat::U8) return static_cast<float>(bits & 255u) / 255.0f;
    if (format == TexelFormat::U16) return static_cast<float>(bits & 65535u) / 65535.0f;
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// Bits of the texel that fills the whole tile, or nothing.
std::optional<std::uint32_t> oneValue(const std::vector<std::uint8_t>& tile, TexelFormat format) {
    const std::size_t size = texelBytes(format);
    if (tile.size() < size || std::memcmp(tile.data(), tile.data() + size, tile.size() - size) != 0)
        return std::nullopt;
    std::uint32_t bits = 0;
    std::memcpy(&bits, tile.data(), size);
    return bits;
}

/// The most frequent value of one-valued tiles that a new map can be filled with; the smallest of equally frequent
/// ones.
std::uint32_t commonFill(const Map& map) {
    std::map<std::uint32_t, std::size_t> counts;
    for (int row = 0; row < map.tileRows(); ++row) {
        for (int column = 0; column < map.tileColumns(); ++column) {
            if (const auto bits = oneValue(map.tileBytes(column, row), map.format())) ++counts[*bits];
        }
    }
    std::uint32_t best = 0;
    std::size_t most = 0;
    for (const auto& [bits, count] : counts) {
        if (count <= most) continue;
        const Map filled(1, 1, map.channels(), map.format(), texelFromBits(bits, map.format()));
        if (oneValue(filled.tileBytes(0, 0), map.format()) != bits) continue;
        best = bits;
        most = count;
    }
    return best;
}

json encodeMap(const MapSet::Entry& entry, ContainerWriter& writer) {
    const Map& map = *entry.map;
    const std::uint32_t fill = commonFill(map);
    std::vector<std::uint8_t> places;
    std::vector<std::uint8_t> tiles;
    std::uint32_t stored = 0;
    for (int row = 0; row < map.tileRows(); ++row) {
        for (int column = 0; column < map.tileColumns(); ++column) {
            const std::vector<std::uint8_t>& tile = map.tileBytes(column, row);
            const bool filled = oneValue(tile, map.format()) == fill;
            const std::uint32_t place = filled ? 0 : ++stored;
            const auto* from = reinterpret_cast<const std::uint8_t*>(&place);
            places.insert(places.end(), from, from + sizeof place);
            if (!filled) tiles.insert(tiles.end(), tile.begin(), tile.end());
        }
    }
    return {{"name", entry.name},
            {"width", map.width()},
            {"height", map.height()},
            {"channels", map.channels()},
            {"format", formatNames[static_cast<std::size_t>(map.format())]},
            {"flip_v", map.flipV},
            {"srgb", map.srgb},
            {"fill", fill},
            {"places", blobToJson(writer.addOwned(std::move(places)))},
            {"tiles", blobToJson(writer.addOwned(std::move(tiles)))}};
}

bool isFinite(std::uint32_t bits) {
    return (bits & 0x7f800000u) != 0x7f800000u;
}

/// Sets texels that are not finite to zero and counts them.
std::size_t repairTile(std::uint8_t* tile, std::size_t bytes) {
    std::size_t bad = 0;
    for (std::size_t at = 0; at < bytes; at += 4) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, tile + at, 4);
        if (isFinite(bits)) continue;
        std::memset(tile + at, 0, 4);
        ++bad;
    }
    return bad;
}

}  // namespace

json encodeMaps(const MapSet& maps, ContainerWriter& writer) {
    json list = json::array();
    for (const MapSet::Entry& entry : maps.entries()) list.push_back(encodeMap(entry, writer));
    return list;
}

void MapDecoder::read(const json& list, Problems& problems, std::vector<Container::Request>& requests) {
    m_stored.resize(list.size());
    for (std::size_t i = 0; i < list.size() && m_fault.empty(); ++i) {
        ManifestReader reader(list[i], "a map", m_fault);
        Stored& stored = m_stored[i];
        stored.name = reader.text("name");
        reportUnknownKeys(
            list[i], {"name", "width", "height", "channels", "format", "flip_v", "srgb", "fill", "places", "tiles"},
            "maps/" + stored.name, problems);
        const auto width = static_cast<int>(reader.number("width", Map::maxSize));
        const auto height = static_cast<int>(reader.number("height", Map::maxSize));
        const auto channels = static_cast<int>(reader.number("channels", 3));
        const std::string formatName = reader.text("format");
        auto fill = static_cast<std::uint32_t>(reader.number("fill", UINT32_MAX));
        const bool flipV = reader.flag("flip_v");
        const bool srgb = reader.flag("srgb");
        const Blob places = reader.blob("places");
        const Blob tiles = reader.blob("tiles");
        if (!m_fault.empty()) return;
        const auto* known = std::find(std::begin(formatNames), std::end(formatNames), formatName);
        if (known == std::end(formatNames) || (channels != 1 && channels != 3) || (width == 0) != (height == 0)) {
            m_fault = "map " + stored.name + " has a size or format that is not known.";
            return;
        }
        const auto format = static_cast<TexelFormat>(known - formatNames);
        if (format == TexelFormat::F32 && !isFinite(fill)) {
            problems.push_back("Map " + stored.name + " was filled with what is not a finite number; it is zero now.");
            fill = 0;
        }
        const auto across = [](int size) {
            return (static_cast<std::uint64_t>(size) + Map::tileSize - 1) / Map::tileSize;
        };
        const std::uint64_t count = across(width) * across(height);
        const std::size_t tileSize = tileByteCount(channels, format);
        if (tiles.bytes % tileSize != 0 || tiles.bytes / tileSize > count || !m_container.claim(places, count * 4) ||
            !m_container.claim(tiles, tiles.bytes)) {
            m_fault = "the pieces of map " + stored.name + " do not fit its size.";
            return;
        }
        if (width > 0) stored.map = Map(width, height, channels, format, texelFromBits(fill, format));
        stored.map.flipV = flipV;
        stored.map.srgb = srgb;
        stored.places.resize(static_cast<std::size_t>(count));
        stored.tiles.resize(static_cast<std::size_t>(tiles.bytes));
        requests.push_back({places, reinterpret_cast<std::uint8_t*>(stored.places.data())});
        requests.push_back({tiles, stored.tiles.data()});
    }
}

Result<void> MapDecoder::finish(MapSet& maps, Problems& problems) {
    for (Stored& stored : m_stored) {
        Map& map = stored.map;
        const std::size_t tileSize = tileByteCount(map.channels(), map.format());
        std::uint32_t used = 0;
        for (const std::uint32_t place : stored.places) {
            if (place != 0 && place != ++used) return Error{"the tiles of map " + stored.name + " are out of order."};
        }
        if (used * std::uint64_t{tileSize} != stored.tiles.size())
            return Error{"map " + stored.name + " has another number of tiles than it uses."};
        std::atomic<std::size_t> bad{0};
        const auto columns = static_cast<std::size_t>(map.tileColumns());
        parallelFor(stored.places.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (stored.places[i] == 0) continue;
                std::uint8_t* from = stored.tiles.data() + (stored.places[i] - std::size_t{1}) * tileSize;
                if (map.format() == TexelFormat::F32) bad += repairTile(from, tileSize);
                map.editTileBytes(static_cast<int>(i % columns), static_cast<int>(i / columns))
                    .assign(from, from + tileSize);
            }
        });
        if (bad > 0)
            problems.push_back("Map " + stored.name + " had " + std::to_string(bad) +
                               " texels that are not finite numbers; they are zero now.");
        std::string name = stored.name;
        for (int i = 2; maps.find(name); ++i) name = stored.name + "-" + std::to_string(i);
        if (name != stored.name)
            problems.push_back("Two maps were named \"" + stored.name + "\"; the second is " + name + " now.");
        maps.set(name, std::move(map));
        stored.tiles = {};
    }
    return {};
}

}  // namespace whorl
