// SPDX-License-Identifier: Apache-2.0
// Are roots spread as the density asks? Counted in bins that know nothing of the sampler.
#pragma once

#include "core/model/groom.h"
#include "core/sampling/root_sampler.h"

#include <cstdint>
#include <vector>

namespace whorl::testing {

enum class Paint { White, Noise, Ramp, Checks, Blot };
/// A square 8-bit density map. Ramp: black on the left, white on the right. Checks and Blot: black and white.
Map painted(Paint paint, int size);

/// How many standard deviations chi-square lies above its mean (Wilson and Hilferty's cube root). Bins are pooled until
/// at least 20 are expected. Counts that are too even give a number below zero.
double chiSquareExcess(const std::vector<double>& expected, const std::vector<double>& found);

/// Every triangle of a groom in the pieces that the samplers look at; expected in each: area x density at its centre.
class FineBins {
public:
    explicit FineBins(const Groom& groom);
    /// Sum of area x density.
    double total() const { return m_total; }
    void add(const SurfacePoint& root);
    /// Roots in pieces whose density is zero.
    std::uint64_t foundWhereNothingGrows() const;
    std::uint64_t foundOn(std::size_t triangle) const;
    double chiSquareExcess() const;
    /// Chi-square over the number of bins, each pooled until `pooled` roots are expected: 1 by chance, less where roots
    /// are more even, and (share by which bins are off)^2 x `pooled` more where they are not where they should be.
    double chiSquarePerBin(double pooled) const;

private:
    std::vector<int> m_depths;            // by triangle
    std::vector<std::size_t> m_firstBin;  // by triangle, one more at the end
    std::vector<double> m_weights;
    std::vector<double> m_found;
    double m_total = 0.0;
};

/// A new groom on `mesh` whose density is `map`.
Groom densityGroom(SurfaceMesh mesh, Map map);
/// The sampler of its hair.
RootSampler samplerOf(const Groom& groom);

}  // namespace whorl::testing
