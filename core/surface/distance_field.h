// SPDX-License-Identifier: Apache-2.0
// Signed distance to the skin on a grid: what keeps guides and hair outside.
#pragma once

#include "core/base/progress.h"
#include "core/surface/surface_query.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace whorl {

/// Trilinear grid of signed distances, exact at the nodes near the skin (angle-weighted pseudo-normals decide the
/// side; Baerentzen and Aanaes 2005), clamped to the band elsewhere. Immutable; any thread may ask.
/// Open meshes: points are outside unless they are close behind a triangle.
class DistanceField {
public:
    /// `resolution`: nodes along the longest side of the mesh's box (16 to 256). The band is about 6 nodes wide each
    /// way. Same bytes for any number of threads.
    static DistanceField build(const SurfaceQuery& query, int resolution = 128);

    /// Metres, above zero outside; +band beyond the band outside, -band inside.
    float distance(const glm::vec3& p) const;
    /// Unit vector away from the skin; zero where the field is flat.
    glm::vec3 gradient(const glm::vec3& p) const;
    float band() const { return m_band; }
    float spacing() const { return m_spacing; }

private:
    glm::vec3 m_origin{0.0f};
    float m_spacing = 1.0f;
    float m_band = 0.0f;
    int m_size[3] = {0, 0, 0};
    std::vector<float> m_values;
};

}  // namespace whorl
