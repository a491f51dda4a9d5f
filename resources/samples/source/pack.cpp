// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/pack.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <numeric>

namespace whorl::samples {

using glm::dvec2;

namespace {

constexpr int kGrid = 160;
using Row = std::bitset<kGrid>;

struct Mask {
    int width = 0, height = 0;
    std::vector<Row> rows;
};

bool overlapsCell(const std::array<dvec2, 3>& t, const dvec2& lo) {
    // Separating axes: the box sides are handled by the caller's loop bounds, here the three triangle edges.
    const std::array<dvec2, 4> box = {lo, lo + dvec2(1, 0), lo + dvec2(1, 1), lo + dvec2(0, 1)};
    for (int c = 0; c < 3; ++c) {
        const dvec2 edge = t[(c + 1) % 3] - t[c];
        const dvec2 normal(-edge.y, edge.x);
        const double inside = glm::dot(normal, t[(c + 2) % 3] - t[c]);
        const bool apart = std::all_of(box.begin(), box.end(), [&](const dvec2& corner) {
            return glm::dot(normal, corner - t[c]) * (inside < 0.0 ? -1.0 : 1.0) < 0.0;
        });
        if (apart) {
            return false;
        }
    }
    return true;
}

/// Grid cells an island touches when its corner is at the origin.
Mask rasterise(const Island& island, double scale) {
    dvec2 hi(0.0);
    for (const dvec2& p : island.points) {
        hi = glm::max(hi, p * scale);
    }
    Mask mask;
    mask.width = int(hi.x) + 1;
    mask.height = int(hi.y) + 1;
    if (mask.width > kGrid || mask.height > kGrid) {
        return mask;
    }
    mask.rows.resize(size_t(mask.height));
    for (const auto& t : island.triangles) {
        const std::array<dvec2, 3> p = {island.points[t[0]] * scale, island.points[t[1]] * scale,
                                        island.points[t[2]] * scale};
        const dvec2 lo = glm::min(p[0], glm::min(p[1], p[2])), top = glm::max(p[0], glm::max(p[1], p[2]));
        for (int y = int(lo.y); y <= int(top.y); ++y) {
            for (int x = int(lo.x); x <= int(top.x); ++x) {
                if (overlapsCell(p, dvec2(x, y))) {
                    mask.rows[size_t(y)].set(size_t(x));
                }
            }
        }
    }
    return mask;
}

/// The mask grown by one cell all round, so that a free fit leaves a free cell between islands.
Mask grow(const Mask& mask) {
    Mask out;
    out.width = mask.width + 2;
    out.height = mask.height + 2;
    out.rows.resize(size_t(out.height));
    for (int y = 0; y < mask.height; ++y) {
        const Row row = mask.rows[size_t(y)];
        const Row wide = row | row << 1 | row << 2;
        for (int dy = 0; dy < 3; ++dy) {
            out.rows[size_t(y + dy)] |= wide;
        }
    }
    return out;
}

bool place(const std::vector<Island>& islands, const std::vector<size_t>& order, double scale,
           std::vector<dvec2>& corners) {
    std::vector<Row> used(kGrid);
    for (size_t i : order) {
        const Mask mask = rasterise(islands[i], scale);
        if (mask.rows.empty() || mask.width + 2 > kGrid || mask.height + 2 > kGrid) {
            return false;
        }
        const Mask wide = grow(mask);
        bool placed = false;
        for (int y = 0; y + wide.height <= kGrid && !placed; ++y) {
            for (int x = 0; x + wide.width <= kGrid && !placed; ++x) {
                bool free = true;
                for (int r = 0; r < wide.height && free; ++r) {
                    free = (used[size_t(y + r)] & wide.rows[size_t(r)] << size_t(x)).none();
                }
                if (free) {
                    for (int r = 0; r < mask.height; ++r) {
                        used[size_t(y + r + 1)] |= mask.rows[size_t(r)] << size_t(x + 1);
                    }
                    corners[i] = dvec2(x + 1, y + 1);
                    placed = true;
                }
            }
        }
        if (!placed) {
            return false;
        }
    }
    return true;
}

}  // namespace

void packIslands(std::vector<Island>& islands) {
    std::vector<double> extent(islands.size());
    double area = 0.0;
    for (size_t i = 0; i < islands.size(); ++i) {
        dvec2 lo(1e9), hi(-1e9);
        for (const dvec2& p : islands[i].points) {
            lo = glm::min(lo, p);
            hi = glm::max(hi, p);
        }
        for (dvec2& p : islands[i].points) {
            p -= lo;
        }
        extent[i] = (hi.x - lo.x) * (hi.y - lo.y);
        area += extent[i];
    }
    std::vector<size_t> order(islands.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return extent[a] > extent[b]; });
    double fits = 0.0, fails = kGrid / std::sqrt(area) * 1.6;
    std::vector<dvec2> corners(islands.size()), trial(islands.size());
    for (int i = 0; i < 11 || fits == 0.0; ++i) {
        const double middle = 0.5 * (fits + fails);
        if (place(islands, order, middle, trial)) {
            fits = middle;
            corners = trial;
        } else {
            fails = middle;
        }
    }
    for (size_t i = 0; i < islands.size(); ++i) {
        for (dvec2& p : islands[i].points) {
            p = (p * fits + corners[i]) / double(kGrid);
        }
    }
}

}  // namespace whorl::samples
