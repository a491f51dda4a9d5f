// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/root_sweep.kernel.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t lanes = 16;
constexpr std::size_t roomStrata = sweepStrata + lanes;

// Of neighbouring strata: unit and number of the candidate in each.
struct Strata {
    std::uint32_t units[roomStrata];
    std::uint32_t ids[roomStrata];
    std::uint32_t shares[roomStrata];
};

// Strata `first` and up of a level; `first` and `count` are multiples of the lanes.
void findCandidates(const CandidateKeys& keys, unsigned level, std::uint32_t first, std::size_t count, Strata& out) {
    const std::uint32_t mask = (1u << level) - 1u;
    std::uint32_t inLane[lanes];
    for (std::uint32_t l = 0; l < lanes; ++l) inLane[l] = reversed(l << (32u - level));
    for (std::size_t start = 0; start < count; start += lanes) {
        const std::uint32_t base = reversed((first + static_cast<std::uint32_t>(start)) << (32u - level));
        for (std::size_t l = 0; l < lanes; ++l) {
            const std::uint32_t id = candidateIn(keys, base | inLane[l]) & mask;
            out.ids[start + l] = id;
            out.units[start + l] = unitOf(stratumOf(keys, id));
        }
    }
}

// How far into a triangle candidates [begin, end) lie.
void findShares(const CandidateKeys& keys, const SweepArrays& a, std::size_t place, std::size_t begin, std::size_t end,
                Strata& strata) {
    const std::uint32_t from = a.begins[place];
    const auto zeros = static_cast<std::uint32_t>(__builtin_clz(a.begins[place + 1] - from));
    const std::uint32_t reciprocal = a.reciprocals[place];
    for (std::size_t j = begin; j < end; ++j) {
        strata.shares[j] = shareOfTriangle(strata.units[j] - from, finePlace(keys, strata.ids[j]), zeros, reciprocal);
    }
}

// Keeps those of candidates [begin, end) of a triangle that are hairs; their shares wait in `kept`.
void keepHairs(const SweepArrays& a, std::size_t place, std::size_t begin, std::size_t end, const Strata& strata,
               SweepRoots& roots, std::uint32_t* kept) {
    const std::uint8_t* codes = a.codes + a.firstCode[place];
    const unsigned depth = a.depths[place];
    std::size_t n = roots.count;
    const std::size_t before = n;
    if (depth == 0) {
        const std::uint32_t limit = a.limits[codes[0]];
        for (std::size_t j = begin; j < end; ++j) {
            roots.ids[n] = strata.ids[j];
            kept[n] = strata.shares[j];
            n += strata.ids[j] < limit ? 1 : 0;
        }
    } else {
        const unsigned shift = 32u - 2u * depth;
        for (std::size_t j = begin; j < end; ++j) {
            const std::uint32_t share = strata.shares[j], id = strata.ids[j];
            roots.ids[n] = id;
            kept[n] = share;
            n += id < a.limits[codes[share >> shift]] ? 1 : 0;
        }
    }
    const std::uint32_t triangle = a.triangles[place];
    for (std::size_t i = before; i < n; ++i) roots.triangles[i] = triangle;
    roots.count = n;
}

}  // namespace

std::uint32_t sweepRoots(const SweepArrays& a, std::size_t place, std::uint32_t from, std::uint32_t to,
                         SweepRoots& roots) {
    Strata strata;
    // Shares of the roots wait in the place of u until they are turned into (u, v).
    std::uint32_t* const kept = reinterpret_cast<std::uint32_t*>(roots.u);
    const std::size_t before = roots.count;
    while (from < to) {
        if (a.most[place] == 0) {
            from = a.begins[++place];
            continue;
        }
        if (roots.count + sweepStrata > roots.capacity) break;
        const unsigned level = a.levels[a.most[place]];
        const unsigned shift = 32u - level;
        const std::uint32_t first = (from >> shift) & ~static_cast<std::uint32_t>(lanes - 1);
        // As far as triangles go on at this level.
        const std::uint64_t limit = static_cast<std::uint64_t>(first + sweepStrata) << shift;
        const std::uint32_t most = limit < to ? static_cast<std::uint32_t>(limit) : to;
        std::size_t last = place + 1;
        while (last < a.count && a.begins[last] < most && a.most[last] != 0 && a.levels[a.most[last]] == level) ++last;
        const std::uint32_t stop = a.begins[last] < most ? a.begins[last] : most;
        const std::size_t count = (((stop - 1) >> shift) - first + lanes) & ~(lanes - 1);
        findCandidates(a.keys, level, first, count, strata);
        // Only at the ends of a triangle its strata have to be asked whether their candidate is on it.
        std::size_t j = (from >> shift) - first;
        if (strata.units[j] < from) ++j;
        for (; place < last; ++place) {
            const std::uint32_t end = a.begins[place + 1] < stop ? a.begins[place + 1] : stop;
            std::size_t next = ((end - 1) >> shift) - first;
            if (strata.units[next] < end) ++next;
            if (next > j) {
                findShares(a.keys, a, place, j, next, strata);
                keepHairs(a, place, j, next, strata, roots, kept);
                j = next;
            }
            if (a.begins[place + 1] > stop) break;
        }
        from = stop;
    }
    for (std::size_t i = before; i < roots.count; ++i) {
        std::int32_t u = 0, v = 0;
        placeInTriangle(kept[i], u, v);
        roots.u[i] = static_cast<float>(u) * placeUnit;
        roots.v[i] = static_cast<float>(v) * placeUnit;
    }
    return from;
}

void codePieces(const PieceArrays& a, std::size_t count, std::uint8_t* codes) {
    const float width = static_cast<float>(a.width), height = static_cast<float>(a.height);
    const std::int32_t stride = a.width + 2;
    const float* const texels = a.texels;
    const float scale = a.scale;
    const bool flip = a.flipV;
    const float u0 = a.uv[0], v0 = a.uv[1], bu = a.toB[0], bv = a.toB[1], cu = a.toC[0], cv = a.toC[1];
    const float* const us = a.u;
    const float* const vs = a.v;
    constexpr std::size_t block = 64;
    std::int32_t made[block];
    for (std::size_t start = 0; start < count; start += block) {
        const std::size_t n = count - start < block ? count - start : block;
        for (std::size_t i = 0; i < n; ++i) {
            const float x0 = u0 + bu * us[start + i] + cu * vs[start + i];
            const float y1 = v0 + bv * us[start + i] + cv * vs[start + i];
            const float y0 = flip ? y1 : 1.0f - y1;
            // As Map::sample: repeats, and takes numbers that are huge or none for zero.
            const float xt = x0 < 1e6f && x0 > -1e6f ? x0 : 0.0f;
            const float yt = y0 < 1e6f && y0 > -1e6f ? y0 : 0.0f;
            const float xi = static_cast<float>(static_cast<std::int32_t>(xt));
            const float yi = static_cast<float>(static_cast<std::int32_t>(yt));
            const float x = (xt - (xi > xt ? xi - 1.0f : xi)) * width - 0.5f;
            const float y = (yt - (yi > yt ? yi - 1.0f : yi)) * height - 0.5f;
            const float xd = static_cast<float>(static_cast<std::int32_t>(x));
            const float yd = static_cast<float>(static_cast<std::int32_t>(y));
            const float column = xd > x ? xd - 1.0f : xd, row = yd > y ? yd - 1.0f : yd;
            const float fx = x - column, fy = y - row;
            const std::int32_t at =
                (static_cast<std::int32_t>(row) + 1) * stride + static_cast<std::int32_t>(column) + 1;
            const float top = texels[at] * (1.0f - fx) + texels[at + 1] * fx;
            const float bottom = texels[at + stride] * (1.0f - fx) + texels[at + stride + 1] * fx;
            const float density = (top * (1.0f - fy) + bottom * fy) * scale;
            // Not a number, infinite or below zero: nothing grows. Above zero: something does.
            const bool grows = density > 0.0f && density < 3e38f;
            const float kept = grows ? (density < 1.0f ? density : 1.0f) : 0.0f;
            const std::int32_t code = static_cast<std::int32_t>(__builtin_sqrtf(kept) * 255.0f + 0.5f);
            made[i] = grows & (code == 0) ? 1 : code;
        }
        for (std::size_t i = 0; i < n; ++i) codes[start + i] = static_cast<std::uint8_t>(made[i]);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
