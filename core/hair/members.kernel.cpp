// SPDX-License-Identifier: Apache-2.0
#include "core/hair/members.kernel.h"

#include "core/base/polynomials.h"
#include "core/hair/frame_steps.h"
#include "core/hair/modifiers/turns.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = MemberArrays::lanes;
using frame_steps::Vectors;

}  // namespace

void strandAxes(const MemberArrays& a) {
    Vectors tangent;
    for (std::size_t l = 0; l < lanes; ++l) {
        tangent.x[l] = a.surfaceX[l];
        tangent.y[l] = a.surfaceY[l];
        tangent.z[l] = a.surfaceZ[l];
    }
    for (std::size_t vertex = 0; vertex < a.vertices; ++vertex) {
        const std::size_t here = vertex * lanes, last = vertex > 0 ? here - lanes : here,
                          next = vertex + 1 < a.vertices ? here + lanes : here;
        frame_steps::tangents(a.x + last, a.y + last, a.z + last, a.x + next, a.y + next, a.z + next, tangent);
        const float along = a.along[vertex];
        // From root to centre to tip, level at all three.
        const float first = smoothStep(2.0f * along), second = smoothStep(2.0f * along - 1.0f);
        const float held = 1.0f - a.ease[vertex], lifted = along * along;
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = here + l;
            const float nx = a.normalX[i], ny = a.normalY[i], nz = a.normalZ[i];
            const float bx = tangent.y[l] * nz - tangent.z[l] * ny, by = tangent.z[l] * nx - tangent.x[l] * nz,
                        bz = tangent.x[l] * ny - tangent.y[l] * nx;
            const float splay = a.rootSplay[l] + (a.centreSplay[l] - a.rootSplay[l]) * first +
                                (a.tipSplay[l] - a.centreSplay[l]) * second;
            const TurnSinCos turn = sinCosOfTurns(a.twist[l] * along);
            const float c = splay * turn.cos, s = splay * turn.sin;
            float ux = c * bx + s * nx, uy = c * by + s * ny, uz = c * bz + s * nz;
            float vx = c * nx - s * bx, vy = c * ny - s * by, vz = c * nz - s * bz;
            // Roots stay on the skin: near them nothing goes along its normal.
            const float hx = a.surfaceX[l], hy = a.surfaceY[l], hz = a.surfaceZ[l];
            const float uHigh = held * (ux * hx + uy * hy + uz * hz), vHigh = held * (vx * hx + vy * hy + vz * hz);
            a.u[0][i] = ux - uHigh * hx;
            a.u[1][i] = uy - uHigh * hy;
            a.u[2][i] = uz - uHigh * hz;
            a.v[0][i] = vx - vHigh * hx;
            a.v[1][i] = vy - vHigh * hy;
            a.v[2][i] = vz - vHigh * hz;
            const float lift = a.offset[l] * lifted;
            a.w[0][i] = lift * nx;
            a.w[1][i] = lift * ny;
            a.w[2][i] = lift * nz;
        }
    }
}

void strandMembers(const MemberPoints& a) {
    for (int axis = 0; axis < 3; ++axis) {
        const float *base = a.base[axis], *u = a.u[axis], *v = a.v[axis], *w = a.w[axis];
        float* point = a.point[axis];
        for (std::size_t row = 0; row < (a.vertices + 1) * lanes; row += lanes)
            for (std::size_t l = 0; l < lanes; ++l)
                point[row + l] =
                    base[row + l] + a.across[l] * u[row + l] + a.up[l] * v[row + l] + a.lift[l] * w[row + l];
    }
    Vectors tangent = {}, normal;
    for (std::size_t vertex = 0; vertex < a.vertices; ++vertex) {
        const std::size_t here = vertex * lanes, last = vertex > 0 ? here - lanes : here, next = here + lanes;
        frame_steps::tangents(a.point[0] + last, a.point[1] + last, a.point[2] + last, a.point[0] + next,
                              a.point[1] + next, a.point[2] + next, tangent);
        for (std::size_t l = 0; l < lanes; ++l) {
            normal.x[l] = a.normal[0][here + l];
            normal.y[l] = a.normal[1][here + l];
            normal.z[l] = a.normal[2][here + l];
        }
        frame_steps::straighten(tangent, normal, 1e-6f);
        for (std::size_t l = 0; l < lanes; ++l) {
            a.pointNormal[0][here + l] = normal.x[l];
            a.pointNormal[1][here + l] = normal.y[l];
            a.pointNormal[2][here + l] = normal.z[l];
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
