// SPDX-License-Identifier: Apache-2.0
// Which triangles meet at an edge, and straight ways over them.
#pragma once

#include "core/model/surface_mesh.h"

#include <glm/vec3.hpp>

#include <vector>

namespace whorl {

class SurfaceWalk {
public:
    static constexpr std::uint32_t none = UINT32_MAX;

    explicit SurfaceWalk(const SurfaceMesh& mesh);

    /// Triangle on the other side of the edge from corner `edge` (0 to 2) to the next; `none` at borders and where more
    /// than two meet.
    std::uint32_t across(std::uint32_t triangle, int edge) const {
        return m_across[triangle * 3u + static_cast<std::uint32_t>(edge)];
    }

    struct Step {
        SurfacePoint point;
        glm::vec3 direction{0.0f};  ///< at the end, in the plane of the triangle there; unit
        float walked = 0.0f;        ///< metres; less than asked at borders
    };
    /// Goes `metres` from `from` along the part of `direction` (any length but zero) that lies in the triangle,
    /// straight on where triangles are unfolded over the edges that it crosses: UV seams make no difference. `mesh` is
    /// that of the constructor.
    Step go(const SurfaceMesh& mesh, const SurfacePoint& from, const glm::vec3& direction, float metres) const;

private:
    std::vector<std::uint32_t> m_across;
};

}  // namespace whorl
