// SPDX-License-Identifier: Apache-2.0
// How alike two rows of numbers are.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace whorl {

/// Pearson's, -1 to 1; 0 where either is constant. As many of one as of the other.
inline double correlation(std::span<const double> a, std::span<const double> b) {
    const auto n = static_cast<double>(a.size());
    double meanA = 0.0, meanB = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        meanA += a[i] / n;
        meanB += b[i] / n;
    }
    double squaresA = 0.0, squaresB = 0.0, products = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        squaresA += (a[i] - meanA) * (a[i] - meanA);
        squaresB += (b[i] - meanB) * (b[i] - meanB);
        products += (a[i] - meanA) * (b[i] - meanB);
    }
    return squaresA > 0.0 && squaresB > 0.0 ? products / std::sqrt(squaresA * squaresB) : 0.0;
}

}  // namespace whorl
