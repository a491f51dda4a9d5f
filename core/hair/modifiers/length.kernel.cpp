// SPDX-License-Identifier: Apache-2.0
// Hairs get shorter or longer: their whole shape, or by a cut.
#include "core/hair/modifiers/lanes.h"
#include "core/model/modifiers/rows.h"

namespace whorl::WHORL_SIMD_NAMESPACE {

using namespace modifier_lanes;

namespace {

// Vertex v goes to curve parameter v x share on the old curve (Catmull-Rom, ends repeated), one coordinate.
inline void cutCoordinate(float* p, float* old, std::size_t vertices, const float* share) {
    for (std::size_t i = 0; i < vertices * lanes; ++i) old[i] = p[i];
    const auto last = static_cast<std::int32_t>(vertices) - 1;
    for (std::size_t v = 1; v < vertices; ++v) {
        for (std::size_t l = 0; l < lanes; ++l) {
            const float place = static_cast<float>(v) * share[l];
            std::int32_t piece = static_cast<std::int32_t>(place);
            piece = piece > last - 1 ? last - 1 : piece;
            const float t = place - static_cast<float>(piece);
            const std::int32_t before = piece > 0 ? piece - 1 : 0, after = piece + 2 > last ? last : piece + 2;
            const auto lane = static_cast<std::int32_t>(l);
            const float q0 = old[before * 16 + lane], q1 = old[piece * 16 + lane], q2 = old[(piece + 1) * 16 + lane],
                        q3 = old[after * 16 + lane];
            const float k1 = (q2 - q0) * 0.5f, k2 = q0 - q1 * 2.5f + q2 * 2.0f - q3 * 0.5f,
                        k3 = (q3 - q0) * 0.5f + (q1 - q2) * 1.5f;
            const float cut = q1 + (k1 + (k2 + k3 * t) * t) * t;
            const std::size_t i = v * lanes + l;
            p[i] = share[l] < 1.0f ? cut : p[i];
        }
    }
}

}  // namespace

void lengthHairs(const ModifierArrays& a) {
    const float *amount = numberRow(a, 1), *factor = numberRow(a, LengthRows::Factor),
                *length = numberRow(a, LengthRows::Length), *random = numberRow(a, LengthRows::Random);
    const bool absolute = numberRow(a, LengthRows::Mode)[0] > 0.5f;
    const bool cut = numberRow(a, LengthRows::Method)[0] > 0.5f;
    float whole[lanes] = {}, share[lanes];
    pieceLengths(a, a.scratch);
    for (std::size_t v = 1; v < a.vertices; ++v)
        for (std::size_t l = 0; l < lanes; ++l) whole[l] += a.scratch[v * lanes + l];
    for (std::size_t l = 0; l < lanes; ++l) {
        const bool some = whole[l] > 1e-6f;
        const float wanted = absolute ? (some ? length[l] / whole[l] : 1.0f) : factor[l];
        const float shortened = wanted * (1.0f - random[l] * a.random[l]);
        share[l] = 1.0f + amount[l] * (shortened - 1.0f);
    }
    if (cut) {
        // The share of the pieces that the wanted length reaches over.
        float way[lanes] = {}, reached[lanes] = {};
        for (std::size_t v = 1; v < a.vertices; ++v) {
            for (std::size_t l = 0; l < lanes; ++l) {
                const float piece = a.scratch[v * lanes + l];
                const float wanted = share[l] * whole[l] - way[l];
                reached[l] += piece > 0.0f ? clamped(wanted / piece, 0.0f, 1.0f) : (wanted > 0.0f ? 1.0f : 0.0f);
                way[l] += piece;
            }
        }
        const float inverse = 1.0f / static_cast<float>(a.vertices - 1);
        for (std::size_t l = 0; l < lanes; ++l) share[l] = share[l] < 1.0f ? reached[l] * inverse : 1.0f;
        cutCoordinate(a.x, a.scratch, a.vertices, share);
        cutCoordinate(a.y, a.scratch, a.vertices, share);
        cutCoordinate(a.z, a.scratch, a.vertices, share);
        return;
    }
    for (std::size_t v = 1; v < a.vertices; ++v) {
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::size_t i = v * lanes + l;
            const float x = a.x[l] + share[l] * (a.x[i] - a.x[l]), y = a.y[l] + share[l] * (a.y[i] - a.y[l]),
                        z = a.z[l] + share[l] * (a.z[i] - a.z[l]);
            const bool on = share[l] < 1.0f || share[l] > 1.0f;
            a.x[i] = on ? x : a.x[i];
            a.y[i] = on ? y : a.y[i];
            a.z[i] = on ? z : a.z[i];
        }
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
