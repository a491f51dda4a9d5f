// SPDX-License-Identifier: Apache-2.0
// Straight ways over triangles.
#pragma once

#include "core/surface/adjacency.h"

#include <glm/vec3.hpp>

namespace whorl {

class SurfaceWalk {
public:
    explicit SurfaceWalk(const SurfaceMesh& mesh);

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
    std::vector<std::array<std::uint32_t, 3>> m_across;
};

}  // namespace whorl
