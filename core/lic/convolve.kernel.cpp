// SPDX-License-Identifier: Apache-2.0
#include "core/lic/convolve.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

using namespace lic_word;

constexpr int lanes = 16;
constexpr int fraction = 9;  // bits of a texel

struct Line {
    std::int32_t x, y;
};

bool ends(std::uint32_t word) {
    return word >> 8 == end >> 8;
}

std::uint32_t at(const ConvolveArrays& a, std::int32_t x, std::int32_t y) {
    return static_cast<std::uint32_t>((y >> fraction) * a.side + (x >> fraction));
}

const Special* specialAt(const ConvolveArrays& a, std::uint32_t texel) {
    const std::uint32_t word = a.words[texel];
    if (ends(word) || (word & (0xfffu << 20)) != mark) return nullptr;
    return &a.specials[a.firstSpecial[texel / segment] + ((word >> 8) & 0xfffu)];
}

std::int32_t whole(float x) {
    const std::int32_t i = static_cast<std::int32_t>(x);
    return i - (static_cast<float>(i) > x ? 1 : 0);
}

std::int32_t within(std::int32_t x, std::int32_t limit) {
    return x < 0 ? 0 : x >= limit ? limit - 1 : x;
}

bool partedBy(const ConvolveArrays& a, const Special& special, std::int32_t fromX, std::int32_t fromY, std::int32_t x,
              std::int32_t y) {
    (void)a;
    const std::int32_t dx = (x >> fraction) - (fromX >> fraction) + 2, dy = (y >> fraction) - (fromY >> fraction) + 2;
    return dx >= 0 && dy >= 0 && dx < 5 && dy < 5 && ((special.parted >> (dy * 5 + dx)) & 1u) != 0;
}

// The step from a special texel; false where the streamline ends.
bool stepOn(const ConvolveArrays& a, Line& p, std::int32_t way) {
    const std::uint32_t texel = at(a, p.x, p.y);
    const Special* special = specialAt(a, texel);
    if (!special) return false;
    const std::int32_t limit = a.side * one;
    std::int32_t x = p.x, y = p.y;
    const Special* cut = special;
    if (special->jumps != 0) {
        const float dx = static_cast<float>((x & (one - 1)) - one / 2),
                    dy = static_cast<float>((y & (one - 1)) - one / 2);
        x = within(special->toX + whole(special->turn[0] * dx + special->turn[1] * dy), limit);
        y = within(special->toY + whole(special->turn[2] * dx + special->turn[3] * dy), limit);
        const Special* there = specialAt(a, at(a, x, y));
        cut = there && there->jumps == 0 ? there : nullptr;
    }
    const std::int32_t nextX = within(x + ((special->stepX * way) >> fraction), limit);
    const std::int32_t nextY = within(y + ((special->stepY * way) >> fraction), limit);
    if (cut && cut->parted != 0 && partedBy(a, *cut, x, y, nextX, nextY)) return false;
    p.x = nextX;
    p.y = nextY;
    return true;
}

// Adds the noise along one way; gives the sum of the weights.
void follow(const ConvolveArrays& a, const std::int32_t* startX, std::int32_t startY, const std::int32_t* ways,
            const std::uint32_t* first, std::uint32_t* sums, std::int32_t* totals) {
    std::int32_t x[lanes], y[lanes];
    std::uint32_t words[lanes];
    bool alive[lanes];
    for (int l = 0; l < lanes; ++l) {
        x[l] = startX[l];
        y[l] = startY;
        words[l] = first[l];
        alive[l] = !ends(words[l]);
    }
    for (int l = 0; l < lanes; ++l) {
        if (!alive[l]) continue;
        std::int32_t total = a.totals[a.steps];
        for (int k = 1; k <= a.steps; ++k) {
            const std::uint32_t word = words[l];
            if ((word & (0xfffu << 20)) == mark) {
                Line p{x[l], y[l]};
                if (ends(word)) {
                    total = a.totals[k >= 2 ? k - 2 : 0];
                    break;
                }
                if (!stepOn(a, p, ways[l])) {
                    total = a.totals[k - 1];
                    break;
                }
                x[l] = p.x;
                y[l] = p.y;
            } else {
                const std::int32_t dx = static_cast<std::int32_t>(word) >> 20;
                const std::int32_t dy = static_cast<std::int32_t>(word << 12) >> 20;
                x[l] += (dx * ways[l]) >> fraction;
                y[l] += (dy * ways[l]) >> fraction;
            }
            const std::uint32_t next = a.words[at(a, x[l], y[l])];
            words[l] = next;
            if (ends(next)) {
                total = a.totals[k - 1];
                break;
            }
            sums[l] += static_cast<std::uint32_t>(a.weights[k]) * (((next >> 3) & 31u) | ((next & 7u) << 16));
        }
        totals[l] += total;
    }
}

}  // namespace

void convolveBlock(const ConvolveArrays& a, ConvolveBlock& block) {
    for (int row = 0; row < 16; ++row) {
        std::int32_t x[lanes], ways[lanes], back[lanes], totals[lanes];
        std::uint32_t first[lanes], sums[lanes];
        const std::int32_t y = (block.y + row) * one + one / 2;
        for (int l = 0; l < lanes; ++l) {
            x[l] = (block.x + l) * one + one / 2;
            first[l] = a.words[at(a, x[l], y)];
            ways[l] = block.lengths ? block.lengths[row * lanes + l] : one;
            back[l] = -ways[l];
            sums[l] = static_cast<std::uint32_t>(a.weights[0]) * (((first[l] >> 3) & 31u) | ((first[l] & 7u) << 16));
            totals[l] = a.weights[0];
        }
        follow(a, x, y, ways, first, sums, totals);
        follow(a, x, y, back, first, sums, totals);
        for (int l = 0; l < lanes; ++l) {
            const bool hair = !ends(first[l]);
            const float total = static_cast<float>(totals[l]);
            const float light = static_cast<float>(sums[l] & 0xffffu) * (255.0f / lightMost) / total + 0.5f;
            const float other = static_cast<float>(sums[l] >> 16) * (255.0f / hairMost) / total + 0.5f;
            block.light[row * lanes + l] = hair ? static_cast<std::uint8_t>(static_cast<std::int32_t>(light)) : 0;
            block.hair[row * lanes + l] = hair ? static_cast<std::uint8_t>(static_cast<std::int32_t>(other)) : 0;
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
