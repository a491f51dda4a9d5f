// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/bordered_texels.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cstring>

namespace whorl {
namespace {

// Texels [x0, x1) of row y, as Map::texel gives them.
void readRow(const Map& map, int y, int x0, int x1, float* out) {
    if (map.channels() != 1) {
        for (int x = x0; x < x1; ++x) *out++ = (map.texel(x, y, 0) + map.texel(x, y, 1) + map.texel(x, y, 2)) / 3.0f;
        return;
    }
    constexpr int size = Map::tileSize;
    const std::size_t bytes = texelBytes(map.format());
    while (x0 < x1) {
        const int end = std::min(x1, (x0 / size + 1) * size);
        const auto place = static_cast<std::size_t>((y % size) * size + x0 % size);
        const std::uint8_t* from = map.tileBytes(x0 / size, y / size).data() + place * bytes;
        const auto count = static_cast<std::size_t>(end - x0);
        if (map.format() == TexelFormat::U8) {
            for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(from[i]) * (1.0f / 255.0f);
        } else if (map.format() == TexelFormat::U16) {
            for (std::size_t i = 0; i < count; ++i) {
                std::uint16_t whole = 0;
                std::memcpy(&whole, from + 2 * i, 2);
                out[i] = static_cast<float>(whole) * (1.0f / 65535.0f);
            }
        } else {
            std::memcpy(out, from, count * sizeof(float));
        }
        out += count;
        x0 = end;
    }
}

}  // namespace

bool BorderedTexels::fits(const Map& map) {
    return static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()) <= mostTexels;
}

void BorderedTexels::read(const Map& map) {
    m_values.resize((static_cast<std::size_t>(map.width()) + 2) * (static_cast<std::size_t>(map.height()) + 2));
    parallelFor(static_cast<std::size_t>(map.height()), Map::tileSize, [&](std::size_t begin, std::size_t end) {
        read(map, {0, static_cast<int>(begin), map.width(), static_cast<int>(end)});
    });
}

void BorderedTexels::read(const Map& map, const TexelRect& part) {
    const int width = map.width(), height = map.height();
    const std::size_t stride = static_cast<std::size_t>(width) + 2;
    for (int y = part.y0; y < part.y1; ++y) {
        float* row = &m_values[static_cast<std::size_t>(y + 1) * stride];
        readRow(map, y, part.x0, part.x1, row + part.x0 + 1);
        row[0] = row[width];
        row[width + 1] = row[1];
        // The first row is also the one after the last, and the other way round.
        if (y == 0) std::copy_n(row, stride, &m_values[static_cast<std::size_t>(height + 1) * stride]);
        if (y == height - 1) std::copy_n(row, stride, m_values.data());
    }
}

}  // namespace whorl
