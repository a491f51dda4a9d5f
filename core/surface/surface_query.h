// SPDX-License-Identifier: Apache-2.0
// Rays and nearest points on the mesh, by Embree.
#pragma once

#include "core/base/cow.h"
#include "core/surface/surface_point.h"

#include <memory>
#include <optional>

namespace whorl {

struct SurfaceHit {
    SurfacePoint point;
    glm::vec3 position{0.0f};
    float distance = 0.0f;  ///< metres along the ray, or to the query point
};

/// Immutable once made; any number of threads may ask.
class SurfaceQuery {
public:
    explicit SurfaceQuery(Cow<SurfaceMesh> mesh);
    ~SurfaceQuery();
    SurfaceQuery(const SurfaceQuery&) = delete;
    SurfaceQuery& operator=(const SurfaceQuery&) = delete;

    const SurfaceMesh& mesh() const { return *m_mesh; }

    /// First triangle that the ray meets, both sides count. `direction` need not be unit length; distance is in metres.
    std::optional<SurfaceHit> raycast(const glm::vec3& origin, const glm::vec3& direction,
                                      float maxDistance = 1e30f) const;
    /// Nearest place within `maxDistance`; ties go to the lowest triangle. Exact (computed in our own arithmetic), so
    /// the answer is the same on every machine.
    std::optional<SurfaceHit> nearest(const glm::vec3& position, float maxDistance = 1e30f) const;

private:
    Cow<SurfaceMesh> m_mesh;
    void* m_device = nullptr;
    void* m_scene = nullptr;
};

}  // namespace whorl
