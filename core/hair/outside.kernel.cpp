// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = FreeArrays::lanes;
constexpr int brickNodes = FieldArrays::brickNodes, brickCells = FieldArrays::brickCells;

inline float mixed(float a, float b, float t) {
    return a + t * (b - a);
}

// Cells of sixteen places in the field.
struct Cells {
    float x[lanes], y[lanes], z[lanes];  // place in the cell, 0 to 1
    int brick[lanes];                    // as FieldArrays::bricks; far outside beyond the grid
    int node[lanes];                     // first corner in the brick
};

inline void findCells(const FieldArrays& f, const float* px, const float* py, const float* pz, Cells& c) {
    for (std::size_t l = 0; l < lanes; ++l) {
        const float qx = (px[l] - f.origin[0]) * f.perMetre, qy = (py[l] - f.origin[1]) * f.perMetre,
                    qz = (pz[l] - f.origin[2]) * f.perMetre;
        const bool within =
            (qx >= 0.0f) & (qx < f.last[0]) & (qy >= 0.0f) & (qy < f.last[1]) & (qz >= 0.0f) & (qz < f.last[2]);
        const float kx = within ? qx : 0.0f, ky = within ? qy : 0.0f, kz = within ? qz : 0.0f;
        const int x = static_cast<int>(kx), y = static_cast<int>(ky), z = static_cast<int>(kz);
        const int bx = x / brickCells, by = y / brickCells, bz = z / brickCells;
        const int brick = f.bricks[(bz * f.brickCounts[1] + by) * f.brickCounts[0] + bx];
        c.brick[l] = within ? brick : FieldArrays::farOutside;
        c.node[l] = ((z - bz * brickCells) * brickNodes + (y - by * brickCells)) * brickNodes + (x - bx * brickCells);
        c.x[l] = kx - static_cast<float>(x);
        c.y[l] = ky - static_cast<float>(y);
        c.z[l] = kz - static_cast<float>(z);
    }
}

inline void distances(const FieldArrays& f, const Cells& c, float* distance) {
    int near = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
        distance[l] = c.brick[l] == FieldArrays::farOutside ? f.band : -f.band;
        near |= c.brick[l] >= 0 ? 1 : 0;
    }
    if (near == 0) return;
    for (std::size_t l = 0; l < lanes; ++l) {
        const bool in = c.brick[l] >= 0;
        const float* n = f.nodes + (in ? (c.brick[l] & ~FieldArrays::flips) + c.node[l] : 0);
        constexpr int up = brickNodes, far = brickNodes * brickNodes;
        const float c0 = n[0], c1 = n[1], c2 = n[up], c3 = n[up + 1], c4 = n[far], c5 = n[far + 1], c6 = n[far + up],
                    c7 = n[far + up + 1];
        const float x = c.x[l], y = c.y[l];
        const float inside =
            mixed(mixed(mixed(c0, c1, x), mixed(c2, c3, x), y), mixed(mixed(c4, c5, x), mixed(c6, c7, x), y), c.z[l]);
        distance[l] = in ? inside : distance[l];
    }
}

}  // namespace

void freeOfSkin(const FreeArrays& a) {
    const int none = static_cast<int>(a.vertices);
    int first[lanes];
    float before[lanes], awayBefore[lanes], distance[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        first[l] = none;
        before[l] = awayBefore[l] = 0.0f;
    }
    Cells cells;
    for (std::size_t v = 1; v < a.vertices; ++v) {
        const float *x = a.x + v * lanes, *y = a.y + v * lanes, *z = a.z + v * lanes;
        findCells(a.field, x, y, z, cells);
        distances(a.field, cells, distance);
        const float near = 2.0f * (a.clearance * a.ease[v]);
        const int here = static_cast<int>(v);
        int open = 0;
        for (std::size_t l = 0; l < lanes; ++l) {
            const float sx = x[l] - (x - lanes)[l], sy = y[l] - (y - lanes)[l], sz = z[l] - (z - lanes)[l];
            const float step = sx * sx + sy * sy + sz * sz, reach = before[l] + a.far;
            const bool jumps = (distance[l] >= a.far) & !(step < reach * reach);
            const bool flips = (cells.brick[l] >= 0) & ((cells.brick[l] & FieldArrays::flips) != 0);
            const bool held = !((distance[l] >= near) & (distance[l] >= 0.0f) & (distance[l] >= -a.deep));
            const bool stops = (held | jumps | flips) & (first[l] == none);
            first[l] = stops ? here : first[l];
            awayBefore[l] = stops ? before[l] : awayBefore[l];
            before[l] = distance[l];
            open |= first[l] == none ? 1 : 0;
        }
        if (open == 0) break;
    }
    __builtin_memcpy(a.first, first, sizeof first);
    __builtin_memcpy(a.awayBefore, awayBefore, sizeof awayBefore);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
