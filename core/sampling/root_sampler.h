// SPDX-License-Identifier: Apache-2.0
// Where hairs grow: an endless sequence of places, thinned by the density.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/map_changes.h"
#include "core/sampling/candidates.h"
#include "core/sampling/density_codes.h"
#include "core/sampling/root_list.h"
#include "core/sampling/surface_curve.h"
#include "core/sampling/uv_cells.h"

#include <memory>
#include <span>
#include <vector>

namespace whorl {

/// A piece of the surface: units [first, last) of the curve.
struct RootRange {
    std::uint32_t first = 0;
    std::uint32_t last = SurfaceCurve::end;
    bool operator==(const RootRange&) const = default;
};

/// How many hairs are asked for: candidate i of the sequence of `seed` (see candidates.h) is a hair where i is below
/// `rate` x density at its place. So fewer hairs are a true subset of more, and any prefix is spread as well as all.
struct RootRequest {
    double rate = 0.0;  ///< hairs on the whole surface were the density 1 everywhere
    std::uint32_t seed = 1;
    bool operator==(const RootRequest&) const = default;
};

/// The density of all places of a surface: triangles are subdivided 1:4 as the reference's are (see
/// sub_triangle_sampler.h), with one byte a piece. No piece depends on another, so paint moves no hair but under the
/// brush. Immutable but for `update`; any thread.
class RootSampler {
public:
    static constexpr int maxDepth = 10;
    static constexpr std::uint64_t maxPieces = 64u << 20;

    RootSampler() = default;
    /// Fails only when cancelled. `earlier`: a sampler of the same mesh, whose curve is used again if it serves.
    static Result<RootSampler> build(const Groom& groom, const DensityLookup& density, Progress& progress,
                                     const RootSampler* earlier = nullptr);

    /// Makes this sampler, of the groom as it was, that of `groom`, which differs as far as density minds in texels of
    /// `maps` only (see sameDensity): measures the triangles under those texels, all the rest stays. The same as
    /// building it anew. `touched`: the places on the curve, ascending, where roots may have come or gone or changed
    /// their group. False, and nothing is changed, when it has to be built anew.
    bool update(const Groom& groom, const DensityLookup& density, const TouchedMaps& maps,
                std::vector<std::uint32_t>& touched);

    /// Density of the whole surface on average, including what grows nothing: a request of rate n / weight() gives n
    /// hairs, exactly where the density is the same everywhere, else with less spread than chance has.
    double weight() const { return m_weight; }
    /// About the same, such that rate `hairs` / this gives that number, but for candidates that become hairs at the
    /// same rate. More than a million are not counted: this is weight(). Fewer hairs stay a subset of more. The same on
    /// any number of threads.
    float weightFor(double hairs, std::uint32_t seed) const;
    bool empty() const { return !(m_weight > 0.0); }

    /// Appends the roots in a range, in order of the curve.
    void sample(const RootRequest& request, RootRange range, RootList& roots) const;
    /// The same for several ranges, one after another. `ends`: the count of `roots` after each.
    void sample(const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                std::vector<std::size_t>& ends) const;

    /// Where to cut the line so that `share` (0 to 1) of the weight lies before.
    std::uint32_t cut(double share) const;
    /// Weight before a unit, as a share of all; 0 when there is none.
    double shareBefore(std::uint32_t unit) const;
    /// Part `index` of `count`, which cover the line: compact, of equal weight. Empty when there is no such part.
    RootRange part(std::uint32_t index, std::uint32_t count) const;

    /// One candidate and the density that it meets, by plain arithmetic. Not when empty.
    struct Candidate {
        SurfacePoint point{};
        std::uint32_t unit = 0;
        std::uint8_t code = 0;  ///< see densityCode
    };
    Candidate candidate(std::uint32_t seed, std::uint32_t index) const;
    /// Candidates below this are hairs where the density has that code.
    std::uint32_t limitOf(std::uint8_t code, double rate) const;
    /// Density that a code stands for.
    double densityOf(std::uint8_t code) const;

    const SurfaceCurve& curve() const { return *m_curve; }
    std::size_t pieceCount() const { return m_codes.size() - m_lost; }
    /// With the curve.
    std::size_t memoryBytes() const;

private:
    void summarise(std::size_t place);
    void sumUp(std::size_t block);
    void sumUp();
    void store(std::size_t place, int depth, std::span<const std::uint8_t> codes);
    void closeGaps();
    double weightOf(std::size_t place) const;

    std::shared_ptr<const SurfaceCurve> m_curve = std::make_shared<SurfaceCurve>();
    // By place on the curve.
    std::vector<std::uint32_t> m_firstCode;
    std::vector<std::uint8_t> m_depths;
    std::vector<std::uint8_t> m_most;
    std::vector<float> m_means;  // mean of (code / 255)^2
    std::vector<std::uint8_t> m_codes;
    std::size_t m_lost = 0;        // of m_codes, what updates left behind
    std::vector<double> m_sums;    // weight of every 64 triangles
    std::vector<double> m_before;  // weight before every 64th triangle, and of all
    double m_scale = 0.0;          // density of code 255
    double m_weight = 0.0;
    int m_allowed = maxDepth;  // depth of no triangle is greater
    // Made by the first update.
    std::shared_ptr<const UvCells> m_cells;
    BorderedTexels m_texels;
};

CandidateKeys candidateKeys(std::uint32_t seed);

}  // namespace whorl
