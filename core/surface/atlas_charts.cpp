// SPDX-License-Identifier: Apache-2.0
#include "core/surface/atlas_charts.h"

#include "core/base/random.h"
#include "core/surface/adjacency.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace whorl::atlas {
namespace {

constexpr std::uint32_t none = noTriangle;
// A chart grows while triangles lean at most this far from the mean normal, and keeps those whose shadow is at least
// `leastShadow` of their area: what leans more would get too few texels.
const double coneCosine = std::cos(50.0 * std::numbers::pi / 180.0);
constexpr double leastShadow = 0.5;
// Triangles much larger than the chart's mean are compared with all others, so a chart takes few of them.
constexpr std::size_t mostWide = 256;

using Neighbours = std::vector<std::array<std::uint32_t, 3>>;

using Flat = std::array<glm::dvec2, 3>;

// True when the insides of two counter-clockwise triangles meet. Touching at edges or corners is no overlap.
bool overlap(const Flat& a, const Flat& b) {
    const auto separated = [](const Flat& p, const Flat& q) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 edge = p[(k + 1) % 3] - p[k];
            const double length = std::abs(edge.x) + std::abs(edge.y);
            double most = -std::numeric_limits<double>::infinity();
            double reach = 0.0;
            for (const glm::dvec2& c : q) {
                const glm::dvec2 d = c - p[k];
                most = std::max(most, edge.x * d.y - edge.y * d.x);
                reach = std::max(reach, std::abs(d.x) + std::abs(d.y));
            }
            if (most <= 1e-9 * length * std::max(length, reach)) return true;  // all of q is outside this edge
        }
        return false;
    };
    return !separated(a, b) && !separated(b, a);
}

// Triangles laid down so far in one chart, found by cells of the plane.
class Layout {
public:
    Layout(double cell, std::size_t expected) : m_cell(cell) {
        std::size_t size = 64;
        while (size < expected * 4) size *= 2;
        m_heads.assign(size, none);
    }

    /// False, and nothing changes, when `triangle` overlaps one that is there.
    bool add(const Flat& triangle) {
        const glm::dvec2 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
        const glm::dvec2 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
        const auto x0 = cellOf(low.x), x1 = cellOf(high.x), y0 = cellOf(low.y), y1 = cellOf(high.y);
        const bool wide = static_cast<double>(x1 - x0 + 1) * static_cast<double>(y1 - y0 + 1) > 64.0;
        if (wide && m_wide.size() >= mostWide) return false;
        for (const std::uint32_t other : m_wide) {
            if (overlap(triangle, m_triangles[other])) return false;
        }
        if (wide) {
            for (const Flat& other : m_triangles) {
                if (overlap(triangle, other)) return false;
            }
        } else {
            for (auto y = y0; y <= y1; ++y) {
                for (auto x = x0; x <= x1; ++x) {
                    for (std::uint32_t i = m_heads[slot(x, y)]; i != none; i = m_entries[i].next) {
                        if (overlap(triangle, m_triangles[m_entries[i].triangle])) return false;
                    }
                }
            }
        }
        const auto number = static_cast<std::uint32_t>(m_triangles.size());
        m_triangles.push_back(triangle);
        if (wide) {
            m_wide.push_back(number);
            return true;
        }
        for (auto y = y0; y <= y1; ++y) {
            for (auto x = x0; x <= x1; ++x) {
                std::uint32_t& head = m_heads[slot(x, y)];
                m_entries.push_back({number, head});
                head = static_cast<std::uint32_t>(m_entries.size() - 1);
            }
        }
        return true;
    }

private:
    struct Entry {
        std::uint32_t triangle;
        std::uint32_t next;
    };
    std::int64_t cellOf(double x) const {
        return static_cast<std::int64_t>(std::floor(std::clamp(x / m_cell, -1e15, 1e15)));
    }
    std::size_t slot(std::int64_t x, std::int64_t y) const {
        return mix64(mix64(static_cast<std::uint64_t>(x)) ^ static_cast<std::uint64_t>(y)) & (m_heads.size() - 1);
    }

    double m_cell;
    std::vector<std::uint32_t> m_heads;
    std::vector<Entry> m_entries;
    std::vector<Flat> m_triangles;
    std::vector<std::uint32_t> m_wide;
};

class Cutter {
public:
    explicit Cutter(const SurfaceMesh& mesh) : m_mesh(mesh), m_neighbours(trianglesAcross(mesh)) {
        m_areaVectors.reserve(mesh.triangles.size());
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            const glm::dvec3 a = corner(t, 0);
            const glm::dvec3 doubled = glm::cross(corner(t, 1) - a, corner(t, 2) - a);
            m_areaVectors.push_back(doubled * 0.5);
        }
        m_taken.assign(mesh.triangles.size(), false);
    }

    std::vector<Chart> cut() {
        std::vector<Chart> charts;
        std::vector<std::uint32_t> seeds;
        for (std::uint32_t t = 0; t < m_mesh.triangleCount(); ++t) {
            if (glm::dot(m_areaVectors[t], m_areaVectors[t]) > 0.0) {
                seeds.push_back(t);
            } else {
                m_taken[t] = true;
            }
        }
        m_met.assign(m_taken.size(), 0);
        // Each round lays at least the seed of every region, so it ends.
        while (!seeds.empty()) {
            for (const std::uint32_t seed : seeds) {
                if (!m_taken[seed]) charts.push_back(lay(grow(seed)));
            }
            std::vector<std::uint32_t> open;
            for (const std::uint32_t t : seeds) {
                if (!m_taken[t]) open.push_back(t);
            }
            seeds = std::move(open);
        }
        return charts;
    }

private:
    glm::dvec3 corner(std::uint32_t t, int k) const { return glm::dvec3(m_mesh.positions[m_mesh.triangles[t][k]]); }
    glm::dvec3 normal(std::uint32_t t) const { return glm::normalize(m_areaVectors[t]); }

    // Free triangles around `seed` whose normals stay near the mean of the region, nearest first.
    std::vector<std::uint32_t> grow(std::uint32_t seed) {
        ++m_round;
        std::vector<std::uint32_t> region{seed};
        m_met[seed] = m_round;
        glm::dvec3 sum = m_areaVectors[seed];
        for (std::size_t i = 0; i < region.size() && region.size() < m_mostGrown; ++i) {
            for (const std::uint32_t next : m_neighbours[region[i]]) {
                if (next == none || m_taken[next] || m_met[next] == m_round) continue;
                const double length = glm::length(sum);
                if (!(length > 0.0) || glm::dot(normal(next), sum) < coneCosine * length) continue;
                m_met[next] = m_round;
                sum += m_areaVectors[next];
                region.push_back(next);
            }
        }
        return region;
    }

    // Flattens the region along its mean normal; what would overlap or lean too far stays free for another chart.
    Chart lay(const std::vector<std::uint32_t>& region) {
        glm::dvec3 axis(0.0);
        for (const std::uint32_t t : region) axis += m_areaVectors[t];
        if (!(glm::dot(axis, m_areaVectors[region[0]]) >
              leastShadow * glm::length(axis) * glm::length(m_areaVectors[region[0]]))) {
            axis = m_areaVectors[region[0]];
        }
        axis = glm::normalize(axis);
        const glm::dvec3 least = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 right = glm::normalize(glm::cross(least, axis));
        const glm::dvec3 up = glm::cross(axis, right);
        const glm::dvec3 origin = corner(region[0], 0);

        double sides = 0.0;
        for (const std::uint32_t t : region) sides += glm::length(corner(t, 1) - corner(t, 0));
        Layout layout(std::max(sides / static_cast<double>(region.size()), 1e-300), region.size());
        Chart chart;
        for (const std::uint32_t t : region) {
            if (t != region[0] && !besideLaid(t)) continue;
            if (glm::dot(normal(t), axis) < leastShadow) continue;
            Flat flat;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 p = corner(t, k) - origin;
                flat[static_cast<std::size_t>(k)] = {glm::dot(p, right), glm::dot(p, up)};
            }
            if (!layout.add(flat)) continue;
            m_taken[t] = true;
            m_met[t] = laid();
            chart.triangles.push_back(t);
            chart.corners.insert(chart.corners.end(), flat.begin(), flat.end());
        }
        // Where surfaces fold over themselves most of a region is in vain; smaller ones keep the work in proportion.
        const std::size_t taken = chart.triangles.size();
        m_mostGrown = taken * 8 < region.size() ? std::max<std::size_t>(256, taken * 8) : m_mostGrown * 2;
        m_mostGrown = std::min(m_mostGrown, m_taken.size() + 1);
        turn(chart);
        return chart;
    }

    // Marks of `m_met` for triangles of the chart that is being laid; even and odd numbers never meet.
    std::uint64_t laid() const { return m_round | (1ull << 63); }
    bool besideLaid(std::uint32_t t) const {
        for (const std::uint32_t next : m_neighbours[t]) {
            if (next != none && m_met[next] == laid()) return true;
        }
        return false;
    }

    // Turns the chart so that its box is smallest, wider than high, and moves it to the origin.
    static void turn(Chart& chart) {
        constexpr int steps = 24;
        double bestArea = std::numeric_limits<double>::infinity();
        glm::dvec2 best(1.0, 0.0), bestLow(0.0), bestSize(0.0);
        const auto rotated = [](const glm::dvec2& p, const glm::dvec2& turn) {
            return glm::dvec2(p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x);
        };
        for (int step = 0; step < steps; ++step) {
            const double angle = std::numbers::pi * step / steps;
            const glm::dvec2 direction(std::cos(angle), std::sin(angle));
            glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
            for (const glm::dvec2& p : chart.corners) {
                const glm::dvec2 q = rotated(p, direction);
                low = glm::min(low, q);
                high = glm::max(high, q);
            }
            const glm::dvec2 size = high - low;
            if (size.x * size.y < bestArea * 0.999 && size.x >= size.y * 0.999999) {
                bestArea = size.x * size.y;
                best = direction;
                bestLow = low;
                bestSize = size;
            }
        }
        for (glm::dvec2& p : chart.corners) p = rotated(p, best) - bestLow;
        chart.size = bestSize;
    }

    const SurfaceMesh& m_mesh;
    Neighbours m_neighbours;
    std::vector<glm::dvec3> m_areaVectors;
    std::vector<bool> m_taken;
    std::vector<std::uint64_t> m_met;
    std::uint64_t m_round = 0;
    std::size_t m_mostGrown = std::numeric_limits<std::size_t>::max() / 2;
};

}  // namespace

std::vector<Chart> makeCharts(const SurfaceMesh& mesh) {
    return Cutter(mesh).cut();
}

}  // namespace whorl::atlas
