// SPDX-License-Identifier: Apache-2.0
// Improved noise (Perlin, "Improving Noise", SIGGRAPH 2002), one number or a vector a place.
#pragma once

#include <cstdint>

// Every function here has internal linkage and only plain arithmetic, so kernel sources may call it too (see
// core/base/simd.h), and gets the same bytes as everybody else.

namespace whorl {
namespace noise_detail {

// Perlin's own permutation, twice, so that a sum of two entries needs no wrapping.
static constexpr std::int32_t permutation[512] = {
#define WHORL_PERLIN_PERMUTATION                                                                                       \
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99, 37, 240,  \
        21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32, 57, 177, 33,   \
        88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158,  \
        231, 83, 111, 229, 122, 60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63,   \
        161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130, 116, 188, 159, 86, 164, 100,     \
        109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212, 207, 206, \
        59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248, 152, 2, 44, 154, 163, 70, 221, 153,   \
        101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104, 218,     \
        246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241, 81, 51, 145, 235, 249, 14, 239, 107,   \
        49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205,    \
        93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180
    WHORL_PERLIN_PERMUTATION, WHORL_PERLIN_PERMUTATION
#undef WHORL_PERLIN_PERMUTATION
};

// Two entries that follow one another, the second in the second byte: half as many look-ups.
struct PermutationPairs {
    std::int32_t at[511];
};
static constexpr PermutationPairs makePairs() {
    PermutationPairs pairs{};
    for (int i = 0; i < 511; ++i) pairs.at[i] = permutation[i] | permutation[i + 1] << 8;
    return pairs;
}
static constexpr PermutationPairs pairs = makePairs();

static inline float fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}
static inline float mix(float a, float b, float t) {
    return a + t * (b - a);
}

// Dot product of (x, y, z) with one of twelve edge directions, by the low four bits of `hash`.
static inline float gradient(std::int32_t hash, float x, float y, float z) {
    const std::int32_t h = hash & 15;
    const float u = h < 8 ? x : y;
    const float w = (h == 12) | (h == 14) ? x : z;
    const float v = h < 4 ? y : w;
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
}

// The eight corners of the cell of a place.
struct Cell {
    float x, y, z;  // place inside the cell, 0 to 1
    std::int32_t hash[8];
};

// Beyond a billion cells a float has no fraction; the limit keeps what follows defined.
static inline float limited(float x) {
    const float low = x < -1e9f ? -1e9f : x;
    return low > 1e9f ? 1e9f : low;
}

static inline std::int32_t floorToInt(float x) {
    const std::int32_t i = static_cast<std::int32_t>(x);
    return i - (static_cast<float>(i) > x ? 1 : 0);
}

static inline Cell cellAt(float placeX, float placeY, float placeZ) {
    const float x = limited(placeX), y = limited(placeY), z = limited(placeZ);
    const std::int32_t ix = floorToInt(x), iy = floorToInt(y), iz = floorToInt(z);
    const std::int32_t X = ix & 255, Y = iy & 255, Z = iz & 255;
    const std::int32_t both = pairs.at[X];
    const std::int32_t a = pairs.at[(both & 255) + Y], b = pairs.at[(both >> 8) + Y];
    const std::int32_t aa = pairs.at[(a & 255) + Z], ba = pairs.at[(b & 255) + Z], upper = pairs.at[(a >> 8) + Z],
                       bb = pairs.at[(b >> 8) + Z];
    return {x - static_cast<float>(ix),
            y - static_cast<float>(iy),
            z - static_cast<float>(iz),
            {aa & 255, ba & 255, upper & 255, bb & 255, aa >> 8, ba >> 8, upper >> 8, bb >> 8}};
}

template <int Component>
static inline std::int32_t componentHash(std::int32_t h) {
    // Three four-bit numbers out of eight random bits, each two of them independent.
    return Component == 0 ? h : Component == 1 ? h >> 4 : (h >> 4) + 7 * h;
}

template <int Component>
static inline float component(const Cell& c, float u, float v, float w) {
    const float x = c.x, y = c.y, z = c.z;
    const float g0 = gradient(componentHash<Component>(c.hash[0]), x, y, z);
    const float g1 = gradient(componentHash<Component>(c.hash[1]), x - 1.0f, y, z);
    const float g2 = gradient(componentHash<Component>(c.hash[2]), x, y - 1.0f, z);
    const float g3 = gradient(componentHash<Component>(c.hash[3]), x - 1.0f, y - 1.0f, z);
    const float g4 = gradient(componentHash<Component>(c.hash[4]), x, y, z - 1.0f);
    const float g5 = gradient(componentHash<Component>(c.hash[5]), x - 1.0f, y, z - 1.0f);
    const float g6 = gradient(componentHash<Component>(c.hash[6]), x, y - 1.0f, z - 1.0f);
    const float g7 = gradient(componentHash<Component>(c.hash[7]), x - 1.0f, y - 1.0f, z - 1.0f);
    return mix(mix(mix(g0, g1, u), mix(g2, g3, u), v), mix(mix(g4, g5, u), mix(g6, g7, u), v), w);
}

}  // namespace noise_detail

/// Perlin's improved noise: about -1 to 1, zero at whole numbers, repeats after 256.
static inline float perlinNoise(float x, float y, float z) {
    const noise_detail::Cell c = noise_detail::cellAt(x, y, z);
    return noise_detail::component<0>(c, noise_detail::fade(c.x), noise_detail::fade(c.y), noise_detail::fade(c.z));
}

/// Three uncorrelated noises that share the work of finding the cell; the first is perlinNoise. Writes `out[0..2]`.
static inline void perlinVector(float x, float y, float z, float* out) {
    const noise_detail::Cell c = noise_detail::cellAt(x, y, z);
    const float u = noise_detail::fade(c.x), v = noise_detail::fade(c.y), w = noise_detail::fade(c.z);
    out[0] = noise_detail::component<0>(c, u, v, w);
    out[1] = noise_detail::component<1>(c, u, v, w);
    out[2] = noise_detail::component<2>(c, u, v, w);
}

}  // namespace whorl
