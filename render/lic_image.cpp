// SPDX-License-Identifier: Apache-2.0
#include "render/lic_image.h"

#include "core/base/parallel.h"
#include "core/model/map.h"
#include "render/mip_rows.kernel.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>

namespace whorl {
namespace {

constexpr int side = LicImage::tileSize;
constexpr std::uint8_t allSides = 7;
using Tiles = LicImage::Tiles;
using Tile = LicImage::Tile;

std::size_t place(int x, int y, int width) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// How the texels of an image come about.
struct Source {
    /// Writes texels [first, last) of a row of level 0. Called by many threads.
    std::function<void(int row, int first, int last, std::uint32_t* out)> read;
    /// As halveRows (render/mip_rows.kernel.h).
    void (*halve)(const std::uint32_t* above, const std::uint32_t* below, const std::uint8_t* maskAbove,
                  const std::uint8_t* maskBelow, std::size_t count, std::uint32_t* out) = nullptr;
    std::uint32_t (*mean)(const std::uint32_t* texels, int count) = nullptr;
};

std::uint32_t meanNumber(const std::uint32_t* texels, int count) {
    std::uint32_t mean = 0;
    for (int shift = 0; shift < 32; shift += 8) {
        int sum = count / 2;
        for (int i = 0; i < count; ++i) sum += static_cast<int>(texels[i] >> shift & 255u);
        mean |= static_cast<std::uint32_t>(sum / count) << shift;
    }
    return mean;
}

/// Light that bytes of sRGB stand for in 65535 parts, and back.
struct LightTables {
    std::array<std::uint16_t, 256> light{};
    std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(65536);

    LightTables() {
        std::size_t from = 0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            light[i] = static_cast<std::uint16_t>(linearFromSrgb(static_cast<float>(i) / 255.0f) * 65535.0f + 0.5f);
            const float next = linearFromSrgb((static_cast<float>(i) + 0.5f) / 255.0f) * 65535.0f;
            const std::size_t end = i < 255 ? static_cast<std::size_t>(next) + 1 : bytes.size();
            for (; from < end; ++from) bytes[from] = static_cast<std::uint8_t>(i);
        }
    }
};

/// The last byte is opaque.
std::uint32_t meanLight(const std::uint32_t* texels, int count) {
    static const LightTables tables;
    bool same = true;
    for (int i = 1; i < count; ++i) same = same && texels[i] == texels[0];
    if (same) return texels[0];
    std::uint32_t mean = 0xff000000u;
    for (int shift = 0; shift < 24; shift += 8) {
        unsigned sum = static_cast<unsigned>(count) / 2;
        for (int i = 0; i < count; ++i) sum += tables.light[texels[i] >> shift & 255u];
        const unsigned light = count == 4 ? sum / 4 : sum / static_cast<unsigned>(count);
        mean |= static_cast<std::uint32_t>(tables.bytes[light]) << shift;
    }
    return mean;
}

void halveLight(const std::uint32_t* above, const std::uint32_t* below, const std::uint8_t* maskAbove,
                const std::uint8_t* maskBelow, std::size_t count, std::uint32_t* out) {
    std::uint32_t some[4];
    for (std::size_t x = 0; x < count; ++x, above += 2, below += 2) {
        if (maskAbove == nullptr) {
            const std::uint32_t all[4] = {above[0], above[1], below[0], below[1]};
            out[x] = meanLight(all, 4);
            continue;
        }
        int found = 0;
        if (maskAbove[2 * x] != 0) some[found++] = above[0];
        if (maskAbove[2 * x + 1] != 0) some[found++] = above[1];
        if (maskBelow[2 * x] != 0) some[found++] = below[0];
        if (maskBelow[2 * x + 1] != 0) some[found++] = below[1];
        out[x] = found > 0 ? meanLight(some, found) : 0;
    }
}

/// The levels of an image, made anew where something changed.
class Builder {
public:
    Builder(std::vector<Tiles>& levels, const ChartMask& mask, const Source& source)
        : m_levels(levels), m_mask(mask), m_source(source) {}

    /// `changed`: tiles of level 0. Tiles that come out as they were stay the same objects.
    void build(std::vector<std::uint8_t> changed) {
        for (int level = 0; level < m_mask.levels() && std::ranges::find(changed, 1) != changed.end(); ++level) {
            if (level > 0) changed = above(changed, level);
            buildLevel(level, changed);
        }
    }

private:
    /// Tiles of a level that are made of `changed` ones of the level before.
    std::vector<std::uint8_t> above(const std::vector<std::uint8_t>& changed, int level) const {
        const int own = m_mask.side(level), finer = m_mask.side(level - 1);
        const int columns = ChartMask::tiles(own), finerColumns = ChartMask::tiles(finer);
        const auto span = [&](int tile) {
            const int last = std::min((tile + 1) * side, own) - 1;
            return glm::ivec2(ChartMask::children(tile * side, own, finer).x / side,
                              (ChartMask::children(last, own, finer).y - 1) / side);
        };
        std::vector<std::uint8_t> stale(static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns), 0);
        for (int y = 0; y < columns; ++y) {
            for (int x = 0; x < columns; ++x) {
                const glm::ivec2 across = span(x), down = span(y);
                for (int j = down.x; j <= down.y; ++j)
                    for (int i = across.x; i <= across.y; ++i)
                        if (changed[place(i, j, finerColumns)] != 0) stale[place(x, y, columns)] = 1;
            }
        }
        return stale;
    }

    /// Leaves in `stale` the tiles that differ from before where charts lie.
    void buildLevel(int level, std::vector<std::uint8_t>& stale) {
        const int own = m_mask.side(level), columns = ChartMask::tiles(own);
        Tiles& tiles = m_levels[static_cast<std::size_t>(level)];
        tiles.resize(stale.size());
        std::vector<std::size_t> touched;
        for (int y = 0; y < columns; ++y) {
            for (int x = 0; x < columns; ++x) {
                const std::size_t tile = place(x, y, columns);
                bool any = stale[tile] != 0;
                // Texels around charts take in those of the tile beside.
                if (!any && level > 0 && !m_mask.around(level, tile).empty()) {
                    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, columns - 1); ++j)
                        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
                            any = any || stale[place(i, j, columns)] != 0;
                }
                if (any) touched.push_back(tile);
            }
        }
        std::vector<std::shared_ptr<Tile>> made(touched.size());
        parallelFor(touched.size(), 2, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t tile = touched[i];
                if (stale[tile] == 0) {
                    made[i] = std::make_shared<Tile>(*tiles[tile]);
                    continue;
                }
                made[i] = std::make_shared_for_overwrite<Tile>();
                fill(level, static_cast<int>(tile) % columns, static_cast<int>(tile) / columns, *made[i]);
            }
        });
        std::vector<LicImage::TilePointer> before(touched.size());
        for (std::size_t i = 0; i < touched.size(); ++i) before[i] = std::exchange(tiles[touched[i]], made[i]);
        parallelFor(touched.size(), 2, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (level > 0) fillAround(level, touched[i], *made[i]);
            }
        });
        for (std::size_t i = 0; i < touched.size(); ++i) {
            if (!before[i] || !same(level, touched[i], *before[i], *made[i])) continue;
            tiles[touched[i]] = before[i];
            stale[touched[i]] = 0;
        }
    }

    glm::ivec2 extent(int level, std::size_t tile) const {
        const int own = m_mask.side(level), columns = ChartMask::tiles(own);
        const glm::ivec2 from = glm::ivec2(static_cast<int>(tile) % columns, static_cast<int>(tile) / columns) * side;
        return {std::min(side, own - from.x), std::min(side, own - from.y)};
    }

    bool same(int level, std::size_t tile, const Tile& a, const Tile& b) const {
        const glm::ivec2 size = extent(level, tile);
        for (int y = 0; y < size.y; ++y) {
            const std::size_t at = place(0, y, side);
            if (std::memcmp(a.texels + at, b.texels + at, static_cast<std::size_t>(size.x) * 4) != 0) return false;
        }
        return true;
    }

    std::uint32_t texel(int level, int x, int y) const {
        const int columns = ChartMask::tiles(m_mask.side(level));
        const Tile& tile = *m_levels[static_cast<std::size_t>(level)][place(x / side, y / side, columns)];
        return tile.texels[place(x % side, y % side, side)];
    }

    void fill(int level, int column, int row, Tile& tile) const {
        const int own = m_mask.side(level);
        const glm::ivec2 first = glm::ivec2(column, row) * side;
        const glm::ivec2 last(std::min(first.x + side, own), std::min(first.y + side, own));
        for (int y = first.y; y < last.y; ++y) {
            std::uint32_t* out = tile.texels + place(0, y - first.y, side);
            if (level == 0) {
                m_source.read(y, first.x, last.x, out);
            } else if (own * 2 == m_mask.side(level - 1)) {
                halve(level, first.x, last.x, y, out);
            } else {
                for (int x = first.x; x < last.x; ++x) *out++ = average(level, x, y);
            }
        }
    }

    void halve(int level, int first, int last, int y, std::uint32_t* out) const {
        const int own = m_mask.side(level), finerColumns = ChartMask::tiles(own * 2);
        const Tiles& finer = m_levels[static_cast<std::size_t>(level - 1)];
        const bool full = m_mask.full(level, place(first / side, y / side, ChartMask::tiles(own)));
        for (int x = first; x < last; x += side / 2, out += side / 2) {
            const Tile& tile = *finer[place(2 * x / side, 2 * y / side, finerColumns)];
            const std::uint32_t* from = tile.texels + place(0, 2 * y % side, side);
            const std::uint8_t* mask = full ? nullptr : m_mask.row(level - 1, 2 * y) + 2 * x;
            m_source.halve(from, from + side, mask, full ? nullptr : mask + 2 * own,
                           static_cast<std::size_t>(std::min(side / 2, last - x)), out);
        }
    }

    std::uint32_t average(int level, int x, int y) const {
        const int own = m_mask.side(level), finer = m_mask.side(level - 1);
        const glm::ivec2 across = ChartMask::children(x, own, finer), down = ChartMask::children(y, own, finer);
        std::uint32_t some[9];  // a half of an odd number takes in three at most
        int found = 0;
        for (int j = down.x; j < down.y; ++j)
            for (int i = across.x; i < across.y; ++i)
                if (m_mask.at(level - 1, i, j)) some[found++] = texel(level - 1, i, j);
        return found > 0 ? m_source.mean(some, found) : 0;
    }

    void fillAround(int level, std::size_t tile, Tile& out) const {
        const int own = m_mask.side(level), columns = ChartMask::tiles(own);
        const glm::ivec2 first = glm::ivec2(static_cast<int>(tile) % columns, static_cast<int>(tile) / columns) * side;
        for (const std::uint16_t around : m_mask.around(level, tile)) {
            const int x = first.x + around % side, y = first.y + around / side;
            std::uint32_t some[25];
            int found = 0;
            for (int ring = 1; ring <= ChartMask::margin && found == 0; ++ring)
                for (int j = std::max(y - ring, 0); j <= std::min(y + ring, own - 1); ++j)
                    for (int i = std::max(x - ring, 0); i <= std::min(x + ring, own - 1); ++i)
                        if (m_mask.at(level, i, j)) some[found++] = texel(level, i, j);
            out.texels[around] = m_source.mean(some, found);
        }
    }

    std::vector<Tiles>& m_levels;
    const ChartMask& m_mask;
    const Source& m_source;
};

/// Marks tiles of a layer of `channels` bytes a texel that differ, where they touch the texels [from, to).
void markChanges(const LicTexture::Layer<std::uint8_t>& before, const LicTexture::Layer<std::uint8_t>& now, int size,
                 std::size_t channels, glm::ivec2 from, glm::ivec2 to, std::vector<std::uint8_t>& changed) {
    if (before == now) return;
    if (!before || !now || before->size() != now->size()) {
        std::ranges::fill(changed, std::uint8_t{1});
        return;
    }
    const int columns = ChartMask::tiles(size);
    parallelFor(changed.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t tile = begin; tile < end; ++tile) {
            const int x = static_cast<int>(tile) % columns * side, y = static_cast<int>(tile) / columns * side;
            if (x >= to.x || y >= to.y || x + side <= from.x || y + side <= from.y) continue;
            const std::size_t bytes = static_cast<std::size_t>(std::min(side, size - x)) * channels;
            for (int row = y; row < std::min(y + side, size) && changed[tile] == 0; ++row) {
                const std::size_t at = place(x, row, size) * channels;
                if (std::memcmp(before->data() + at, now->data() + at, bytes) != 0) changed[tile] = 1;
            }
        }
    });
}

Source tonesOf(const LicTexture& texture) {
    std::array<std::uint32_t, 256> tones;
    for (std::size_t i = 0; i < tones.size(); ++i) {
        const float tone = licTone(static_cast<float>(i) / 255.0f, texture.mean, texture.deviation);
        tones[i] = static_cast<std::uint32_t>(tone * 127.0f + 128.5f) |
                   static_cast<std::uint32_t>(tone * tone * 255.0f + 0.5f) << 8;
    }
    Source source;
    source.read = [&texture, tones](int row, int first, int last, std::uint32_t* out) {
        const std::size_t at = place(first, row, texture.size);
        const auto count = static_cast<std::size_t>(last - first);
        const std::uint8_t* light = texture.light->data() + at;
        const std::uint8_t* cover = texture.cover->data() + at;
        for (std::size_t i = 0; i < count; ++i) {
            // Where no hair lies there is no light to be told: what is around decides.
            const std::uint32_t tone = cover[i] > 0 ? tones[light[i]] : 128u;
            out[i] = tone | static_cast<std::uint32_t>(cover[i]) << 16;
        }
        if (!texture.sides) {
            for (std::size_t i = 0; i < count; ++i) out[i] |= std::uint32_t{allSides} << 24;
            return;
        }
        const std::uint8_t* sides = texture.sides->data() + at;
        for (std::size_t i = 0; i < count; ++i) out[i] |= static_cast<std::uint32_t>(sides[i]) << 24;
    };
    source.halve = WHORL_PICK(halveRows);
    source.mean = meanNumber;
    return source;
}

Source coloursOf(const LicTexture& texture) {
    Source source;
    source.read = [&texture](int row, int first, int last, std::uint32_t* out) {
        const std::uint8_t* from = texture.colours->data() + place(first, row, texture.size) * 3;
        for (int x = first; x < last; ++x, ++out, from += 3)
            *out = std::uint32_t{from[0]} | std::uint32_t{from[1]} << 8 | std::uint32_t{from[2]} << 16 | 0xff000000u;
    };
    source.halve = halveLight;
    source.mean = meanLight;
    return source;
}

}  // namespace

std::shared_ptr<const LicImage> LicImage::make(std::shared_ptr<const LicTexture> texture,
                                               const std::shared_ptr<const LicImage>& before) {
    if (!texture || texture->empty()) return nullptr;
    if (before && before->m_texture == texture) return before;
    const LicTexture& now = *texture;
    const LicTexture* was = before ? before->m_texture.get() : nullptr;
    std::shared_ptr<LicImage> image(new LicImage);
    const bool fresh = !was || was->size != now.size || was->cornerUvs != now.cornerUvs;
    if (fresh) {
        image->m_mask = std::make_shared<const ChartMask>(now.size, *now.cornerUvs);
        image->m_tones.resize(static_cast<std::size_t>(image->m_mask->levels()));
        image->m_colours.resize(image->m_tones.size());
    } else {
        image->m_mask = before->m_mask;
        image->m_tones = before->m_tones;
        image->m_colours = before->m_colours;
    }
    const auto columns = static_cast<std::size_t>(ChartMask::tiles(now.size));
    std::vector<std::uint8_t> tones(columns * columns, 0), colours(columns * columns, 0);
    if (fresh || was->mean != now.mean || was->deviation != now.deviation) std::ranges::fill(tones, std::uint8_t{1});
    if (fresh) {
        std::ranges::fill(colours, std::uint8_t{1});
    } else {
        const glm::ivec2 none(0), all(now.size);
        const bool told = now.changedTo != none && now.changedSince != 0 && now.changedSince == was->serial;
        const glm::ivec2 from = told ? now.changedFrom : none, to = told ? now.changedTo : all;
        markChanges(was->light, now.light, now.size, 1, from, to, tones);
        markChanges(was->cover, now.cover, now.size, 1, from, to, tones);
        markChanges(was->sides, now.sides, now.size, 1, none, all, tones);
        markChanges(was->colours, now.colours, now.size, 3, from, to, colours);
    }
    Builder(image->m_tones, *image->m_mask, tonesOf(now)).build(std::move(tones));
    Builder(image->m_colours, *image->m_mask, coloursOf(now)).build(std::move(colours));
    image->m_texture = std::move(texture);
    return image;
}

}  // namespace whorl
