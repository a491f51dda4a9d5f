// SPDX-License-Identifier: Apache-2.0
#include "core/field/front.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

using Size = std::size_t;

/// One column times a number, off another one.
void takeOne(Size count, const double* __restrict sr, const double* __restrict si, double fr, double fi,
             double* __restrict tr, double* __restrict ti) {
    for (Size i = 0; i < count; ++i) {
        tr[i] -= sr[i] * fr - si[i] * fi;
        ti[i] -= sr[i] * fi + si[i] * fr;
    }
}

/// Four columns times four numbers each, off two others.
void takeFour(Size count, const double* __restrict ar, const double* __restrict ai, const double* __restrict br,
              const double* __restrict bi, const double* __restrict cr, const double* __restrict ci,
              const double* __restrict dr, const double* __restrict di, const double* f, const double* g,
              double* __restrict tr, double* __restrict ti, double* __restrict ur, double* __restrict ui) {
    const double f0 = f[0], f1 = f[1], f2 = f[2], f3 = f[3], f4 = f[4], f5 = f[5], f6 = f[6], f7 = f[7];
    const double g0 = g[0], g1 = g[1], g2 = g[2], g3 = g[3], g4 = g[4], g5 = g[5], g6 = g[6], g7 = g[7];
    for (Size i = 0; i < count; ++i) {
        tr[i] -= ((ar[i] * f0 - ai[i] * f1) + (br[i] * f2 - bi[i] * f3)) +
                 ((cr[i] * f4 - ci[i] * f5) + (dr[i] * f6 - di[i] * f7));
        ti[i] -= ((ar[i] * f1 + ai[i] * f0) + (br[i] * f3 + bi[i] * f2)) +
                 ((cr[i] * f5 + ci[i] * f4) + (dr[i] * f7 + di[i] * f6));
        ur[i] -= ((ar[i] * g0 - ai[i] * g1) + (br[i] * g2 - bi[i] * g3)) +
                 ((cr[i] * g4 - ci[i] * g5) + (dr[i] * g6 - di[i] * g7));
        ui[i] -= ((ar[i] * g1 + ai[i] * g0) + (br[i] * g3 + bi[i] * g2)) +
                 ((cr[i] * g5 + ci[i] * g4) + (dr[i] * g7 + di[i] * g6));
    }
}

void scale(Size count, double factor, double* __restrict r, double* __restrict i) {
    for (Size k = 0; k < count; ++k) {
        r[k] *= factor;
        i[k] *= factor;
    }
}

/// Where the column's number in row `row` is.
double* realOf(const FrontColumns& f, Size column, Size row) {
    return column < f.pivots ? f.pivotReal + column * f.pivotStride + row
                             : f.restReal + (column - f.pivots) * f.restStride + (row - f.pivots);
}
double* imaginaryOf(const FrontColumns& f, Size column, Size row) {
    return column < f.pivots ? f.pivotImaginary + column * f.pivotStride + row
                             : f.restImaginary + (column - f.pivots) * f.restStride + (row - f.pivots);
}

}  // namespace

void frontEliminate(const FrontColumns& f, Size first, Size last, double least) {
    const Size rows = f.pivots + f.rest;
    for (Size j = first; j < last; ++j) {
        double* real = realOf(f, j, j);
        double* imaginary = imaginaryOf(f, j, j);
        for (Size k = first; k < j; ++k) {
            const double* sr = realOf(f, k, j);
            const double* si = imaginaryOf(f, k, j);
            takeOne(rows - j, sr, si, sr[0], -si[0], real, imaginary);
        }
        const double pivot = __builtin_sqrt(real[0] > least ? real[0] : least);
        real[0] = pivot;
        imaginary[0] = 0.0;
        scale(rows - j - 1, 1.0 / pivot, real + 1, imaginary + 1);
    }
}

void frontSubtract(const FrontColumns& f, Size first, Size last, Size from, Size to) {
    const Size rows = f.pivots + f.rest;
    Size j = from;
    for (; j + 2 <= to; j += 2) {
        // Both from the same row on: the second one's first number lies above the diagonal. A pair does not straddle
        // pivots and rest.
        if (j + 1 == f.pivots) {
            for (Size k = first; k < last; ++k) {
                const double* sr = realOf(f, k, j);
                const double* si = imaginaryOf(f, k, j);
                takeOne(rows - j, sr, si, sr[0], -si[0], realOf(f, j, j), imaginaryOf(f, j, j));
            }
            --j;
            continue;
        }
        Size k = first;
        for (; k + 4 <= last; k += 4) {
            double one[8], two[8];
            const double* sr[4];
            const double* si[4];
            for (Size c = 0; c < 4; ++c) {
                sr[c] = realOf(f, k + c, j);
                si[c] = imaginaryOf(f, k + c, j);
                one[2 * c] = sr[c][0];
                one[2 * c + 1] = -si[c][0];
                two[2 * c] = sr[c][1];
                two[2 * c + 1] = -si[c][1];
            }
            takeFour(rows - j, sr[0], si[0], sr[1], si[1], sr[2], si[2], sr[3], si[3], one, two, realOf(f, j, j),
                     imaginaryOf(f, j, j), realOf(f, j + 1, j), imaginaryOf(f, j + 1, j));
        }
        for (; k < last; ++k) {
            const double* sr = realOf(f, k, j);
            const double* si = imaginaryOf(f, k, j);
            takeOne(rows - j, sr, si, sr[0], -si[0], realOf(f, j, j), imaginaryOf(f, j, j));
            takeOne(rows - j - 1, sr + 1, si + 1, sr[1], -si[1], realOf(f, j + 1, j + 1), imaginaryOf(f, j + 1, j + 1));
        }
    }
    for (; j < to; ++j) {
        for (Size k = first; k < last; ++k) {
            const double* sr = realOf(f, k, j);
            const double* si = imaginaryOf(f, k, j);
            takeOne(rows - j, sr, si, sr[0], -si[0], realOf(f, j, j), imaginaryOf(f, j, j));
        }
    }
}

void frontForward(const FrontColumns& f, double* real, double* imaginary) {
    const Size rows = f.pivots + f.rest;
    for (Size j = 0; j < f.pivots; ++j) {
        const double* sr = realOf(f, j, j);
        const double* si = imaginaryOf(f, j, j);
        real[j] /= sr[0];
        imaginary[j] /= sr[0];
        takeOne(rows - j - 1, sr + 1, si + 1, real[j], imaginary[j], real + j + 1, imaginary + j + 1);
    }
}

void frontBackward(const FrontColumns& f, double* real, double* imaginary) {
    const Size rows = f.pivots + f.rest;
    for (Size j = f.pivots; j-- > 0;) {
        const double* sr = realOf(f, j, 0);
        const double* si = imaginaryOf(f, j, 0);
        // Eight sums, so that lanes work side by side in every instruction set in the same order.
        double sumsReal[8] = {}, sumsImaginary[8] = {};
        Size i = j + 1;
        for (; i + 8 <= rows; i += 8) {
            for (Size lane = 0; lane < 8; ++lane) {
                sumsReal[lane] += sr[i + lane] * real[i + lane] + si[i + lane] * imaginary[i + lane];
                sumsImaginary[lane] += sr[i + lane] * imaginary[i + lane] - si[i + lane] * real[i + lane];
            }
        }
        double sumReal = 0.0, sumImaginary = 0.0;
        for (; i < rows; ++i) {
            sumReal += sr[i] * real[i] + si[i] * imaginary[i];
            sumImaginary += sr[i] * imaginary[i] - si[i] * real[i];
        }
        for (Size lane = 0; lane < 8; ++lane) {
            sumReal += sumsReal[lane];
            sumImaginary += sumsImaginary[lane];
        }
        real[j] = (real[j] - sumReal) / sr[j];
        imaginary[j] = (imaginary[j] - sumImaginary) / sr[j];
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
