// SPDX-License-Identifier: Apache-2.0
#include "core/surface/band_search.h"

#include "core/base/parallel.h"
#include "core/surface/disc_ranges.kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace whorl {
namespace {

// Cells of this many nodes a side are the pieces of parallel work, those of `leafSize` are searched node by node.
constexpr int taskSize = 32;
constexpr int leafSize = 2;
// Triangles, each in a disc around it, relative to the origin of the grid; in separate arrays, so that many are looked
// at in one go. A triangle without area has no normal; then the disc is a ball.
struct Candidates {
    std::vector<std::uint32_t> triangles;
    std::vector<float> values[7];  // x, y, z, radius, normal x, y, z

    std::size_t count() const { return triangles.size(); }
    bool empty() const { return triangles.empty(); }
    float radius(std::size_t i) const { return values[3][i]; }
    DiscArrays discs() const {
        return {values[0].data(), values[1].data(), values[2].data(), values[3].data(),
                values[4].data(), values[5].data(), values[6].data()};
    }
    void resize(std::size_t count) {
        triangles.resize(count);
        for (std::vector<float>& each : values) each.resize(count);
    }
    void copy(std::size_t to, const Candidates& from, std::size_t i) {
        triangles[to] = from.triangles[i];
        for (int k = 0; k < 7; ++k) values[k][to] = from.values[k][i];
    }
};

// Squared distances of the candidates.
struct Ranges {
    std::vector<float> low;
    std::vector<float> high;

    void measure(const Candidates& candidates, float x, float y, float z) {
        if (low.size() < candidates.count()) {
            low.resize(candidates.count());
            high.resize(candidates.count());
        }
        WHORL_PICK(discRanges)(candidates.discs(), candidates.count(), x, y, z, low.data(), high.data());
    }
};

struct Cell {
    int first[3];
    int size;
};

struct Task {
    Cell cell;
    Candidates candidates;
};

class BandSearch {
public:
    BandSearch(const SurfaceMesh& mesh, const NodeGrid& grid, float band,
               const std::function<void(const NodeHit&)>& visit)
        : m_mesh(mesh), m_grid(grid), m_band(band), m_visit(visit), m_slack(1e-3f * grid.spacing) {
        const Vec3d origin(grid.origin);
        m_all.resize(mesh.triangles.size());
        std::uint32_t count = 0;
        for (const glm::uvec3& t : mesh.triangles) {
            const Vec3d a = Vec3d(mesh.positions[t.x]) - origin;
            const Vec3d b = Vec3d(mesh.positions[t.y]) - origin;
            const Vec3d c = Vec3d(mesh.positions[t.z]) - origin;
            const Vec3d centre = (a + b + c) / 3.0;
            const double radius = std::max({glm::length(a - centre), glm::length(b - centre), glm::length(c - centre)});
            const Vec3d across = glm::cross(b - a, c - a);
            const double area = glm::length(across);
            // The normal of a sliver can be far off; then the disc would not hold the triangle.
            const bool sound = area > 1e-5 * radius * radius;
            const glm::vec3 normal = sound ? glm::vec3(across / area) : glm::vec3(0.0f);
            m_all.triangles[count] = count;
            const float values[7] = {static_cast<float>(centre.x),
                                     static_cast<float>(centre.y),
                                     static_cast<float>(centre.z),
                                     static_cast<float>(radius),
                                     normal.x,
                                     normal.y,
                                     normal.z};
            for (int k = 0; k < 7; ++k) m_all.values[k][count] = values[k];
            ++count;
        }
    }

    void run() {
        int size = taskSize;
        while (size < std::max({m_grid.size[0], m_grid.size[1], m_grid.size[2]})) size *= 2;
        std::vector<Task> tasks;
        split({{0, 0, 0}, size}, m_all, tasks);
        parallelFor(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Scratch scratch;
                search(tasks[i].cell, tasks[i].candidates, scratch, 0);
            }
        });
    }

private:
    // The eight halves of a cell that have nodes in the grid.
    template <class Visit>
    void forChildren(const Cell& cell, Visit&& visit) const {
        const int half = cell.size / 2;
        for (int child = 0; child < 8; ++child) {
            const Cell part{{cell.first[0] + (child & 1) * half, cell.first[1] + (child >> 1 & 1) * half,
                             cell.first[2] + (child >> 2) * half},
                            half};
            if (part.first[0] < m_grid.size[0] && part.first[1] < m_grid.size[1] && part.first[2] < m_grid.size[2])
                visit(part);
        }
    }

    void split(const Cell& cell, const Candidates& candidates, std::vector<Task>& tasks) const {
        if (cell.size == taskSize) {
            tasks.push_back({cell, candidates});
            return;
        }
        Candidates kept;
        Ranges ranges;
        forChildren(cell, [&](const Cell& child) {
            filter(child, candidates, kept, ranges);
            if (!kept.empty()) split(child, kept, tasks);
        });
    }

    struct Scratch {
        Candidates kept[8];  // one a level
        Ranges ranges;
    };

    void search(const Cell& cell, const Candidates& candidates, Scratch& scratch, std::size_t level) const {
        if (cell.size == leafSize) {
            searchNodes(cell, candidates, scratch.ranges);
            return;
        }
        forChildren(cell, [&](const Cell& child) {
            Candidates& kept = scratch.kept[level];
            filter(child, candidates, kept, scratch.ranges);
            if (!kept.empty()) search(child, kept, scratch, level + 1);
        });
    }

    // Keeps the triangles that can be nearest to a node of the cell: with c its centre and h its half diagonal, the
    // nearest one of a node is within d(c) + h of it, so within d(c) + 2 h of c.
    void filter(const Cell& cell, const Candidates& candidates, Candidates& kept, Ranges& ranges) const {
        const float half = 0.5f * static_cast<float>(cell.size - 1) * m_grid.spacing;
        const float halfDiagonal = half * 1.7320509f;
        const float x = static_cast<float>(cell.first[0]) * m_grid.spacing + half;
        const float y = static_cast<float>(cell.first[1]) * m_grid.spacing + half;
        const float z = static_cast<float>(cell.first[2]) * m_grid.spacing + half;
        const Vec3d centre =
            Vec3d(m_grid.origin) + Vec3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        ranges.measure(candidates, x, y, z);
        const std::size_t count = candidates.count();
        const float limit = m_band + halfDiagonal + m_slack;
        float least = limit * limit;  // squared distance of the nearest triangle, or more
        for (std::size_t i = 0; i < count; ++i) least = std::min(least, ranges.high[i]);
        const auto reachOf = [&](float squared) {
            const float reach = std::min(limit, std::sqrt(squared) + 2.0f * halfDiagonal + m_slack);
            return reach * reach;
        };
        // The disc of a triangle that is large beside the cell says little; measure the triangle.
        for (std::size_t i = 0; i < count; ++i) {
            if (candidates.radius(i) <= 2.0f * halfDiagonal || ranges.low[i] > reachOf(least)) continue;
            ranges.low[i] = static_cast<float>(closest(candidates.triangles[i], centre).distanceSquared);
            least = std::min(least, ranges.low[i]);
        }
        const float reach = reachOf(least);
        kept.resize(count);
        std::size_t keptCount = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (ranges.low[i] <= reach) kept.copy(keptCount++, candidates, i);
        }
        kept.resize(keptCount);
    }

    void searchNodes(const Cell& cell, const Candidates& candidates, Ranges& ranges) const {
        std::uint32_t guess = candidates.triangles.front();
        for (int z = cell.first[2]; z < std::min(cell.first[2] + leafSize, m_grid.size[2]); ++z) {
            for (int y = cell.first[1]; y < std::min(cell.first[1] + leafSize, m_grid.size[1]); ++y) {
                for (int x = cell.first[0]; x < std::min(cell.first[0] + leafSize, m_grid.size[0]); ++x)
                    guess = searchNode(x, y, z, guess, candidates, ranges);
            }
        }
    }

    // Starts with `guess`, which is near, so that most others are ruled out by their discs. Gives the nearest.
    std::uint32_t searchNode(int x, int y, int z, std::uint32_t guess, const Candidates& candidates,
                             Ranges& ranges) const {
        const Vec3d p = m_grid.node(x, y, z);
        ranges.measure(candidates, static_cast<float>(x) * m_grid.spacing, static_cast<float>(y) * m_grid.spacing,
                       static_cast<float>(z) * m_grid.spacing);
        ClosestPoint best = closest(guess, p);
        std::uint32_t triangle = guess;
        auto bestSquared = static_cast<float>(best.distanceSquared);
        const auto reachOf = [&](float squared) {
            const float reach = std::sqrt(squared) + m_slack;
            return reach * reach;
        };
        float reach = reachOf(bestSquared);
        for (std::size_t i = 0; i < candidates.count(); ++i) {
            if (ranges.low[i] > reach) continue;
            const std::uint32_t t = candidates.triangles[i];
            if (t == guess) continue;
            const ClosestPoint place = closest(t, p);
            const auto squared = static_cast<float>(place.distanceSquared);
            if (squared < bestSquared || (squared == bestSquared && t < triangle)) {
                best = place;
                triangle = t;
                bestSquared = squared;
                reach = reachOf(squared);
            }
        }
        const auto distance = static_cast<float>(std::sqrt(best.distanceSquared));
        if (distance <= m_band) {
            m_visit({m_grid.index(x, y, z),
                     p,
                     {triangle, static_cast<float>(best.u), static_cast<float>(best.v)},
                     distance});
        }
        return triangle;
    }

    ClosestPoint closest(std::uint32_t triangle, const Vec3d& p) const {
        const glm::uvec3 t = m_mesh.triangles[triangle];
        return closestPoint(Vec3d(m_mesh.positions[t.x]), Vec3d(m_mesh.positions[t.y]), Vec3d(m_mesh.positions[t.z]),
                            p);
    }

    const SurfaceMesh& m_mesh;
    const NodeGrid& m_grid;
    float m_band;
    const std::function<void(const NodeHit&)>& m_visit;
    float m_slack;  // more than rounding can be
    Candidates m_all;
};

}  // namespace

void searchBand(const SurfaceMesh& mesh, const NodeGrid& grid, float band,
                const std::function<void(const NodeHit&)>& visit) {
    BandSearch(mesh, grid, band, visit).run();
}

}  // namespace whorl
