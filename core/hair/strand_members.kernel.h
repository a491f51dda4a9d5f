// SPDX-License-Identifier: Apache-2.0
// The hairs of one strand, a vertex a lane, to where they stay. See core/base/simd.h.
#pragma once

#include "core/base/simd.h"

#include <cstddef>
#include <cstdint>

namespace whorl {

/// Rows of one base hair, a vertex a lane: see strandRows. A coordinate of a member is
/// base + across * U + up * V + lift * W, and so is the way from the vertex before to the one after. Row r of vertex v
/// is at [(v / 16 * rows + r) * 16 + v % 16].
struct StrandRows {
    enum Row { Base = 0, U = 3, V = 6, W = 9, Normal = 12, Ways = 15 };  ///< three each; Ways: of base, U, V and W
    static constexpr std::size_t rows = Ways + 12;
    static constexpr std::size_t lanes = 16;
    /// Floats of the rows of one hair with `stride` vertices, which is a multiple of 16.
    static constexpr std::size_t size(std::size_t stride) { return rows * stride; }
};

/// From hairs in lanes, vertex v of lane l at [v * 16 + l].
struct RowArrays {
    static constexpr std::size_t hairs = 4;
    std::size_t stride;   ///< rows to read, and one row more; a multiple of 16
    std::size_t lane;     ///< of the first of four hairs
    const float* in[15];  ///< coordinates of base, U, V, W and normals
    float* out;           ///< StrandRows of the four, one after another
};

struct StrandArrays {
    std::size_t vertices;  ///< of each member
    const float* rows;     ///< StrandRows
    std::size_t members;
    const float* across;  ///< one a member
    const float* up;
    const float* lift;
    // What all members share, up to `stride` vertices.
    const float* widths;
    const float* colours;  ///< four a vertex
    // Out: member after member.
    float* points;
    float* normals;
    float* widthsOut;
    float* coloursOut;
    bool past;  ///< past the caches
};

#define WHORL_STRAND_KERNELS(level)                                                         \
    namespace level {                                                                       \
    void strandRows(const RowArrays& arrays);                                               \
    /* Normals of members are those of the base hair, across the member's own direction. */ \
    void strandMembers(const StrandArrays& arrays);                                         \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_STRAND_KERNELS)
#undef WHORL_STRAND_KERNELS

}  // namespace whorl
