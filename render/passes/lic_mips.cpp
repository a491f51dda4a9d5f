// SPDX-License-Identifier: Apache-2.0
#include "render/passes/lic_mips.h"

#include "core/base/parallel.h"
#include "core/model/map.h"

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace whorl {
namespace {

constexpr int side = MipImage::tileSize;
constexpr std::size_t tileTexels = std::size_t{side} * side;
// A pixel at the edge of a chart may lie most of a pixel outside it, and filtering reaches half a texel further.
constexpr int margin = 2;
constexpr std::size_t staged = 256;  // tiles that are made before they are sent

/// Texels of the level before that a texel of a level is the mean of: [first, last) on one axis.
glm::ivec2 children(int at, int level, int before) {
    return {static_cast<int>(static_cast<std::int64_t>(at) * before / level),
            static_cast<int>((static_cast<std::int64_t>(at) + 1) * before / level)};
}

void markTriangle(const glm::vec2* uvs, int size, std::vector<std::uint8_t>& mask) {
    glm::vec2 p[3];
    for (int k = 0; k < 3; ++k)
        p[k] = glm::vec2(std::clamp(uvs[k].x, 0.0f, 1.0f), 1.0f - std::clamp(uvs[k].y, 0.0f, 1.0f)) *
               static_cast<float>(size);
    const auto texel = [&](float x) { return std::clamp(static_cast<int>(x), 0, size - 1); };
    const glm::ivec2 low(texel(std::min({p[0].x, p[1].x, p[2].x})), texel(std::min({p[0].y, p[1].y, p[2].y})));
    const glm::ivec2 high(texel(std::max({p[0].x, p[1].x, p[2].x})), texel(std::max({p[0].y, p[1].y, p[2].y})));
    const float turn = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x) < 0.0f ? -1 : 1;
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            // Outside when the whole texel lies beyond one edge.
            bool touched = true;
            for (int k = 0; k < 3 && touched; ++k) {
                const glm::vec2 from = p[k], edge = p[(k + 1) % 3] - from;
                const glm::vec2 inward = glm::vec2(-edge.y, edge.x) * turn;
                const glm::vec2 corner(static_cast<float>(x) + (inward.x > 0.0f ? 1.0f : 0.0f) - from.x,
                                       static_cast<float>(y) + (inward.y > 0.0f ? 1.0f : 0.0f) - from.y);
                touched = inward.x * corner.x + inward.y * corner.y >= 0.0f;
            }
            if (!touched) continue;
            std::uint8_t& cell =
                mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
            std::atomic_ref<std::uint8_t>(cell).store(1, std::memory_order_relaxed);
        }
    }
}

const std::array<float, 256>& lightTable() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
        return values;
    }();
    return table;
}

}  // namespace

ChartMask::ChartMask(int size, const std::vector<glm::vec2>& cornerUvs) {
    for (int s = size;; s = std::max(s / 2, 1)) {
        m_sides.push_back(s);
        m_levels.emplace_back(static_cast<std::size_t>(s) * static_cast<std::size_t>(s), std::uint8_t{0});
        if (s <= 1) break;
    }
    parallelFor(cornerUvs.size() / 3, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) markTriangle(cornerUvs.data() + 3 * t, size, m_levels[0]);
    });
    for (int level = 1; level < levels(); ++level) {
        const int own = side(level), before = side(level - 1);
        parallelFor(static_cast<std::size_t>(own), 16, [&](std::size_t begin, std::size_t end) {
            for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
                const glm::ivec2 rows = children(y, own, before);
                for (int x = 0; x < own; ++x) {
                    const glm::ivec2 columns = children(x, own, before);
                    bool any = false;
                    for (int j = rows.x; j < rows.y; ++j)
                        for (int i = columns.x; i < columns.y; ++i) any = any || at(level - 1, i, j);
                    m_levels[static_cast<std::size_t>(level)][static_cast<std::size_t>(y * own + x)] = any ? 1 : 0;
                }
            }
        });
    }
}

void MipImage::average(const ChartMask& mask, int level, glm::ivec2 tile, const Read& read) {
    const int own = mask.side(level), before = mask.side(level - 1);
    auto& out = m_levels[static_cast<std::size_t>(level)];
    const auto& source = m_levels[static_cast<std::size_t>(level - 1)];
    const glm::ivec2 first = tile * side, last = glm::min(first + side, glm::ivec2(own));
    const glm::ivec2 span(children(first.x, own, before).x, children(last.x - 1, own, before).y);
    std::vector<Texel> rows;  // of level 0, which is not kept
    for (int y = first.y; y < last.y; ++y) {
        const glm::ivec2 down = children(y, own, before);
        const auto width = static_cast<std::size_t>(span.y - span.x);
        if (level == 1) {
            rows.resize(width * static_cast<std::size_t>(down.y - down.x));
            for (int j = down.x; j < down.y; ++j)
                read(j, span.x, span.y, rows.data() + static_cast<std::size_t>(j - down.x) * width);
        }
        for (int x = first.x; x < last.x; ++x) {
            const glm::ivec2 across = children(x, own, before);
            int sums[4] = {0, 0, 0, 0}, count = 0;
            float light[3] = {0.0f, 0.0f, 0.0f};
            for (int j = down.x; j < down.y; ++j) {
                for (int i = across.x; i < across.y; ++i) {
                    if (!mask.at(level - 1, i, j)) continue;
                    const Texel& texel =
                        level == 1
                            ? rows[static_cast<std::size_t>(j - down.x) * width + static_cast<std::size_t>(i - span.x)]
                            : source[static_cast<std::size_t>(j) * static_cast<std::size_t>(before) +
                                     static_cast<std::size_t>(i)];
                    for (std::size_t c = 0; c < 4; ++c) sums[c] += texel[c];
                    if (m_encoding == Encoding::Srgb)
                        for (std::size_t c = 0; c < 3; ++c) light[c] += lightTable()[texel[c]];
                    ++count;
                }
            }
            Texel& mean =
                out[static_cast<std::size_t>(y) * static_cast<std::size_t>(own) + static_cast<std::size_t>(x)];
            mean = {};
            if (count == 0) continue;
            for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<std::uint8_t>((sums[c] + count / 2) / count);
            if (m_encoding == Encoding::Linear) continue;
            for (std::size_t c = 0; c < 3; ++c)
                mean[c] = static_cast<std::uint8_t>(
                    std::clamp(srgbFromLinear(light[c] / static_cast<float>(count)) * 255.0f + 0.5f, 0.0f, 255.0f));
        }
    }
}

void MipImage::send(const ChartMask& mask, int level, const std::vector<std::size_t>& tiles, const Read& read,
                    const Send& sendPiece) {
    const int own = mask.side(level), columns = MipImage::tiles(own);
    const auto place = [&](std::size_t i) {
        const auto tile = static_cast<int>(tiles[i]);
        return glm::ivec2(tile % columns, tile / columns) * side;
    };
    const auto fill = [&](std::size_t i, Texel* out) {
        const glm::ivec2 first = place(i), last = glm::min(first + side, glm::ivec2(own));
        const auto& texels = m_levels[static_cast<std::size_t>(level)];
        for (int y = first.y; y < last.y; ++y, out += side) {
            if (level == 0) {
                read(y, first.x, last.x, out);
                continue;
            }
            for (int x = first.x; x < last.x; ++x) {
                const auto at = [&](int column, int row) {
                    return static_cast<std::size_t>(row) * static_cast<std::size_t>(own) +
                           static_cast<std::size_t>(column);
                };
                Texel& texel = out[x - first.x];
                texel = texels[at(x, y)];
                if (mask.at(level, x, y)) continue;
                int sums[4] = {0, 0, 0, 0}, count = 0;
                for (int ring = 1; ring <= margin && count == 0; ++ring) {
                    for (int row = std::max(y - ring, 0); row <= std::min(y + ring, own - 1); ++row) {
                        for (int column = std::max(x - ring, 0); column <= std::min(x + ring, own - 1); ++column) {
                            if (!mask.at(level, column, row)) continue;
                            for (std::size_t c = 0; c < 4; ++c) sums[c] += texels[at(column, row)][c];
                            ++count;
                        }
                    }
                }
                for (std::size_t c = 0; c < 4 && count > 0; ++c)
                    texel[c] = static_cast<std::uint8_t>((sums[c] + count / 2) / count);
            }
        }
    };
    for (std::size_t begin = 0; begin < tiles.size(); begin += staged) {
        const std::size_t count = std::min(staged, tiles.size() - begin);
        m_staging.resize(std::max(m_staging.size(), count * tileTexels));
        parallelFor(count, 4, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) fill(begin + i, m_staging.data() + i * tileTexels);
        });
        for (std::size_t i = 0; i < count; ++i) {
            const glm::ivec2 from = place(begin + i);
            sendPiece(
                {level, from, glm::min(glm::ivec2(side), glm::ivec2(own) - from), m_staging.data() + i * tileTexels});
        }
    }
}

void MipImage::update(const ChartMask& mask, const std::vector<std::uint8_t>& changed, const Read& read,
                      const Send& sendPiece) {
    m_levels.resize(static_cast<std::size_t>(mask.levels()));
    std::vector<std::uint8_t> before = changed;
    for (int level = 0; level < mask.levels(); ++level) {
        const int own = mask.side(level), columns = tiles(own);
        std::vector<std::uint8_t> now = before;
        std::vector<std::size_t> stale, around;
        if (level > 0) {
            m_levels[static_cast<std::size_t>(level)].resize(static_cast<std::size_t>(own) *
                                                             static_cast<std::size_t>(own));
            const int finer = mask.side(level - 1), finerColumns = tiles(finer);
            now.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns), 0);
            for (int y = 0; y < columns; ++y) {
                for (int x = 0; x < columns; ++x) {
                    const int right = std::min((x + 1) * side, own) - 1, bottom = std::min((y + 1) * side, own) - 1;
                    const glm::ivec2 over(children(x * side, own, finer).x / side,
                                          (children(right, own, finer).y - 1) / side);
                    const glm::ivec2 down(children(y * side, own, finer).x / side,
                                          (children(bottom, own, finer).y - 1) / side);
                    bool any = false;
                    for (int j = down.x; j <= down.y; ++j)
                        for (int i = over.x; i <= over.y; ++i)
                            any = any || before[static_cast<std::size_t>(j * finerColumns + i)] != 0;
                    now[static_cast<std::size_t>(y * columns + x)] = any ? 1 : 0;
                }
            }
        }
        // Texels around charts take in those of the tile beside.
        const int reach = level > 0 ? 1 : 0;
        for (int y = 0; y < columns; ++y) {
            for (int x = 0; x < columns; ++x) {
                const auto tile = static_cast<std::size_t>(y * columns + x);
                if (now[tile] != 0) stale.push_back(tile);
                bool any = false;
                for (int j = std::max(y - reach, 0); j <= std::min(y + reach, columns - 1); ++j)
                    for (int i = std::max(x - reach, 0); i <= std::min(x + reach, columns - 1); ++i)
                        any = any || now[static_cast<std::size_t>(j * columns + i)] != 0;
                if (any) around.push_back(tile);
            }
        }
        if (stale.empty()) return;
        if (level > 0) {
            parallelFor(stale.size(), 1, [&](std::size_t from, std::size_t to) {
                for (std::size_t i = from; i < to; ++i) {
                    const auto tile = static_cast<int>(stale[i]);
                    average(mask, level, glm::ivec2(tile % columns, tile / columns), read);
                }
            });
        }
        send(mask, level, around, read, sendPiece);
        before = std::move(now);
    }
}

}  // namespace whorl
