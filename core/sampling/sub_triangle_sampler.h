// SPDX-License-Identifier: Apache-2.0
// Random roots by the sub-triangle distribution of seed 000 (Sik, section 3).
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/sampling/density.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

struct SubTrianglePlace;

/// The distribution: triangles are subdivided 1:4 until at most one texel of the density map falls on a sub-triangle,
/// each weighs area x density at its barycentre, equal siblings are merged into their parent, and the cumulative
/// weights carry a uniform grid over their codomain that narrows the bisection. Immutable once built.
class SubTriangleSampler {
public:
    /// 12 bytes a sub-triangle, as in the paper.
    struct SubTriangle {
        std::uint32_t triangle;
        std::uint32_t position;  ///< index in the shared position table, i = 4 (parent + 1) + j; ~0 = whole triangle
        float weight;
    };

    struct Options {
        float gridPercent = 100.0f;  ///< cells of the grid as a share of the sub-triangles, 0 to 400; 0: bisection only
        int maxDepth = 10;           ///< caps subdivision (4^10 sub-triangles of one triangle); at most 10
        std::uint32_t maxSubTriangles = 64u << 20;  ///< depth is lowered where this would be passed
    };

    /// Triangles in Hilbert order of their centres, so that consecutive strata are neighbours on the surface.
    /// Fails only when cancelled. Zero density everywhere gives an empty sampler.
    static Result<SubTriangleSampler> build(const SurfaceMesh& mesh, const DensityLookup& density,
                                            const Options& options, Progress& progress);

    /// Total weight: area x density over the surface. Zero: `sample` must not be called.
    double total() const { return m_total; }
    bool empty() const { return m_subTriangles.empty() || m_total <= 0.0; }
    std::span<const SubTriangle> subTriangles() const { return m_subTriangles; }
    std::size_t memoryBytes() const;

    /// The place for numbers in [0, 1): `selection` picks the sub-triangle, `a` and `b` the place in it
    /// (u = 1 - sqrt(a), v = b sqrt(a)).
    SurfacePoint sample(double selection, float a, float b) const;
    /// The same by bisection over the whole distribution, without the grid: baseline.
    SurfacePoint sampleByBisection(double selection, float a, float b) const;

    /// The root of hair `index` of `count`: stratum `index` of the distribution, jittered by a counter-based hash of
    /// (seed, index). Neighbouring indices are neighbours on the surface, so ranges of indices are compact parts.
    SurfacePoint stratifiedRoot(std::uint64_t index, std::uint64_t count, std::uint32_t seed) const;

    /// Index of the sub-triangle that `selection` in [0, 1) picks.
    std::size_t select(double selection) const;
    /// A place in that sub-triangle, uniform for uniform `a` and `b`.
    SurfacePoint place(std::size_t subTriangle, float a, float b) const;

private:
    std::size_t find(double weight, std::size_t begin, std::size_t end) const;
    std::size_t cellOf(double weight) const;
    void buildDistribution(float gridPercent);

    std::vector<SubTriangle> m_subTriangles;
    std::vector<double> m_cumulative;
    std::vector<std::uint32_t> m_grid;  // first candidate of each cell, one more entry at the end
    double m_cellsPerWeight = 0.0;
    double m_total = 0.0;
    const SubTrianglePlace* m_places = nullptr;  // the shared position table
};

/// Rejection sampling (seed 000, section 3.4.1): triangle by area, uniform place, accepted with probability density /
/// maxDensity. Baseline of tests and benchmarks. Empty when nothing grows; fewer than asked for when hardly anything
/// is accepted.
std::vector<SurfacePoint> rejectionSample(const SurfaceMesh& mesh, const DensityLookup& density, std::size_t count,
                                          std::uint32_t seed);

/// Guide roots: `count` places that follow the density and keep their distance from each other (weighted sample
/// elimination, Yuksel 2015, from a stratified pool). Fewer when the surface has none; deterministic.
Result<std::vector<SurfacePoint>> evenRoots(const SurfaceMesh& mesh, const SubTriangleSampler& sampler,
                                            std::size_t count, std::uint32_t seed, Progress& progress);

}  // namespace whorl
