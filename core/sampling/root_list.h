// SPDX-License-Identifier: Apache-2.0
// Roots as the sampler gives them.
#pragma once

#include "core/model/surface_mesh.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace whorl {

/// Arrays of equal length that grow without being filled first: the sampler writes them once.
class RootList {
public:
    std::size_t count() const { return m_count; }
    const std::uint32_t* ids() const { return m_ids.get(); }
    const std::uint32_t* triangles() const { return m_triangles.get(); }
    const float* u() const { return m_u.get(); }
    const float* v() const { return m_v.get(); }
    std::uint32_t id(std::size_t i) const { return m_ids[i]; }
    /// Where on the curve, when `hasUnits` (else it follows from the id).
    std::uint32_t unit(std::size_t i) const { return m_units[i]; }
    bool hasUnits() const { return !m_units.empty(); }
    SurfacePoint point(std::size_t i) const { return {m_triangles[i], m_u[i], m_v[i]}; }
    /// Keeps the memory.
    void clear() {
        m_count = 0;
        m_units.clear();
    }
    void reserve(std::size_t capacity);

private:
    friend class RootSampler;
    /// For what has room.
    void push(std::uint32_t id, const SurfacePoint& point, std::uint32_t unit) {
        m_ids[m_count] = id;
        m_triangles[m_count] = point.triangle;
        m_u[m_count] = point.u;
        m_v[m_count] = point.v;
        m_units.push_back(unit);
        ++m_count;
    }
    std::unique_ptr<std::uint32_t[]> m_ids, m_triangles;
    std::unique_ptr<float[]> m_u, m_v;
    std::vector<std::uint32_t> m_units;  // empty, or as many
    std::size_t m_capacity = 0;
    std::size_t m_count = 0;
};

}  // namespace whorl
