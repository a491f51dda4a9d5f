// SPDX-License-Identifier: Apache-2.0
// Roots as the sampler gives them.
#pragma once

#include "core/model/surface_mesh.h"

#include <cstddef>
#include <cstdint>
#include <memory>

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
    SurfacePoint point(std::size_t i) const { return {m_triangles[i], m_u[i], m_v[i]}; }
    /// Keeps the memory.
    void clear() { m_count = 0; }
    void reserve(std::size_t capacity);

private:
    friend class RootSampler;
    std::unique_ptr<std::uint32_t[]> m_ids, m_triangles;
    std::unique_ptr<float[]> m_u, m_v;
    std::size_t m_capacity = 0;
    std::size_t m_count = 0;
};

}  // namespace whorl
