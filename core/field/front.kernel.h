// SPDX-License-Identifier: Apache-2.0
// The inner loops of FrontSolver: dense columns of complex numbers, real and imaginary parts apart.
#pragma once

#include "core/base/simd.h"

#include <cstddef>

namespace whorl {

/// Lower triangle of a Hermitian matrix of `pivots` + `rest` rows, column by column. What lies above the diagonal is
/// scratch. Columns of pivots have all rows, `pivotStride` apart; the others only those below the pivots, `restStride`
/// apart.
struct FrontColumns {
    double* pivotReal;
    double* pivotImaginary;
    std::size_t pivotStride;
    double* restReal;
    double* restImaginary;
    std::size_t restStride;
    std::size_t pivots;
    std::size_t rest;
};

/// eliminate: Cholesky's columns `first` to `last` (a panel), after all columns before have been subtracted. Pivots
/// below `least` count as that, so that rounding does no harm.
/// subtract: takes the panel's part off columns `from` to `to`, counted over pivots and rest, all of them after the
/// panel.
/// forward and backward: half of a solution each, with one number a row; pivots all eliminated.
#define WHORL_FRONT(level)                                                                               \
    namespace level {                                                                                    \
    void frontEliminate(const FrontColumns& front, std::size_t first, std::size_t last, double least);   \
    void frontSubtract(const FrontColumns& front, std::size_t first, std::size_t last, std::size_t from, \
                       std::size_t to);                                                                  \
    void frontForward(const FrontColumns& front, double* real, double* imaginary);                       \
    void frontBackward(const FrontColumns& front, double* real, double* imaginary);                      \
    }
WHORL_EACH_SIMD_LEVEL(WHORL_FRONT)
#undef WHORL_FRONT

}  // namespace whorl
