// SPDX-License-Identifier: Apache-2.0
// Sixteen floats as one value, for kernels whose loops the compiler would take apart. Internal linkage only (see
// core/base/simd.h).
#pragma once

namespace whorl::lanes16 {

typedef float Lanes __attribute__((vector_size(64)));

static inline void load(const float* from, Lanes& to) {
    __builtin_memcpy(&to, from, sizeof to);
}

static inline void store(const Lanes& from, float* to) {
    __builtin_memcpy(to, &from, sizeof from);
}

}  // namespace whorl::lanes16
