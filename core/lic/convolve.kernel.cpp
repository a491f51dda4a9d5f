// SPDX-License-Identifier: Apache-2.0
#include "core/lic/convolve.kernel.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

using namespace lic_word;

constexpr int lanes = 16;
constexpr int fraction = 9;  // bits of a texel
constexpr int rows = 2;      // looked at together, both ways each: look-ups of one wait for those of none

typedef std::int32_t Ints __attribute__((vector_size(64)));
typedef std::uint32_t Words __attribute__((vector_size(64)));

inline void gather(const std::uint32_t* words, const Ints& index, Words& out) {
#if defined(__AVX512F__)
    // The plain intrinsic of GCC 12 reads a register that nobody set.
    out = (Words)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, (__m512i)index, words, 4);
#elif defined(__AVX2__)
    __m256i half[2];
    __builtin_memcpy(half, &index, sizeof half);
    for (__m256i& of : half) of = _mm256_i32gather_epi32(reinterpret_cast<const int*>(words), of, 4);
    __builtin_memcpy(&out, half, sizeof half);
#else
    for (int l = 0; l < lanes; ++l) out[l] = words[index[l]];
#endif
}

// Lanes whose word is that of a special texel: as a number with a sign they are the lowest.
inline std::uint32_t marked(const Words& words) {
    constexpr auto above = static_cast<std::int32_t>(mark + (1u << 20));
#if defined(__AVX512F__)
    return _mm512_cmplt_epi32_mask((__m512i)words, _mm512_set1_epi32(above));
#else
    const Ints low = (Ints)words < Ints{} + above;
    long long parts[8];
    __builtin_memcpy(parts, &low, sizeof parts);
    if ((parts[0] | parts[1] | parts[2] | parts[3] | parts[4] | parts[5] | parts[6] | parts[7]) == 0) return 0;
    std::uint32_t mask = 0;
    for (int l = 0; l < lanes; ++l) mask |= low[l] != 0 ? 1u << l : 0u;
    return mask;
#endif
}

inline bool ends(std::uint32_t word) {
    return word >> 8 == end >> 8;
}

// Noise for the light in the lower half, that of hairs in the upper one.
inline void addNoise(const Words& words, std::int32_t weight, Words& sums) {
    sums += ((words & 31u) | ((words << 11) & 0x70000u)) * static_cast<std::uint32_t>(weight);
}

inline std::uint32_t texelAt(const ConvolveArrays& a, std::int32_t x, std::int32_t y) {
    return static_cast<std::uint32_t>((y >> fraction) * a.side + (x >> fraction));
}

const Special* specialAt(const ConvolveArrays& a, std::uint32_t texel) {
    const std::uint32_t word = a.words[texel];
    if (ends(word) || (word & (0xfffu << 20)) != mark) return nullptr;
    return &a.specials[a.firstSpecial[texel / segment] + ((word >> 8) & 0xfffu)];
}

inline std::int32_t whole(float x) {
    const std::int32_t i = static_cast<std::int32_t>(x);
    return i - (static_cast<float>(i) > x ? 1 : 0);
}

inline std::int32_t within(std::int32_t x, std::int32_t limit) {
    return x < 0 ? 0 : x >= limit ? limit - 1 : x;
}

bool partedBy(const Special& special, std::int32_t fromX, std::int32_t fromY, std::int32_t x, std::int32_t y) {
    const std::int32_t dx = (x >> fraction) - (fromX >> fraction) + 2, dy = (y >> fraction) - (fromY >> fraction) + 2;
    return dx >= 0 && dy >= 0 && dx < 5 && dy < 5 && ((special.parted >> (dy * 5 + dx)) & 1u) != 0;
}

void land(const ConvolveArrays& a, std::int32_t x, std::int32_t y, int left, ConvolveBlock& block) {
    const auto number =
        static_cast<std::uint32_t>((y >> fraction) / lanes * (a.side / lanes) + (x >> fraction) / lanes);
    constexpr int most = ConvolveBlock::mostLandings;
    // Neighbours land together: mostly it is the last one again.
    for (int i = (block.landingCount < most ? block.landingCount : most) - 1; i >= 0; --i) {
        if (block.landings[i] != number) continue;
        if (block.onwards[i] < left) block.onwards[i] = left;
        return;
    }
    if (block.landingCount < most) {
        block.landings[block.landingCount] = number;
        block.onwards[block.landingCount] = left;
    }
    if (block.landingCount <= most) ++block.landingCount;
}

// The step from a special texel; false where the streamline ends.
bool stepOn(const ConvolveArrays& a, std::int32_t& atX, std::int32_t& atY, std::int32_t way, std::int32_t& stays,
            int left, ConvolveBlock& block) {
    const Special* special = specialAt(a, texelAt(a, atX, atY));
    if (!special) return false;
    const std::int32_t limit = a.side * one;
    std::int32_t x = atX, y = atY;
    const Special* cut = special;
    if (special->jumps != 0) {
        const float dx = static_cast<float>((x & (one - 1)) - one / 2),
                    dy = static_cast<float>((y & (one - 1)) - one / 2);
        x = within(special->toX + whole(special->turn[0] * dx + special->turn[1] * dy), limit);
        y = within(special->toY + whole(special->turn[2] * dx + special->turn[3] * dy), limit);
        land(a, x, y, left, block);
        stays = 0;
        const Special* there = specialAt(a, texelAt(a, x, y));
        cut = there && there->jumps == 0 ? there : nullptr;
        // Nor does the seam lead over a parting.
        if (special->parted != 0 && partedBy(*special, special->toX, special->toY, x, y)) return false;
    }
    const std::int32_t nextX = within(x + ((special->stepX * way) >> fraction), limit);
    const std::int32_t nextY = within(y + ((special->stepY * way) >> fraction), limit);
    if (cut && cut->parted != 0 && partedBy(*cut, x, y, nextX, nextY)) return false;
    if (special->jumps != 0 && special->parted != 0 && partedBy(*special, special->toX, special->toY, nextX, nextY))
        return false;
    atX = nextX;
    atY = nextY;
    return true;
}

// 16 streamlines from neighbouring texels, one way, when something is to be done to single ones.
struct Lines {
    Ints x, y;
    Words words;
    std::uint32_t special;  // lanes that stand on special texels
    Ints stays;             // lanes with all bits set: those that have gone over no seam
};

// A streamline that has ended stays on the first word, which is zero: no step, no noise.
inline void finish(Lines& lines, int lane) {
    lines.x[lane] = 0;
    lines.y[lane] = 0;
    lines.words[lane] = 0;
    lines.special &= ~(1u << lane);
}

__attribute__((noinline)) void finishEnded(Lines& lines, std::int32_t total, Ints& totals) {
    for (std::uint32_t left = lines.special; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        if (!ends(lines.words[lane])) continue;
        finish(lines, lane);
        totals[lane] = total;
    }
}

// From `fromX`, `fromY` on: the step that the word says is none.
__attribute__((noinline)) void stepSpecial(const ConvolveArrays& a, Lines& lines, const Ints& fromX, const Ints& fromY,
                                           const Ints& ways, int step, Ints& totals, ConvolveBlock& block) {
    for (std::uint32_t left = lines.special; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        std::int32_t x = fromX[lane], y = fromY[lane];
        std::int32_t stays = lines.stays[lane];
        const bool goesOn = stepOn(a, x, y, ways[lane], stays, a.steps - step + 1, block);
        lines.stays[lane] = stays;
        if (goesOn) {
            lines.x[lane] = x;
            lines.y[lane] = y;
        } else {
            finish(lines, lane);
            totals[lane] = a.totals[step - 1];
        }
    }
}

// Where streamlines have been. Those that stay on the first word count as nowhere.
struct Reach {
    Words left = ~Words{}, top = ~Words{};
    Ints right{}, bottom{};
    void add(const Ints& x, const Ints& y, const Ints& stays) {
        const Ints toX = x & stays, toY = y & stays;
        const Words fromX = (Words)(toX - 1), fromY = (Words)(toY - 1);
        left = fromX < left ? fromX : left;
        top = fromY < top ? fromY : top;
        right = toX > right ? toX : right;
        bottom = toY > bottom ? toY : bottom;
    }
    void addTo(ConvolveBlock& block) const {
        for (int l = 0; l < lanes; ++l) {
            if (right[l] == 0) continue;
            const int fromX = static_cast<int>(left[l] >> fraction), fromY = static_cast<int>(top[l] >> fraction);
            block.left = fromX < block.left ? fromX : block.left;
            block.top = fromY < block.top ? fromY : block.top;
            block.right = right[l] >> fraction > block.right ? right[l] >> fraction : block.right;
            block.bottom = bottom[l] >> fraction > block.bottom ? bottom[l] >> fraction : block.bottom;
        }
    }
};

template <bool Scaled>
void convolveRows(const ConvolveArrays& a, ConvolveBlock& block, int first) {
    constexpr int count = 2 * rows;
    // Two of them, there and back, start in one row. In registers, but for `totals`: the sums of the weights up to
    // where each ends.
    Ints x[count], y[count], ways[count], totals[count], stays[count];
    Reach reach;
    Words words[count], sums[count], hair[rows];
    std::uint32_t special[count];
    Ints column{};
    for (int l = 0; l < lanes; ++l) column[l] = l;
    for (int r = 0; r < rows; ++r) {
        Lines start;
        start.x = (column + block.x) * one + one / 2;
        start.y = Ints{} + ((block.y + first + r) * one + one / 2);
        gather(a.words, (start.y >> fraction) * a.side + (start.x >> fraction), hair[r]);
        start.words = hair[r];
        start.special = marked(hair[r]);
        start.stays = ~Ints{};
        Ints whole = Ints{} + a.totals[a.steps];
        finishEnded(start, 0, whole);
        Ints forward = Ints{} + one;
        if (Scaled)
            for (int l = 0; l < lanes; ++l) forward[l] = block.lengths[(first + r) * lanes + l];
        for (int way = 0; way < 2; ++way) {
            const int i = 2 * r + way;
            x[i] = start.x;
            y[i] = start.y;
            words[i] = start.words;
            special[i] = start.special;
            totals[i] = whole;
            sums[i] = Words{};
            stays[i] = ~Ints{};
            reach.add(x[i], y[i], stays[i]);
            ways[i] = way == 0 ? forward : -forward;
        }
    }
    for (int k = 1; k <= a.steps; ++k) {
        const std::int32_t weight = a.weights[k], before = a.totals[k - 1];
#pragma GCC unroll 4
        for (int i = 0; i < count; ++i) {
            Ints dx = (Ints)words[i] >> 20, dy = (Ints)(words[i] << 12) >> 20;
            if (Scaled) {
                dx = (dx * ways[i]) >> fraction;
                dy = (dy * ways[i]) >> fraction;
            } else if (i % 2 == 1) {
                dx = -dx;
                dy = -dy;
            }
            const Ints nextX = x[i] + dx, nextY = y[i] + dy;
            if (__builtin_expect(special[i] != 0, 0)) {
                Lines some{nextX, nextY, words[i], special[i], stays[i]};
                Ints ended = totals[i];
                const Ints fromX = x[i], fromY = y[i], way = ways[i];
                stepSpecial(a, some, fromX, fromY, way, k, ended, block);
                totals[i] = ended;
                stays[i] = some.stays;
                x[i] = some.x;
                y[i] = some.y;
            } else {
                x[i] = nextX;
                y[i] = nextY;
            }
            gather(a.words, (y[i] >> fraction) * a.side + (x[i] >> fraction), words[i]);
            special[i] = marked(words[i]);
            if (__builtin_expect(special[i] != 0, 0)) {
                Lines some{x[i], y[i], words[i], special[i], stays[i]};
                Ints ended = totals[i];
                finishEnded(some, before, ended);
                totals[i] = ended;
                x[i] = some.x;
                y[i] = some.y;
                words[i] = some.words;
                special[i] = some.special;
            }
            addNoise(words[i], weight, sums[i]);
        }
        if (k % ConvolveBlock::seen == 0)
            for (int i = 0; i < count; ++i) reach.add(x[i], y[i], stays[i]);
    }
    reach.addTo(block);
    for (int r = 0; r < rows; ++r) {
        Words all = sums[2 * r] + sums[2 * r + 1];
        addNoise(hair[r], a.weights[0], all);
        const Ints weights = totals[2 * r] + totals[2 * r + 1] + a.weights[0];
        for (int l = 0; l < lanes; ++l) {
            const bool grows = !ends(hair[r][l]);
            const float total = static_cast<float>(weights[l]);
            const float light =
                static_cast<float>(static_cast<std::int32_t>(all[l] & 0xffffu)) * (255.0f / lightMost) / total + 0.5f;
            const float other =
                static_cast<float>(static_cast<std::int32_t>(all[l] >> 16)) * (255.0f / hairMost) / total + 0.5f;
            const int at = (first + r) * lanes + l;
            block.grows[at] = grows ? 1 : 0;
            block.light[at] = grows ? static_cast<std::uint8_t>(static_cast<std::int32_t>(light)) : 0;
            block.hair[at] = grows ? static_cast<std::uint8_t>(static_cast<std::int32_t>(other)) : 0;
        }
    }
}

}  // namespace

void convolveBlock(const ConvolveArrays& a, ConvolveBlock& block) {
    block.landingCount = 0;
    block.left = block.top = a.side;
    block.right = block.bottom = -1;
    for (int first = 0; first < 16; first += rows) {
        if (block.lengths) {
            convolveRows<true>(a, block, first);
        } else {
            convolveRows<false>(a, block, first);
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
