// SPDX-License-Identifier: Apache-2.0
// Run-time choice of the vector instruction set: one mechanism for every hot loop.
#pragma once

// A hot loop lives in a file NAME.kernel.cpp that CMake compiles three times (see whorl_add_kernels), each time with
// WHORL_SIMD_NAMESPACE set to simd_plain, simd_avx2 or simd_avx512:
//
//     // frizz.kernel.h, included by the kernel and by its caller
//     #define WHORL_KERNEL(level) namespace level { void frizz(const FrizzArrays&, std::size_t begin, std::size_t end);
//     } WHORL_EACH_SIMD_LEVEL(WHORL_KERNEL)
//
//     // caller
//     const auto frizz = WHORL_PICK(frizz);   // the fastest one that this processor has
//     frizz(arrays, 0, count);
//
// Rules for a kernel source: plain loops over float arrays in one fixed order of operations; no fused multiply-add; no
// function of libm except sqrt (use core/base/polynomials.h); no glm and no inline function of a library, because the
// linker may keep the copy made for a newer processor. With that, all levels give the same bytes.

namespace whorl {

enum class SimdLevel { Plain, Avx2, Avx512 };

/// The level in use: the best of this processor, or less when the environment variable WHORL_SIMD says plain, avx2 or
/// avx512, or when `setSimdLevel` was called. Never above what the processor has.
SimdLevel simdLevel();

/// Lowers the level, for tests and benchmarks. Not while kernels run in other threads.
void setSimdLevel(SimdLevel level);

/// What the processor has.
SimdLevel bestSimdLevel();

const char* simdLevelName(SimdLevel level);

}  // namespace whorl

#define WHORL_EACH_SIMD_LEVEL(declare) declare(simd_plain) declare(simd_avx2) declare(simd_avx512)

#define WHORL_PICK(function)                                                     \
    (::whorl::simdLevel() == ::whorl::SimdLevel::Avx512 ? &simd_avx512::function \
     : ::whorl::simdLevel() == ::whorl::SimdLevel::Avx2 ? &simd_avx2::function   \
                                                        : &simd_plain::function)
