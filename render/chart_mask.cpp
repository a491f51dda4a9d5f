// SPDX-License-Identifier: Apache-2.0
#include "render/chart_mask.h"

#include "core/base/parallel.h"
#include "render/mip_rows.kernel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace whorl {
namespace {

constexpr float slack = 1e-3f;  // texels that rounding may be wrong by

void markTriangle(const glm::vec2* uvs, int size, std::vector<std::uint8_t>& mask) {
    glm::vec2 p[3];
    for (int k = 0; k < 3; ++k)
        p[k] = glm::vec2(std::clamp(uvs[k].x, 0.0f, 1.0f), 1.0f - std::clamp(uvs[k].y, 0.0f, 1.0f)) *
               static_cast<float>(size);
    const auto texel = [&](float x) { return std::clamp(static_cast<int>(x), 0, size - 1); };
    const glm::ivec2 low(texel(std::min({p[0].x, p[1].x, p[2].x})), texel(std::min({p[0].y, p[1].y, p[2].y})));
    const glm::ivec2 high(texel(std::max({p[0].x, p[1].x, p[2].x})), texel(std::max({p[0].y, p[1].y, p[2].y})));
    const float turn = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x) < 0.0f ? -1 : 1;
    glm::vec2 inward[3];
    for (int k = 0; k < 3; ++k) {
        const glm::vec2 edge = p[(k + 1) % 3] - p[k];
        inward[k] = glm::vec2(-edge.y, edge.x) * turn;
    }
    for (int y = low.y; y <= high.y; ++y) {
        // Outside when the whole texel lies beyond one edge: on a row that is so from some texel on.
        auto first = static_cast<float>(low.x), last = static_cast<float>(high.x);
        for (int k = 0; k < 3; ++k) {
            const glm::vec2 n = inward[k];
            const float across = n.y * (static_cast<float>(y) + (n.y > 0.0f ? 1.0f : 0.0f) - p[k].y);
            if (n.x > 0.0f) {
                first = std::max(first, std::ceil(p[k].x - 1.0f - across / n.x - slack));
            } else if (n.x < 0.0f) {
                last = std::min(last, std::floor(p[k].x - across / n.x + slack));
            } else if (across < 0.0f) {
                last = -1.0f;
            }
        }
        std::uint8_t* row = mask.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(size);
        for (int x = static_cast<int>(first); x <= static_cast<int>(last); ++x)
            std::atomic_ref<std::uint8_t>(row[x]).store(1, std::memory_order_relaxed);
    }
}

}  // namespace

ChartMask::ChartMask(int size, const std::vector<glm::vec2>& cornerUvs) {
    for (int s = size;; s = std::max(s / 2, 1)) {
        Level& level = m_levels.emplace_back();
        level.side = s;
        level.texels.resize(static_cast<std::size_t>(s) * static_cast<std::size_t>(s));
        if (s <= 1) break;
    }
    parallelFor(cornerUvs.size() / 3, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) markTriangle(cornerUvs.data() + 3 * t, size, m_levels[0].texels);
    });
    for (std::size_t i = 1; i < m_levels.size(); ++i) {
        halve(m_levels[i], m_levels[i - 1]);
        findAround(m_levels[i]);
    }
}

void ChartMask::halve(Level& level, const Level& before) const {
    const auto columns = static_cast<std::size_t>(tiles(level.side));
    level.full.assign(columns * columns, 1);
    const auto halve = WHORL_PICK(halveMask);
    const auto width = static_cast<std::size_t>(level.side), finer = static_cast<std::size_t>(before.side);
    parallelFor(columns, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin * tileSize; y < std::min(end * tileSize, width); ++y) {
            std::uint8_t* out = level.texels.data() + y * width;
            std::uint8_t* full = level.full.data() + y / tileSize * columns;
            const glm::ivec2 rows = children(static_cast<int>(y), level.side, before.side);
            const std::uint8_t* from = before.texels.data() + static_cast<std::size_t>(rows.x) * finer;
            if (finer == 2 * width) {
                for (std::size_t x = 0; x < width; x += tileSize, from += 2 * tileSize) {
                    const std::size_t count = std::min<std::size_t>(tileSize, width - x);
                    full[x / tileSize] &= halve(from, from + finer, count, out + x);
                }
                continue;
            }
            for (std::size_t x = 0; x < width; ++x) {
                const glm::ivec2 across = children(static_cast<int>(x), level.side, before.side);
                unsigned any = 0, all = 1;
                for (std::size_t j = 0; j < static_cast<std::size_t>(rows.y - rows.x); ++j) {
                    for (auto i = static_cast<std::size_t>(across.x); i < static_cast<std::size_t>(across.y); ++i) {
                        any |= from[j * finer + i];
                        all &= from[j * finer + i];
                    }
                }
                out[x] = static_cast<std::uint8_t>(any);
                full[x / tileSize] = static_cast<std::uint8_t>(full[x / tileSize] & all);
            }
        }
    });
}

void ChartMask::findAround(Level& level) const {
    const int side = level.side, columns = tiles(side);
    const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns);
    const auto width = static_cast<std::size_t>(side);
    std::vector<std::vector<std::uint16_t>> found(count);
    parallelFor(static_cast<std::size_t>(columns), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> near(width + 2 * margin);  // a chart lies in this column, margin rows up or down
        for (auto y = static_cast<int>(begin) * tileSize; y < std::min(static_cast<int>(end) * tileSize, side); ++y) {
            std::fill(near.begin(), near.end(), std::uint8_t{0});
            for (int row = std::max(y - margin, 0); row <= std::min(y + margin, side - 1); ++row) {
                const std::uint8_t* from = level.texels.data() + static_cast<std::size_t>(row) * width;
                for (std::size_t x = 0; x < width; ++x) near[x + margin] = near[x + margin] | from[x];
            }
            const std::uint8_t* own = level.texels.data() + static_cast<std::size_t>(y) * width;
            for (std::size_t x = 0; x < width; ++x) {
                if (own[x] != 0) continue;
                unsigned any = 0;
                for (std::size_t i = x; i <= x + 2 * margin; ++i) any |= near[i];
                if (any == 0) continue;
                const auto tile = static_cast<std::size_t>(y / tileSize * columns) + x / tileSize;
                found[tile].push_back(
                    static_cast<std::uint16_t>(static_cast<std::size_t>(y % tileSize) * tileSize + x % tileSize));
            }
        }
    });
    level.firstAround.assign(1, 0);
    for (const auto& some : found) {
        level.around.insert(level.around.end(), some.begin(), some.end());
        level.firstAround.push_back(static_cast<std::uint32_t>(level.around.size()));
    }
}

}  // namespace whorl
