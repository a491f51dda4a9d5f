// SPDX-License-Identifier: Apache-2.0
#include "core/hair/frame_steps.h"
#include "core/hair/shape.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using namespace frame_steps;

void frameHairs(const FrameArrays& a) {
    Vectors tangent, before, normal;
    for (int l = 0; l < lanes; ++l) {
        normal.x[l] = tangent.x[l] = a.surfaceX[l];
        normal.y[l] = tangent.y[l] = a.surfaceY[l];
        normal.z[l] = tangent.z[l] = a.surfaceZ[l];
    }
    for (std::size_t v = 0; v < a.vertices; ++v) {
        const std::size_t here = v * lanes, next = here + lanes, last = v > 0 ? here - lanes : here;
        before = tangent;
        tangents(a.x + last, a.y + last, a.z + last, a.x + next, a.y + next, a.z + next, tangent);
        if (v > 0) {
            reflectTwice(a.x + last, a.y + last, a.z + last, a.x + here, a.y + here, a.z + here, before, tangent,
                         normal);
        }
        straighten(tangent, normal, v > 0 ? 1e-6f : 1e-4f);
        for (int l = 0; l < lanes; ++l) {
            a.normalX[here + static_cast<std::size_t>(l)] = normal.x[l];
            a.normalY[here + static_cast<std::size_t>(l)] = normal.y[l];
            a.normalZ[here + static_cast<std::size_t>(l)] = normal.z[l];
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
