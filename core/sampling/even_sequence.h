// SPDX-License-Identifier: Apache-2.0
// An endless sequence of places that keep apart from each other.
#pragma once

#include "core/base/progress.h"
#include "core/sampling/surface_curve.h"

#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace whorl {

/// Relaxed dart throwing (McCool and Fiume, "Hierarchical Poisson disk sampling distributions", 1992): of the sequence
/// of candidates (see candidates.h) dart t = 1, 2, ... is kept when no dart kept before it is nearer than sqrt(`reach`
/// x area / t). So the places of every beginning keep apart, about as well as the beginning is long, and a longer one
/// only adds. Distances are straight; two sides of a thin ear do not mind each other. Depends on the mesh, the curve
/// and the seed only, on nothing painted. Immutable; any thread.
class EvenSequence {
public:
    static constexpr double reach = 3.0;
    /// Longer ones are not made.
    static constexpr std::uint32_t most = 1u << 24;

    struct Place {
        std::uint32_t unit;  ///< on the curve
        std::uint32_t rank;  ///< in the sequence
        std::uint32_t triangle;
        std::uint32_t share;  ///< of the way through the triangle: see placeInTriangle
    };

    /// The first `count` places (fewer for a mesh without area, or when cancelled). `alone`: in this thread only.
    EvenSequence(const SurfaceMesh& mesh, const SurfaceCurve& curve, std::uint32_t seed, std::uint32_t count,
                 bool alone, Progress& progress);

    std::uint32_t count() const { return static_cast<std::uint32_t>(m_places.size()); }
    /// In order of the curve.
    std::span<const Place> places() const { return m_places; }
    std::size_t memoryBytes() const { return m_places.capacity() * sizeof(Place); }

private:
    std::vector<Place> m_places;
};

/// The newest sequence on one curve, made longer when more of it is asked for. Any number of threads.
class EvenSequences {
public:
    EvenSequences(std::shared_ptr<const SurfaceMesh> mesh, std::shared_ptr<const SurfaceCurve> curve)
        : m_mesh(std::move(mesh)), m_curve(std::move(curve)) {}
    const SurfaceCurve* curve() const { return m_curve.get(); }
    /// At least the first `count` places of the sequence of that seed (`EvenSequence::most` at most). `alone`: made in
    /// this thread only, as it has to be inside of parallel loops. Cancelled: shorter, and not kept.
    std::shared_ptr<const EvenSequence> get(std::uint32_t seed, double count, bool alone, Progress& progress);
    std::size_t memoryBytes();

private:
    std::shared_ptr<const SurfaceMesh> m_mesh;
    std::shared_ptr<const SurfaceCurve> m_curve;
    std::mutex m_mutex;
    std::shared_ptr<const EvenSequence> m_newest;
    std::uint32_t m_seed = 0;
    double m_asked = 0.0;
};

}  // namespace whorl
