// SPDX-License-Identifier: Apache-2.0
#include "render/passes/map_texture.h"

#include <algorithm>
#include <cstring>

namespace whorl {
namespace {

gl::Format formatOf(const Map& map) {
    const bool colour = map.channels() == 3;
    switch (map.format()) {
        case TexelFormat::U8:
            return !colour ? gl::Format::R8 : map.srgb ? gl::Format::Rgb8Srgb : gl::Format::Rgb8;
        case TexelFormat::U16:
            return colour ? gl::Format::Rgb16 : gl::Format::R16;
        case TexelFormat::F32:
            return colour ? gl::Format::Rgb32F : gl::Format::R32F;
    }
    return gl::Format::R8;
}

}  // namespace

void MapTexture::update(const Map& map, int maxSize, Uploads& uploads) {
    const bool fresh = m_map.empty() || !m_map.sameShape(map) || m_map.srgb != map.srgb;
    const bool mipmaps = map.channels() == 3;
    if (fresh) {
        const int longest = std::max(map.width(), map.height());
        m_step = 1;
        while (longest / m_step > maxSize) m_step *= 2;
        const glm::ivec2 size((map.width() + m_step - 1) / m_step, (map.height() + m_step - 1) / m_step);
        m_texture = gl::Texture::make2D("map", formatOf(map), size, gl::Wrap::Repeat, mipmaps);
    }
    bool changed = false;
    for (int row = 0; row < map.tileRows(); ++row) {
        for (int column = 0; column < map.tileColumns(); ++column) {
            if (!fresh && map.tileSameAs(column, row, m_map)) continue;
            uploadTile(map, column, row, uploads);
            changed = true;
        }
    }
    if (changed && mipmaps) m_texture.makeMipmaps();
    m_map = map;
}

void MapTexture::uploadTile(const Map& map, int column, int row, Uploads& uploads) {
    constexpr int side = Map::tileSize;
    const auto& bytes = map.tileBytes(column, row);
    const int width = std::min(side, map.width() - column * side);
    const int height = std::min(side, map.height() - row * side);
    const std::size_t texel = texelBytes(map.format()) * static_cast<std::size_t>(map.channels());
    ++uploads.mapTiles;
    uploads.bytes += bytes.size();
    if (m_step == 1) {
        m_texture.upload(glm::ivec2(column, row) * side, glm::ivec2(width, height), bytes.data(), side);
        return;
    }
    // Steps divide the tile, so that every tile thins on its own.
    const int step = std::min(m_step, side);
    std::vector<std::uint8_t> thin;
    for (int y = 0; y < height; y += step) {
        for (int x = 0; x < width; x += step) {
            const std::size_t at = (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)) * texel;
            thin.insert(thin.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at + texel));
        }
    }
    m_texture.upload(glm::ivec2(column, row) * (side / step),
                     glm::ivec2((width + step - 1) / step, (height + step - 1) / step), thin.data());
}

}  // namespace whorl
