// SPDX-License-Identifier: Apache-2.0
#include "core/hair/strand_members.kernel.h"

#include "core/base/lane_stores.h"
#include "core/base/quads.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = StrandRows::lanes;
using lanes16::Lanes;
using quads::Quad;
typedef std::int32_t Bits __attribute__((vector_size(64)));

// Squared lengths between these keep their digits when they are multiplied with each other.
constexpr float shortest = 1e-16f, longest = 1e16f;
// Of what stays of a unit normal across the hair; less has no direction.
constexpr float leastAcross = 1e-6f;

struct Vectors {
    Lanes x, y, z;
};

// 1 / sqrt(x) of normal numbers, six digits: a guess from the exponent (constants by Kadlec 2010), then Newton's step.
inline void inverseRoot(const Lanes& x, Lanes& y) {
    Bits bits;
    __builtin_memcpy(&bits, &x, sizeof bits);
    bits = 0x5f1ffff9 - (bits >> 1);
    __builtin_memcpy(&y, &bits, sizeof y);
    y = y * (1.68191391f - 0.703952253f * x * y * y);
    y = y * (1.5f - 0.5f * x * y * y);
}

// One member of a strand; `rows` are those of sixteen vertices.
struct Member {
    float across, up, lift;

    // The coordinate that begins with row `first`, whose U, V and W follow at every third.
    void at(const float* rows, std::size_t first, Lanes& values) const {
        Lanes base, u, v, w;
        lanes16::load(rows + first * lanes, base);
        lanes16::load(rows + (first + 3) * lanes, u);
        lanes16::load(rows + (first + 6) * lanes, v);
        lanes16::load(rows + (first + 9) * lanes, w);
        values = base + across * u + up * v + lift * w;
    }
    void vectors(const float* rows, std::size_t first, Vectors& values) const {
        at(rows, first, values.x);
        at(rows, first + 1, values.y);
        at(rows, first + 2, values.z);
    }
};

inline void loadNormals(const float* rows, Vectors& normals) {
    lanes16::load(rows + StrandRows::Normal * lanes, normals.x);
    lanes16::load(rows + (StrandRows::Normal + 1) * lanes, normals.y);
    lanes16::load(rows + (StrandRows::Normal + 2) * lanes, normals.z);
}

// The part of `n` across `way`, unit length. Lanes of `good` become 0 where that needs a closer look.
inline void acrossWay(const Vectors& way, Vectors& n, Bits& good) {
    const Lanes squared = way.x * way.x + way.y * way.y + way.z * way.z;
    const Lanes along = n.x * way.x + n.y * way.y + n.z * way.z;
    const Lanes x = n.x * squared - way.x * along, y = n.y * squared - way.y * along, z = n.z * squared - way.z * along;
    const Lanes length = x * x + y * y + z * z;
    good &= (squared > shortest) & (squared < longest) & (length > leastAcross * squared * squared);
    Lanes inverse;
    inverseRoot(length, inverse);
    n.x = x * inverse;
    n.y = y * inverse;
    n.z = z * inverse;
}

// The same for any member, vertex by vertex: where the way has no length the direction before it counts, and where the
// normal runs along it the y axis, or z for steep hair: both mirror with the head.
void normalsOneByOne(const Member& m, const float* rows, std::size_t vertices, float* out) {
    float t[3] = {0.0f, 0.0f, 0.0f};
    for (std::size_t start = 0; start < vertices; start += lanes) {
        Vectors way, n;
        m.vectors(rows + start * StrandRows::rows, StrandRows::Ways, way);
        loadNormals(rows + start * StrandRows::rows, n);
        for (std::size_t v = 0; v < lanes && start + v < vertices; ++v) {
            const float wx = way.x[v], wy = way.y[v], wz = way.z[v], squared = wx * wx + wy * wy + wz * wz;
            if (squared > 1e-24f) {
                const float inverse = 1.0f / __builtin_sqrtf(squared);
                t[0] = wx * inverse;
                t[1] = wy * inverse;
                t[2] = wz * inverse;
            }
            float along = n.x[v] * t[0] + n.y[v] * t[1] + n.z[v] * t[2];
            float r[3] = {n.x[v] - t[0] * along, n.y[v] - t[1] * along, n.z[v] - t[2] * along};
            float length = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
            if (!(length > leastAcross)) {
                const bool steep = t[1] > 0.9f || t[1] < -0.9f;
                along = steep ? t[2] : t[1];
                r[0] = -t[0] * along;
                r[1] = (steep ? 0.0f : 1.0f) - t[1] * along;
                r[2] = (steep ? 1.0f : 0.0f) - t[2] * along;
                length = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
            }
            const float inverse = 1.0f / __builtin_sqrtf(length);
            for (std::size_t axis = 0; axis < 3; ++axis) out[3 * (start + v) + axis] = r[axis] * inverse;
        }
    }
}

// Widths and colours of `count` vertices.
inline void storeLook(const float* widths, const float* colours, std::size_t count, float* widthsOut, float* coloursOut,
                      bool past) {
    Lanes values;
    lanes16::load(widths, values);
    if (count == lanes) {
        past ? lanes16::storePast(values, widthsOut) : lanes16::store(values, widthsOut);
        for (std::size_t i = 0; i < 4; ++i) {
            lanes16::load(colours + i * lanes, values);
            past ? lanes16::storePast(values, coloursOut + i * lanes) : lanes16::store(values, coloursOut + i * lanes);
        }
    } else {
        lanes16::storeSome(values, count, widthsOut);
        for (std::size_t v = 0; v < count; ++v) quads::store(quads::load(colours + 4 * v), coloursOut + 4 * v);
    }
}

}  // namespace

void strandRows(const RowArrays& a) {
    const std::size_t size = StrandRows::size(a.stride);
    for (std::size_t row = 0; row < 15; ++row) {
        const float* in = a.in[row] + a.lane;
        for (std::size_t v = 0; v < a.stride; v += 4) {
            float* to = a.out + (v / lanes * StrandRows::rows + row) * lanes + v % lanes;
            Quad points[4];
            for (std::size_t i = 0; i < 4; ++i) points[i] = quads::load(in + (v + i) * lanes);
            if (row < StrandRows::Normal) {
                const Quad last = v > 0 ? quads::load(in + (v - 1) * lanes) : points[0];
                Quad ways[4] = {points[1] - last, points[2] - points[0], points[3] - points[1],
                                quads::load(in + (v + 4) * lanes) - points[2]};
                quads::transpose(ways);
                float* out = to + StrandRows::Ways * lanes;
                for (std::size_t i = 0; i < 4; ++i) quads::store(ways[i], out + i * size);
            }
            quads::transpose(points);
            for (std::size_t i = 0; i < 4; ++i) quads::store(points[i], to + i * size);
        }
    }
}

void strandMembers(const StrandArrays& a) {
    const std::size_t vertices = a.vertices, lastStart = (vertices - 1) / lanes * lanes;
    const float* const rows = a.rows;
    float *points = a.points, *normals = a.normals, *widths = a.widthsOut, *colours = a.coloursOut;
    const bool past = a.past && vertices % lanes == 0 && lanes16::aligned(points) && lanes16::aligned(normals) &&
                      lanes16::aligned(widths) && lanes16::aligned(colours);
    Bits good = ~Bits{}, goodAtEnd = ~Bits{};
    for (std::size_t member = 0; member < a.members; ++member) {
        const Member m{a.across[member], a.up[member], a.lift[member]};
        for (std::size_t start = 0; start <= lastStart; start += lanes) {
            const std::size_t count = start < lastStart ? lanes : vertices - start;
            const float* const here = rows + start * StrandRows::rows;
            Vectors point, way, normal;
            m.vectors(here, StrandRows::Base, point);
            lanes16::storeVectors(point.x, point.y, point.z, count, points, past);
            m.vectors(here, StrandRows::Ways, way);
            loadNormals(here, normal);
            acrossWay(way, normal, start < lastStart ? good : goodAtEnd);
            lanes16::storeVectors(normal.x, normal.y, normal.z, count, normals, past);
            storeLook(a.widths + start, a.colours + 4 * start, count, widths, colours, past);
            points += 3 * count;
            normals += 3 * count;
            widths += count;
            colours += 4 * count;
        }
    }
    if (past) quads::storesPastDone();
    bool all = true;
    for (std::size_t v = 0; v < lanes; ++v) all = all && good[v] && (goodAtEnd[v] || lastStart + v >= vertices);
    for (std::size_t member = 0; member < a.members && !all; ++member) {
        const Member m{a.across[member], a.up[member], a.lift[member]};
        normalsOneByOne(m, rows, vertices, a.normals + 3 * member * vertices);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
