// SPDX-License-Identifier: Apache-2.0
// The surface laid out along a line, so that neighbours on the line are neighbours on the surface.
#pragma once

#include "core/model/surface_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Triangles in Hilbert order on a line of 2^32 - 1 units, each as long as its share of the area. Depends on the mesh
/// and on which triangles grow hair only where these are less than a 64th of the area: then the line holds no others,
/// so that hair on a small head over a large floor does not run out of units. Immutable; any thread.
class SurfaceCurve {
public:
    static constexpr std::uint32_t end = 0xffffffffu;

    SurfaceCurve() = default;
    /// `grows`: one a triangle, zero for those that grow no hair.
    SurfaceCurve(const SurfaceMesh& mesh, std::span<const std::uint8_t> grows);

    /// Triangles on the line: those with less area than half a unit may have no room.
    std::size_t count() const { return m_triangles.size(); }
    bool empty() const { return m_triangles.empty(); }
    /// Triangles of the mesh, in order.
    std::span<const std::uint32_t> triangles() const { return m_triangles; }
    /// Where they begin: count + 1 entries, the last is `end`.
    std::span<const std::uint32_t> begins() const { return m_begins; }
    /// See shareOfTriangle.
    std::span<const std::uint32_t> reciprocals() const { return m_reciprocals; }
    std::uint32_t width(std::size_t place) const { return m_begins[place + 1] - m_begins[place]; }
    /// The place in the order of the triangle that holds a unit below `end`. Not for empty ones.
    std::size_t placeAt(std::uint32_t unit) const;
    /// True when a new one for this mesh, which is that of this one, would be the same: also when other triangles grow
    /// hair, as long as they are enough.
    bool serves(const SurfaceMesh& mesh, std::span<const std::uint8_t> grows) const;
    std::size_t memoryBytes() const;

private:
    std::vector<std::uint32_t> m_triangles;
    std::vector<std::uint32_t> m_begins;
    std::vector<std::uint32_t> m_reciprocals;
    bool m_whole = true;
};

}  // namespace whorl
