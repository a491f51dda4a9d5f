// SPDX-License-Identifier: Apache-2.0
#include "core/hair/curves.kernel.h"

#include "core/base/quads.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

using quads::Quad;
constexpr std::size_t lanes = 16;

}  // namespace

void hairsToLanes(const LaneArrays& a) {
    for (int axis = 0; axis < 3; ++axis) {
        const float* hairs = a.hairs[axis];
        float* rows = a.rows[axis];
        for (std::size_t v = 0; v < a.stride; v += 4) {
            for (std::size_t l = 0; l < lanes; l += 4) {
                const float* from = hairs + l * a.stride + v;
                Quad block[4] = {quads::load(from), quads::load(from + a.stride), quads::load(from + 2 * a.stride),
                                 quads::load(from + 3 * a.stride)};
                quads::transpose(block);
                float* to = rows + v * lanes + l;
                for (std::size_t i = 0; i < 4; ++i) quads::store(block[i], to + i * lanes);
            }
        }
    }
}

void storeVectors(const StoreArrays& a) {
    for (std::size_t l = 0; l < a.count; l += 4) {
        const std::size_t used = a.count - l < 4 ? a.count - l : 4;
        std::uint32_t most = 0;
        for (std::size_t i = 0; i < used; ++i) most = a.vertices[l + i] > most ? a.vertices[l + i] : most;
        for (std::uint32_t v = 0; v < most; v += 4) {
            Quad block[3][4];
            for (int axis = 0; axis < 3; ++axis) {
                const float* from = a.rows[axis] + v * lanes + l;
                for (std::size_t i = 0; i < 4; ++i) block[axis][i] = quads::load(from + i * lanes);
                quads::transpose(block[axis]);
            }
            for (std::size_t i = 0; i < used; ++i) {
                const std::uint32_t vertices = a.vertices[l + i];
                float* to = a.out[l + i] + std::size_t{3} * v;
                if (v + 4 <= vertices) {
                    quads::storeTriples(block[0][i], block[1][i], block[2][i], to, a.past && quads::aligned(to));
                } else if (v < vertices) {
                    float rest[12];
                    quads::storeTriples(block[0][i], block[1][i], block[2][i], rest, false);
                    for (std::uint32_t k = 0; k < 3 * (vertices - v); ++k) to[k] = rest[k];
                }
            }
        }
    }
    if (a.past) quads::storesPastDone();
}

void lookHairs(const LookArrays& a) {
    for (std::size_t hair = 0; hair < a.count; ++hair) {
        const HairTraits& t = *a.traits[hair];
        const std::size_t vertices = a.vertices[hair], end = vertices - 1, whole = vertices / 4 * 4;
        const float last = a.last[hair];
        const float width = t.rootWidth, widthSpan = t.tipWidth - t.rootWidth;
        const Quad colour = quads::load(t.rootColour), span = quads::load(t.tipColour) - colour;
        for (std::size_t member = 0; member < a.members; ++member) {
            float *widths = a.widths[hair] + member * vertices, *colours = a.colours[hair] + member * 4 * vertices;
            const bool widthsPast = a.past && quads::aligned(widths), coloursPast = a.past && quads::aligned(colours);
            for (std::size_t v = 0; v < whole; v += 4) {
                // Where the hair ends, its own number takes the place of the table's.
                float along[4];
                quads::store(quads::load(a.along + v), along);
                if (end - v < 4) along[end - v] = last;
                const Quad wide = width + widthSpan * quads::load(along);
                widthsPast ? quads::storePast(wide, widths + v) : quads::store(wide, widths + v);
                for (std::size_t i = 0; i < 4; ++i) {
                    const Quad tint = colour + span * along[i];
                    float* to = colours + (v + i) * 4;
                    coloursPast ? quads::storePast(tint, to) : quads::store(tint, to);
                }
            }
            for (std::size_t v = whole; v < vertices; ++v) {
                const float along = v < end ? a.along[v] : last;
                widths[v] = width + widthSpan * along;
                quads::store(colour + span * along, colours + v * 4);
            }
        }
    }
    if (a.past) quads::storesPastDone();
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
