// SPDX-License-Identifier: Apache-2.0
// Four floats at once, for kernels that turn rows into columns. Internal linkage only (see core/base/simd.h).
#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace whorl::quads {

typedef float Quad __attribute__((vector_size(16)));

static inline Quad load(const float* from) {
    Quad q;
    __builtin_memcpy(&q, from, sizeof q);
    return q;
}

static inline void store(const Quad& q, float* to) {
    __builtin_memcpy(to, &q, sizeof q);
}

/// Stores to a multiple of 16 bytes, past the caches where that is possible: for more memory than they hold, which
/// nobody reads soon. Other threads see it after storesPastDone().
static inline void storePast(const Quad& q, float* to) {
#if defined(__SSE__)
    _mm_stream_ps(to, reinterpret_cast<const __m128&>(q));
#else
    store(q, to);
#endif
}

static inline void storesPastDone() {
#if defined(__SSE__)
    _mm_sfence();
#endif
}

/// Asks for a line that will be read once and not again soon; beyond the end of memory that does nothing.
static inline void fetchOnce(const void* place) {
    __builtin_prefetch(place, 0, 0);
}

static inline bool aligned(const float* place) {
    return reinterpret_cast<unsigned long>(place) % sizeof(Quad) == 0;
}

/// Number j of `rows[i]` becomes number i of `rows[j]`.
static inline void transpose(Quad (&rows)[4]) {
    const Quad low01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
    const Quad high01 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
    const Quad low23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
    const Quad high23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
    rows[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    rows[1] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    rows[2] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    rows[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

/// Writes x[0] y[0] z[0] x[1] ... z[3], twelve numbers.
static inline void storeTriples(const Quad& x, const Quad& y, const Quad& z, float* to, bool past) {
    const Quad first = __builtin_shufflevector(x, y, 0, 4, 1, 5);   // x0 y0 x1 y1
    const Quad second = __builtin_shufflevector(x, y, 2, 6, 3, 7);  // x2 y2 x3 y3
    const Quad z0x1 = __builtin_shufflevector(z, first, 0, 0, 6, 6);
    const Quad y1z1 = __builtin_shufflevector(first, z, 3, 3, 5, 5);
    const Quad z2x3 = __builtin_shufflevector(z, second, 2, 2, 6, 6);
    const Quad y3z3 = __builtin_shufflevector(second, z, 3, 3, 7, 7);
    const Quad out[3] = {__builtin_shufflevector(first, z0x1, 0, 1, 4, 6),
                         __builtin_shufflevector(y1z1, second, 0, 2, 4, 5),
                         __builtin_shufflevector(z2x3, y3z3, 0, 2, 4, 6)};
    for (int i = 0; i < 3; ++i) past ? storePast(out[i], to + 4 * i) : store(out[i], to + 4 * i);
}

}  // namespace whorl::quads
