// SPDX-License-Identifier: Apache-2.0
// Where hairs grow: an endless sequence of places, thinned by the density.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/map_changes.h"
#include "core/sampling/candidates.h"
#include "core/sampling/density_codes.h"
#include "core/sampling/even_sequence.h"
#include "core/sampling/root_list.h"
#include "core/sampling/surface_curve.h"
#include "core/sampling/uv_cells.h"

#include <array>
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

/// Ids of hairs that keep apart have this bit: their numbers in another sequence (EvenSequence).
inline constexpr std::uint32_t evenId = 0x80000000u;
/// The number without that bit, which other programs can take as a signed one: unique in the hair's group.
inline constexpr std::uint32_t numberOf(std::uint32_t id) {
    return id & ~evenId;
}

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
    /// What is asked for on each triangle of a mesh of `triangleCount`: shares of all, or zeros when empty.
    std::vector<double> sharesByTriangle(std::size_t triangleCount) const;

    /// Where hairs keep apart, makes ready what `sample` needs for a request: to be called outside of parallel loops,
    /// since it takes long the first time. Cancelled: not ready.
    void prepare(const RootRequest& request, Progress& progress) const;

    /// Appends the roots in a range, in order of the curve. Where some groups keep hairs apart and others do not, roots
    /// of both kinds; those with `evenId` are for the groups that do, the others for those that do not.
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

    // Which sequence roots come from.
    enum class Spread : std::uint8_t { Plain, Even, Mixed };
    // By density code: candidates below are hairs.
    using Limits = std::array<std::uint32_t, 256>;
    Limits limitsOf(double rate) const;
    void sampleAs(Spread spread, const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                  std::vector<std::size_t>& ends) const;
    void samplePlain(const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                     std::vector<std::size_t>& ends) const;
    void sampleEven(const RootRequest& request, std::span<const RootRange> ranges, RootList& roots,
                    std::vector<std::size_t>& ends) const;
    // By place on the curve and share of its triangle.
    std::uint8_t codeAt(std::size_t place, std::uint32_t share) const;
    Candidate evenCandidate(std::uint32_t seed, std::uint32_t rank) const;
    std::shared_ptr<const EvenSequence> evenFor(const RootRequest& request, bool alone, Progress& progress) const;
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
    int m_allowed = maxDepth;      // depth of no triangle is greater
    std::uint8_t m_brightest = 0;  // largest code of all
    Spread m_spread = Spread::Plain;
    std::shared_ptr<EvenSequences> m_even;  // null when Plain
    // Made by the first update.
    std::shared_ptr<const UvCells> m_cells;
    BorderedTexels m_texels;
};

CandidateKeys candidateKeys(std::uint32_t seed);

}  // namespace whorl
