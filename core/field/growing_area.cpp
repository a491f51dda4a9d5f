// SPDX-License-Identifier: Apache-2.0
#include "core/field/growing_area.h"

#include "core/sampling/density.h"

namespace whorl {

std::vector<std::uint8_t> growingTriangles(const Groom& groom) {
    constexpr float third = 1.0f / 3.0f;
    const SurfacePoint places[] = {{0, 0.0f, 0.0f}, {0, 1.0f, 0.0f}, {0, 0.0f, 1.0f},  {0, 0.5f, 0.0f},
                                   {0, 0.0f, 0.5f}, {0, 0.5f, 0.5f}, {0, third, third}};
    const DensityLookup density(groom);
    const SurfaceMesh& mesh = *groom.mesh;
    std::vector<std::uint8_t> grows(mesh.triangleCount(), 0);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        for (SurfacePoint place : places) {
            place.triangle = t;
            if (!density.growsAt(mesh, place)) continue;
            grows[t] = 1;
            break;
        }
    }
    return grows;
}

}  // namespace whorl
