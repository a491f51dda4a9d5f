// SPDX-License-Identifier: Apache-2.0
// Hairs wind about the curve that they had.
#include "core/hair/frame_steps.h"
#include "core/hair/modifiers/lanes.h"
#include "core/hair/modifiers/turns.h"
#include "core/model/modifiers/rows.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using frame_steps::Vectors;
using modifier_lanes::numberRow;
using modifier_lanes::pieceLengths;
using modifier_lanes::restoreLengths;

namespace {

constexpr std::size_t lanes = ModifierArrays::lanes;

// Where the turn of a hair that leaves its root along `t` begins: x, turned by the smallest rotation that takes y to
// `t`. So neighbours that grow alike begin alike; only hair that leaves straight downwards has no such start.
inline void firstNormals(const Vectors& t, Vectors& n) {
    for (std::size_t l = 0; l < lanes; ++l) {
        const float up = 1.0f + t.y[l];
        const float share = t.x[l] / (up > 1e-3f ? up : 1e-3f);
        n.x[l] = 1.0f - share * t.x[l];
        n.y[l] = -share * up;
        n.z[l] = -share * t.z[l];
    }
}

}  // namespace

void curlHairs(const ModifierArrays& a) {
    const float *amount = numberRow(a, 1), *root = numberRow(a, CurlRows::RootRadius),
                *tip = numberRow(a, CurlRows::TipRadius), *turns = numberRow(a, CurlRows::Turns),
                *variation = numberRow(a, CurlRows::Variation), *phase = numberRow(a, CurlRows::Phase),
                *flips = numberRow(a, CurlRows::Flips);
    const bool keep = numberRow(a, CurlRows::KeepLength)[0] > 0.0f;
    if (keep) pieceLengths(a, a.scratch);
    float start[lanes], speed[lanes], wide[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        const float way = a.random[3 * lanes + l] < flips[l] ? -1.0f : 1.0f;
        start[l] = phase[l] * a.random[l];
        speed[l] = way * turns[l] * (1.0f + variation[l] * (2.0f * a.random[lanes + l] - 1.0f));
        wide[l] = amount[l] * (1.0f + variation[l] * (2.0f * a.random[2 * lanes + l] - 1.0f));
    }
    Vectors tangent, before, normal, old, last;
    for (std::size_t l = 0; l < lanes; ++l) {
        tangent.x[l] = tangent.z[l] = 0.0f;
        tangent.y[l] = 1.0f;
        old.x[l] = last.x[l] = a.x[l];
        old.y[l] = last.y[l] = a.y[l];
        old.z[l] = last.z[l] = a.z[l];
    }
    for (std::size_t v = 0; v < a.vertices; ++v) {
        float *x = a.x + v * lanes, *y = a.y + v * lanes, *z = a.z + v * lanes;
        const std::size_t ahead = v + 1 < a.vertices ? lanes : 0;
        before = tangent;
        // `old` is this vertex, `last` the one before, both as they were.
        for (std::size_t l = 0; l < lanes; ++l) {
            old.x[l] = x[l];
            old.y[l] = y[l];
            old.z[l] = z[l];
        }
        frame_steps::tangents(last.x, last.y, last.z, x + ahead, y + ahead, z + ahead, tangent);
        if (v == 0) {
            firstNormals(tangent, normal);
        } else {
            frame_steps::reflectTwice(last.x, last.y, last.z, old.x, old.y, old.z, before, tangent, normal);
        }
        frame_steps::straighten(tangent, normal, 1e-6f);
        const float along = a.along[v], ease = a.ease[v];
        for (std::size_t l = 0; l < lanes; ++l) {
            const TurnSinCos turn = sinCosOfTurns(start[l] + speed[l] * along);
            const float radius = wide[l] * ease * (root[l] + (tip[l] - root[l]) * along);
            const float c = radius * turn.cos, s = radius * turn.sin;
            const float bx = tangent.y[l] * normal.z[l] - tangent.z[l] * normal.y[l],
                        by = tangent.z[l] * normal.x[l] - tangent.x[l] * normal.z[l],
                        bz = tangent.x[l] * normal.y[l] - tangent.y[l] * normal.x[l];
            const bool on = v > 0 && amount[l] > 0.0f;
            x[l] = on ? old.x[l] + c * normal.x[l] + s * bx : x[l];
            y[l] = on ? old.y[l] + c * normal.y[l] + s * by : y[l];
            z[l] = on ? old.z[l] + c * normal.z[l] + s * bz : z[l];
        }
        last = old;
    }
    if (keep) restoreLengths(a, a.scratch, amount);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
