// SPDX-License-Identifier: Apache-2.0
// Places for the middles of locks, spread over a group by area.
#pragma once

#include "core/base/progress.h"
#include "core/hair/roots.h"
#include "core/sampling/density.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace whorl {

/// An endless sequence of places on the growing parts of a mesh, of which every beginning is well spread. It does not
/// depend on the density: paint moves no place.
class Scatter {
public:
    Scatter() = default;
    Scatter(const SurfaceMesh& mesh, const DensityLookup& density);
    bool empty() const { return m_triangles.empty(); }

    /// The first `count` places of the sequence of `seed` that lie in the group where it grows hair; fewer when it
    /// covers little of the mesh. `id` of a root is its number in the sequence.
    std::vector<HairRoot> roots(const SurfaceMesh& mesh, const DensityLookup& density, int group, std::size_t count,
                                std::uint32_t seed) const;

private:
    HairRoot root(const SurfaceMesh& mesh, const DensityLookup& density, std::uint32_t index, std::uint32_t seed) const;

    std::vector<std::uint32_t> m_triangles;  // in Hilbert order
    std::vector<double> m_area;              // of all up to and with each
};

}  // namespace whorl
