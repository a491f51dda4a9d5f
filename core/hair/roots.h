// SPDX-License-Identifier: Apache-2.0
// The places that hairs grow from.
#pragma once

#include "core/hair/generate.h"
#include "core/sampling/density.h"
#include "core/sampling/sub_triangle_sampler.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace whorl {

/// One root and the frame there.
struct HairRoot {
    std::uint32_t id = 0;  ///< index of the hair in the whole groom
    SurfacePoint point{};
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
    glm::vec2 uv{0.0f};
    std::uint8_t group = 0;
};

/// What roots are drawn from: stratum i of `count` for hair i.
struct RootSource {
    const SurfaceMesh& mesh;
    const SubTriangleSampler& sampler;
    const DensityLookup& density;
    std::uint32_t count;
    std::uint32_t seed;
};

/// The root of hair `id`.
HairRoot rootOf(const RootSource& source, std::uint32_t id);

/// Roots of the hairs in `range` in order; those on places of no density are left out. Fewer when cancelled.
std::vector<HairRoot> makeRoots(const RootSource& source, HairRange range, Progress& progress);

}  // namespace whorl
