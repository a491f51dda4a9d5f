// SPDX-License-Identifier: Apache-2.0
// Kernels of the root sampler. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"
#include "core/sampling/candidates.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Strata looked at together: what fits into the first cache with all that is known of them.
inline constexpr std::size_t sweepStrata = 512;

struct SweepArrays {
    CandidateKeys keys;
    const std::uint32_t* limits;  ///< by density code: candidates below it are hairs
    const std::uint8_t* levels;   ///< by density code: k such that 2^k is not below that limit, 4 to 31
    // Triangles in order of the curve.
    std::size_t count;
    const std::uint32_t* triangles;
    const std::uint32_t* begins;  ///< count + 1 entries
    const std::uint32_t* reciprocals;
    const std::uint32_t* firstCode;  ///< in `codes`
    const std::uint8_t* depths;
    const std::uint8_t* most;  ///< largest code; zero where nothing grows
    const std::uint8_t* codes;
};

/// Room for `capacity` roots, of which `count` are there.
struct SweepRoots {
    std::uint32_t* ids;
    std::uint32_t* triangles;
    float* u;
    float* v;
    std::size_t capacity;
    std::size_t count;
};

/// What one map says of the pieces of a triangle.
struct PieceArrays {
    const float*
        texels;  ///< rows of width + 2: a copy of the last column, all columns, a copy of the first; rows alike
    int width, height;
    bool flipV;
    float scale;  ///< texels times this are 0 to 1
    float uv[2], toB[2], toC[2];
    const float* u;  ///< middles of the pieces in the triangle, in order of the curve
    const float* v;
};

#define WHORL_SWEEP_KERNELS(level)                                                                                    \
    namespace level {                                                                                                 \
    /* Roots on the line from unit `from`, which is on triangle `place` of the curve, up to `to`. Gives the unit that \
     */                                                                                                               \
    /* it came to: below `to` when there might be no room for all candidates of the next strata. */                   \
    std::uint32_t sweepRoots(const SweepArrays& arrays, std::size_t place, std::uint32_t from, std::uint32_t to,      \
                             SweepRoots& roots);                                                                      \
    /* Density codes of `count` pieces (see densityCode). */                                                          \
    void codePieces(const PieceArrays& arrays, std::size_t count, std::uint8_t* codes);                               \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_SWEEP_KERNELS)
#undef WHORL_SWEEP_KERNELS

}  // namespace whorl
