// SPDX-License-Identifier: Apache-2.0
#include "core/hair/members.kernel.h"

#include "core/base/polynomials.h"
#include "core/base/random_lanes.h"
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
        float out[9][lanes];
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = here + l;
            const float nx = a.normalX[i], ny = a.normalY[i], nz = a.normalZ[i];
            const float bx = tangent.y[l] * nz - tangent.z[l] * ny, by = tangent.z[l] * nx - tangent.x[l] * nz,
                        bz = tangent.x[l] * ny - tangent.y[l] * nx;
            const float splay = a.rootSplay[l] + (a.centreSplay[l] - a.rootSplay[l]) * first +
                                (a.tipSplay[l] - a.centreSplay[l]) * second;
            const TurnSinCos turn = sinCosOfTurns(a.twist[l] * along);
            const float c = splay * turn.cos, s = splay * turn.sin;
            const float ux = c * bx + s * nx, uy = c * by + s * ny, uz = c * bz + s * nz;
            const float vx = c * nx - s * bx, vy = c * ny - s * by, vz = c * nz - s * bz;
            // Roots stay on the skin: near them nothing goes along its normal.
            const float hx = a.surfaceX[l], hy = a.surfaceY[l], hz = a.surfaceZ[l];
            const float uHigh = held * (ux * hx + uy * hy + uz * hz), vHigh = held * (vx * hx + vy * hy + vz * hz);
            out[0][l] = ux - uHigh * hx;
            out[1][l] = uy - uHigh * hy;
            out[2][l] = uz - uHigh * hz;
            out[3][l] = vx - vHigh * hx;
            out[4][l] = vy - vHigh * hy;
            out[5][l] = vz - vHigh * hz;
            const float lift = a.offset[l] * lifted;
            out[6][l] = lift * nx;
            out[7][l] = lift * ny;
            out[8][l] = lift * nz;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            __builtin_memcpy(a.u[axis] + here, out[axis], sizeof out[axis]);
            __builtin_memcpy(a.v[axis] + here, out[3 + axis], sizeof out[axis]);
            __builtin_memcpy(a.w[axis] + here, out[6 + axis], sizeof out[axis]);
        }
    }
}

void memberPlaces(const PlaceArrays& a) {
    const auto count = static_cast<float>(a.count);
    const float spread = a.count > 1 || a.randomise > 0.0f ? 1.0f : 0.0f;
    for (std::uint32_t first = 0; first < a.count; first += lanes) {
        float random[3][lanes];
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::uint32_t l = 0; l < lanes; ++l) {
                const std::uint64_t key = std::uint64_t{a.hair} << 8 | ((first + l) & 0xff);
                random[i][l] = random_lanes::uniform(a.seed, key, a.channels[i]);
            }
        }
        float across[lanes], up[lanes], lift[lanes];
        for (std::uint32_t l = 0; l < lanes; ++l) {
            const auto member = static_cast<float>(static_cast<std::int32_t>(first + l));
            const float even = (member + 0.5f) / count;
            const float area = even + a.randomise * (random[0][l] - even);
            const float turn = 0.381966f * member + a.randomise * (random[1][l] + a.strandTurn);
            const float radius = spread * __builtin_sqrtf(area);
            const TurnSinCos at = sinCosOfTurns(turn);
            across[l] = radius * at.cos * a.aspect;
            up[l] = radius * at.sin;
            lift[l] = even + a.randomise * (random[2][l] - even);
        }
        __builtin_memcpy(a.across + first, across, sizeof across);
        __builtin_memcpy(a.up + first, up, sizeof up);
        __builtin_memcpy(a.lift + first, lift, sizeof lift);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
