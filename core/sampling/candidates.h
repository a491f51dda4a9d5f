// SPDX-License-Identifier: Apache-2.0
// The endless sequence of places that hairs are taken from.
#pragma once

#include <cstdint>

// The surface is laid out along a line of 2^32 units (see surface_curve.h). Candidate i lies in unit
//
//     s(i) = reversed(stratumOf(i)),
//
// the van der Corput sequence with Owen's scrambling: for every k, the first 2^k candidates have one place in each of
// the 2^k equal strata of the line, and so has every later run of 2^k that starts at a multiple of 2^k. `stratumOf` is
// a permutation whose bit b depends on bits 0 to b of its argument only, made of steps that can be undone, so that a
// stratum names its candidate without a search.
//
// Every function here has internal linkage and only plain arithmetic, so kernel sources may call it too (see
// core/base/simd.h).

namespace whorl {

/// Random numbers that the sequence of one seed depends on.
struct CandidateKeys {
    std::uint32_t add[3];
    std::uint32_t fine;
};

namespace candidate_detail {
static constexpr std::uint32_t m0 = 0xd2a98b27u, m1 = 0x8f9b3a6bu, m2 = 0xb5297a4fu;
// x * m * inverse(m) = x: Newton's iteration doubles the number of right bits.
static constexpr std::uint32_t inverse(std::uint32_t m) {
    std::uint32_t x = m;
    for (int i = 0; i < 5; ++i) x *= 2u - m * x;
    return x;
}
static constexpr std::uint32_t w0 = inverse(m0), w1 = inverse(m1), w2 = inverse(m2);
static_assert(w0 * m0 == 1u && w1 * m1 == 1u && w2 * m2 == 1u);
}  // namespace candidate_detail

static inline std::uint32_t reversed(std::uint32_t x) {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

/// The candidate below 2^k in a stratum of level k; bits k and up of either are of no meaning. `stratum` counts from
/// the low end of reversed numbers: it is reversed(s) of any place s in it.
static inline std::uint32_t candidateIn(const CandidateKeys& keys, std::uint32_t stratum) {
    using namespace candidate_detail;
    std::uint32_t x = (stratum + keys.add[0]) * m0;
    x ^= x << 7;
    x = (x + keys.add[1]) * m1;
    x ^= x << 11;
    return (x + keys.add[2]) * m2;
}

/// Undoes candidateIn.
static inline std::uint32_t stratumOf(const CandidateKeys& keys, std::uint32_t candidate) {
    using namespace candidate_detail;
    std::uint32_t x = candidate * w2 - keys.add[2];
    x ^= x << 11;
    x ^= x << 22;
    x = x * w1 - keys.add[1];
    x ^= x << 7;
    x ^= x << 14;
    x ^= x << 28;
    return x * w0 - keys.add[0];
}

/// The unit of the line that a stratum starts at, candidates' own strata being one unit long. The last unit counts as
/// the one before, so that the end of the line is a number of 32 bits.
static inline std::uint32_t unitOf(std::uint32_t stratum) {
    const std::uint32_t s = reversed(stratum);
    return s < 0xfffffffeu ? s : 0xfffffffeu;
}

/// Where in its unit a candidate lies, 32 bits.
static inline std::uint32_t finePlace(const CandidateKeys& keys, std::uint32_t candidate) {
    std::uint32_t x = candidate * 0x9e3779b9u + keys.fine;
    x ^= x >> 15;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    return x;
}

/// Share of the way from unit `begin` to the end of a triangle of `width` units, 32 bits: `ahead` whole units and
/// `fine` / 2^32. `zeros`: leading zero bits of width; `reciprocal`: (2^64 - 1) / (width << zeros) - 2^32, rounded
/// down.
static inline std::uint32_t shareOfTriangle(std::uint32_t ahead, std::uint32_t fine, std::uint32_t zeros,
                                            std::uint32_t reciprocal) {
    const std::uint32_t d = ahead << zeros | fine >> 1 >> (31u - zeros);
    return d + static_cast<std::uint32_t>(static_cast<std::uint64_t>(d) * reciprocal >> 32);
}

/// The curve in a triangle: goes from its first corner to its third through all pieces of the 1:4 subdivision, each
/// entered at one corner and left at another where the next begins. Two bits of `share` name a piece at each depth,
/// coarse ones first: the piece at the corner of entry, the next one aside, the middle one, the one at the corner of
/// exit. Gives the middle of the piece at depth 16 in units of 1 / 196608 of (u, v).
///
/// A piece's own curve goes the other way round (its second and third corner change places) in pieces 0 and 2, and
/// piece 2 is turned by half a turn. So with h, l the bits of a piece: along one side the curve is on its far half when
/// h, along the other when h xor l; which side is which depends on how many coarser pieces were even, and the sign of
/// the halves on how many were 2. Both are parities over the coarser bits, worked out for all depths at once.
static inline void placeInTriangle(std::uint32_t share, std::int32_t& u, std::int32_t& v) {
    const std::uint32_t high = share & 0xaaaaaaaau;
    const std::uint32_t step = (share ^ share << 1) & 0xaaaaaaaau;
    std::uint32_t parity = (share & ~(share << 1) & 0xaaaaaaaau) | (~share & 0x55555555u);
    parity ^= parity >> 2;
    parity ^= parity >> 4;
    parity ^= parity >> 8;
    parity ^= parity >> 16;
    const std::uint32_t last = parity >> 1 & 1u;
    const std::uint32_t turned = parity >> 2;
    const std::uint32_t differ = (high ^ step) & turned << 1;
    const std::uint32_t along = step ^ differ, across = high ^ differ;
    // Bits of a positive and of a negative half, side by side: 31, 29, ... and 30, 28, ...
    std::uint32_t a = (along & ~turned) | (along & turned) >> 1;
    std::uint32_t b = (across & ~turned) | (across & turned) >> 1;
    const auto apart = [](std::uint32_t x) {
        std::uint32_t t = (x ^ x >> 1) & 0x22222222u;
        x ^= t ^ t << 1;
        t = (x ^ x >> 2) & 0x0c0c0c0cu;
        x ^= t ^ t << 2;
        t = (x ^ x >> 4) & 0x00f000f0u;
        x ^= t ^ t << 4;
        t = (x ^ x >> 8) & 0x0000ff00u;
        return x ^ t ^ t << 8;
    };
    a = apart(a);
    b = apart(b);
    const std::int32_t third = 1 - 2 * static_cast<std::int32_t>(last);
    u = 3 * (static_cast<std::int32_t>(a >> 16) - static_cast<std::int32_t>(a & 0xffffu)) + third;
    v = 3 * (static_cast<std::int32_t>(b >> 16) - static_cast<std::int32_t>(b & 0xffffu)) + third;
}
static constexpr float placeUnit = 1.0f / 196608.0f;

}  // namespace whorl
