// SPDX-License-Identifier: Apache-2.0
#include "core/hair/members.kernel.h"

#include "core/base/lanes.h"
#include "core/base/polynomials.h"
#include "core/base/random_lanes.h"
#include "core/hair/frame_steps.h"
#include "core/hair/modifiers/turns.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = MemberArrays::lanes;
using frame_steps::Vectors;
using lanes16::Lanes;

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

void strandMembers(const MemberPoints& a) {
    Lanes across, up, lift;
    lanes16::load(a.across, across);
    lanes16::load(a.up, up);
    lanes16::load(a.lift, lift);
    for (int axis = 0; axis < 3; ++axis) {
        const float *base = a.base[axis], *u = a.u[axis], *v = a.v[axis], *w = a.w[axis];
        float* point = a.point[axis];
        for (std::size_t row = 0; row < (a.vertices + 1) * lanes; row += lanes) {
            Lanes b, ru, rv, rw;
            lanes16::load(base + row, b);
            lanes16::load(u + row, ru);
            lanes16::load(v + row, rv);
            lanes16::load(w + row, rw);
            lanes16::store(b + across * ru + up * rv + lift * rw, point + row);
        }
    }
    Vectors tangent = {}, normal;
    for (std::size_t vertex = 0; vertex < a.vertices; ++vertex) {
        const std::size_t here = vertex * lanes, last = vertex > 0 ? here - lanes : here, next = here + lanes;
        frame_steps::tangents(a.point[0] + last, a.point[1] + last, a.point[2] + last, a.point[0] + next,
                              a.point[1] + next, a.point[2] + next, tangent);
        __builtin_memcpy(normal.x, a.normal[0] + here, sizeof normal.x);
        __builtin_memcpy(normal.y, a.normal[1] + here, sizeof normal.y);
        __builtin_memcpy(normal.z, a.normal[2] + here, sizeof normal.z);
        frame_steps::straighten(tangent, normal, 1e-6f);
        __builtin_memcpy(a.pointNormal[0] + here, normal.x, sizeof normal.x);
        __builtin_memcpy(a.pointNormal[1] + here, normal.y, sizeof normal.y);
        __builtin_memcpy(a.pointNormal[2] + here, normal.z, sizeof normal.z);
    }
}

void memberPlaces(const PlaceArrays& a) {
    const auto member = static_cast<float>(a.member);
    const float even = (member + 0.5f) / static_cast<float>(a.count);
    const bool several = a.count > 1;
    for (std::size_t l = 0; l < lanes; ++l) {
        const std::uint64_t key = std::uint64_t{a.hairs[l]} << 8 | a.member;
        const float randomise = a.randomise[l];
        const float area = even + randomise * (random_lanes::uniform(a.seed, key, a.channels[0]) - even);
        const float turn =
            0.381966f * member + randomise * (random_lanes::uniform(a.seed, key, a.channels[1]) + a.strandTurn[l]);
        const float radius = several || randomise > 0.0f ? __builtin_sqrtf(area) : 0.0f;
        const TurnSinCos at = sinCosOfTurns(turn);
        a.across[l] = radius * at.cos * a.aspect[l];
        a.up[l] = radius * at.sin;
        a.lift[l] = even + randomise * (random_lanes::uniform(a.seed, key, a.channels[2]) - even);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
