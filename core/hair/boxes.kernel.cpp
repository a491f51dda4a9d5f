// SPDX-License-Identifier: Apache-2.0
#include "core/hair/boxes.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

// x, y and z of sixteen vertices: a whole number of vectors, in which each place always holds the same axis.
constexpr std::size_t period = 48;
constexpr float far = 1e30f;

inline float lesser(float a, float b) {
    return a < b ? a : b;
}
inline float greater(float a, float b) {
    return a > b ? a : b;
}

struct Extremes {
    float low[period], high[period], outerLow[period], outerHigh[period];
};

// Vertices of a piece of a hair with the neighbours on both sides; ends are repeated.
struct Piece {
    float numbers[3 + period + 3];
};

inline void take(const float* points, std::size_t first, std::size_t vertices, Piece& piece) {
    constexpr std::size_t most = period / 3;
    const std::size_t left = vertices - first, count = left < most ? left : most;
    const float* from = points + 3 * first;
    const float* before = first > 0 ? from - 3 : from;
    if (count == most) {
        __builtin_memcpy(piece.numbers + 3, from, period * sizeof(float));
    } else {
        for (std::size_t i = 0; i < 3 * count; ++i) piece.numbers[3 + i] = from[i];
    }
    const float* after = left > count ? from + 3 * count : from + 3 * (count - 1);
    for (std::size_t v = count; v <= most; ++v)
        for (std::size_t i = 0; i < 3; ++i) piece.numbers[3 + 3 * v + i] = after[i];
    for (std::size_t i = 0; i < 3; ++i) piece.numbers[i] = before[i];
}

// The Bezier points of the two pieces at a vertex b with neighbours a and c are b +- (c - a) / 6.
inline void add(const Piece& piece, Extremes& e) {
    for (std::size_t i = 0; i < period; ++i) {
        const float p = piece.numbers[i + 3], way = (piece.numbers[i + 6] - piece.numbers[i]) * (1.0f / 6.0f);
        const float reach = way < 0.0f ? -way : way;
        e.low[i] = lesser(e.low[i], p);
        e.high[i] = greater(e.high[i], p);
        e.outerLow[i] = lesser(e.outerLow[i], p - reach);
        e.outerHigh[i] = greater(e.outerHigh[i], p + reach);
    }
}

}  // namespace

void boxesOfHairs(const BoxArrays& a, HairBoxes& boxes) {
    Extremes e;
    for (std::size_t i = 0; i < period; ++i) {
        e.low[i] = e.outerLow[i] = far;
        e.high[i] = e.outerHigh[i] = -far;
    }
    float widest[16] = {};
    Piece piece;
    for (std::size_t hair = 0; hair < a.count; ++hair) {
        const float* points = a.positions + std::size_t{3} * a.firstVertex[hair];
        const std::size_t vertices = a.firstVertex[hair + 1] - a.firstVertex[hair];
        for (std::size_t first = 0; first < vertices; first += period / 3) {
            take(points, first, vertices, piece);
            add(piece, e);
        }
    }
    const std::size_t begin = a.firstVertex[0], end = a.firstVertex[a.count];
    std::size_t v = begin;
    for (; v + 16 <= end; v += 16)
        for (std::size_t i = 0; i < 16; ++i) widest[i] = greater(widest[i], a.widths[v + i]);
    for (; v < end; ++v) widest[0] = greater(widest[0], a.widths[v]);
    boxes.widest = 0.0f;
    for (std::size_t i = 0; i < 16; ++i) boxes.widest = greater(boxes.widest, widest[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        boxes.low[axis] = boxes.outerLow[axis] = far;
        boxes.high[axis] = boxes.outerHigh[axis] = -far;
    }
    for (std::size_t i = 0; i < period; ++i) {
        boxes.low[i % 3] = lesser(boxes.low[i % 3], e.low[i]);
        boxes.high[i % 3] = greater(boxes.high[i % 3], e.high[i]);
        boxes.outerLow[i % 3] = lesser(boxes.outerLow[i % 3], e.outerLow[i]);
        boxes.outerHigh[i % 3] = greater(boxes.outerHigh[i % 3], e.outerHigh[i]);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
