// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.kernel.h"

#include "core/base/lanes.h"

#include <cstdint>

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = FreeArrays::lanes;
using lanes16::Lanes;
typedef std::int32_t Whole __attribute__((vector_size(64)));

constexpr int brickNodes = FieldArrays::brickNodes, brickCells = FieldArrays::brickCells;

inline float mixed(float a, float b, float t) {
    return a + t * (b - a);
}

// Cells of sixteen places in the field.
struct Cells {
    float x[lanes], y[lanes], z[lanes];  // place in the cell, 0 to 1
    std::int32_t brick[lanes];           // as FieldArrays::bricks; far outside beyond the grid
    std::int32_t node[lanes];            // first corner in the brick
};

// Along one axis: where in the grid sixteen places are, and lanes of `within` that are not become 0.
inline void toGrid(const float* place, float origin, float perMetre, float last, Lanes& grid, Whole& within) {
    lanes16::load(place, grid);
    grid = (grid - origin) * perMetre;
    within &= (grid >= 0.0f) & (grid < last);
}

// Adds what one axis tells of brick and node; bricks are `apart` on it, nodes of a brick `nodesApart`.
inline void findCell(Lanes& grid, const Whole& within, std::int32_t apart, std::int32_t nodesApart, Whole& brick,
                     Whole& node, float* share) {
    Whole bits;
    __builtin_memcpy(&bits, &grid, sizeof bits);
    bits &= within;
    __builtin_memcpy(&grid, &bits, sizeof grid);
    const Whole cell = __builtin_convertvector(grid, Whole);
    // A third: exact below 32768, and fields have some hundreds of cells.
    static_assert(brickCells == 3);
    const Whole which = (cell * 21846) >> 16;
    brick += which * apart;
    node += (cell - which * brickCells) * nodesApart;
    lanes16::store(grid - __builtin_convertvector(cell, Lanes), share);
}

inline void findCells(const FieldArrays& f, const float* px, const float* py, const float* pz, Cells& c) {
    Lanes x, y, z;
    Whole within = ~Whole{}, brick{}, node{};
    toGrid(px, f.origin[0], f.perMetre, f.last[0], x, within);
    toGrid(py, f.origin[1], f.perMetre, f.last[1], y, within);
    toGrid(pz, f.origin[2], f.perMetre, f.last[2], z, within);
    findCell(x, within, 1, 1, brick, node, c.x);
    findCell(y, within, f.brickCounts[0], brickNodes, brick, node, c.y);
    findCell(z, within, f.brickCounts[0] * f.brickCounts[1], brickNodes * brickNodes, brick, node, c.z);
    std::int32_t places[lanes], found[lanes];
    __builtin_memcpy(places, &brick, sizeof places);
    for (std::size_t l = 0; l < lanes; ++l) found[l] = f.bricks[places[l]];
    __builtin_memcpy(&brick, found, sizeof brick);
    brick = (brick & within) | (FieldArrays::farOutside & ~within);
    __builtin_memcpy(c.brick, &brick, sizeof brick);
    __builtin_memcpy(c.node, &node, sizeof node);
}

inline void distances(const FieldArrays& f, const Cells& c, float (&distance)[lanes]) {
    const float band = f.band;
    const float* const nodes = f.nodes;
    std::int32_t near = 0, first[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        distance[l] = c.brick[l] == FieldArrays::farOutside ? band : -band;
        first[l] = c.brick[l] >= 0 ? (c.brick[l] & ~FieldArrays::flips) + c.node[l] : 0;
        near |= c.brick[l] >= 0 ? 1 : 0;
    }
    if (near == 0) return;
    constexpr int up = brickNodes, far = brickNodes * brickNodes;
    float corner[8][lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
        const float* n = nodes + first[l];
        corner[0][l] = n[0];
        corner[1][l] = n[1];
        corner[2][l] = n[up];
        corner[3][l] = n[up + 1];
        corner[4][l] = n[far];
        corner[5][l] = n[far + 1];
        corner[6][l] = n[far + up];
        corner[7][l] = n[far + up + 1];
    }
    for (std::size_t l = 0; l < lanes; ++l) {
        const float x = c.x[l], y = c.y[l];
        const float inside =
            mixed(mixed(mixed(corner[0][l], corner[1][l], x), mixed(corner[2][l], corner[3][l], x), y),
                  mixed(mixed(corner[4][l], corner[5][l], x), mixed(corner[6][l], corner[7][l], x), y), c.z[l]);
        distance[l] = c.brick[l] >= 0 ? inside : distance[l];
    }
}

}  // namespace

void freeOfSkin(const FreeArrays& a) {
    const auto none = static_cast<std::int32_t>(a.vertices);
    const float far = a.far, deep = a.deep;
    std::int32_t first[lanes];
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
        const auto here = static_cast<std::int32_t>(v);
        std::int32_t open = 0;
        for (std::size_t l = 0; l < lanes; ++l) {
            const float sx = x[l] - (x - lanes)[l], sy = y[l] - (y - lanes)[l], sz = z[l] - (z - lanes)[l];
            const float step = sx * sx + sy * sy + sz * sz, reach = before[l] + far;
            const std::int32_t jumps = (distance[l] >= far ? 1 : 0) & (step < reach * reach ? 0 : 1);
            const std::int32_t flips = (cells.brick[l] >= 0 ? 1 : 0) & cells.brick[l] & FieldArrays::flips;
            const std::int32_t free =
                (distance[l] >= near ? 1 : 0) & (distance[l] >= 0.0f ? 1 : 0) & (distance[l] >= -deep ? 1 : 0);
            const std::int32_t stops = ((1 - free) | jumps | flips) & (first[l] == none ? 1 : 0);
            first[l] = stops != 0 ? here : first[l];
            awayBefore[l] = stops != 0 ? before[l] : awayBefore[l];
            before[l] = distance[l];
            open |= first[l] == none ? 1 : 0;
        }
        if (open == 0) break;
    }
    __builtin_memcpy(a.first, first, sizeof first);
    __builtin_memcpy(a.awayBefore, awayBefore, sizeof awayBefore);
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
