// SPDX-License-Identifier: Apache-2.0
// Sixteen floats, and sixteen vectors of three, to memory. Internal linkage only (see core/base/simd.h).
#pragma once

#include "core/base/lanes.h"
#include "core/base/quads.h"

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace whorl::lanes16 {

/// Where whole lanes may be stored past the caches.
static inline bool aligned(const float* place) {
    return reinterpret_cast<unsigned long>(place) % sizeof(Lanes) == 0;
}

/// To an aligned place: see quads::storePast.
static inline void storePast(const Lanes& from, float* to) {
#if defined(__AVX512F__)
    _mm512_stream_ps(to, reinterpret_cast<const __m512&>(from));
#elif defined(__AVX__)
    __m256 halves[2];
    __builtin_memcpy(halves, &from, sizeof halves);
    for (int i = 0; i < 2; ++i) _mm256_stream_ps(to + 8 * i, halves[i]);
#else
    quads::Quad parts[4];
    __builtin_memcpy(parts, &from, sizeof parts);
    for (int i = 0; i < 4; ++i) quads::storePast(parts[i], to + 4 * i);
#endif
}

/// The first `count` of them, at least one.
static inline void storeSome(const Lanes& from, unsigned long count, float* to) {
    float all[16];
    store(from, all);
    unsigned long i = 0;
    for (; i + 4 <= count; i += 4) quads::store(quads::load(all + i), to + i);
    for (; i < count; ++i) to[i] = all[i];
}

/// x[0] y[0] z[0] x[1] ... z[15], 48 numbers.
static inline void interleave(const Lanes& x, const Lanes& y, const Lanes& z, Lanes (&out)[3]) {
#if defined(__AVX512F__)
    const Lanes first = __builtin_shufflevector(x, y, 0, 16, 0, 1, 17, 0, 2, 18, 0, 3, 19, 0, 4, 20, 0, 5);
    const Lanes second = __builtin_shufflevector(x, y, 21, 0, 6, 22, 0, 7, 23, 0, 8, 24, 0, 9, 25, 0, 10, 26);
    const Lanes third = __builtin_shufflevector(x, y, 0, 11, 27, 0, 12, 28, 0, 13, 29, 0, 14, 30, 0, 15, 31, 0);
    out[0] = __builtin_shufflevector(first, z, 0, 1, 16, 3, 4, 17, 6, 7, 18, 9, 10, 19, 12, 13, 20, 15);
    out[1] = __builtin_shufflevector(second, z, 0, 21, 2, 3, 22, 5, 6, 23, 8, 9, 24, 11, 12, 25, 14, 15);
    out[2] = __builtin_shufflevector(third, z, 26, 1, 2, 27, 4, 5, 28, 7, 8, 29, 10, 11, 30, 13, 14, 31);
#else
    float rows[3][16], triples[48];
    store(x, rows[0]);
    store(y, rows[1]);
    store(z, rows[2]);
    for (int i = 0; i < 16; i += 4) {
        quads::storeTriples(quads::load(rows[0] + i), quads::load(rows[1] + i), quads::load(rows[2] + i),
                            triples + 3 * i, false);
    }
    for (int i = 0; i < 3; ++i) load(triples + 16 * i, out[i]);
#endif
}

/// Writes the first `count` (1 to 16) vectors, 3 * count numbers.
static inline void storeVectors(const Lanes& x, const Lanes& y, const Lanes& z, unsigned long count, float* to,
                                bool past) {
    Lanes all[3];
    interleave(x, y, z, all);
    for (unsigned long i = 0; i < 3; ++i) {
        if (3 * count >= 16 * (i + 1)) {
            past ? storePast(all[i], to + 16 * i) : store(all[i], to + 16 * i);
        } else if (3 * count > 16 * i) {
            storeSome(all[i], 3 * count - 16 * i, to + 16 * i);
        }
    }
}

}  // namespace whorl::lanes16
