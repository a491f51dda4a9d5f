// SPDX-License-Identifier: Apache-2.0
#include "core/surface/band_search.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace whorl {
namespace {

// Cells of this many nodes a side are the pieces of parallel work, those of `leafSize` are searched node by node.
constexpr int taskSize = 32;
constexpr int leafSize = 2;
using List = std::vector<std::uint32_t>;

// A disc around a triangle, relative to the origin of the grid. A triangle without area has no normal; then a ball.
struct Disc {
    float x, y, z, radius;
    float nx, ny, nz;
};

// Between which two distances from a point a disc lies.
struct Range {
    float low;
    float high;
};

// Nothing when the disc is farther than `reach`.
inline bool rangeOf(const Disc& disc, float x, float y, float z, float reach, Range& range) {
    const float dx = disc.x - x;
    const float dy = disc.y - y;
    const float dz = disc.z - z;
    const float squared = dx * dx + dy * dy + dz * dz;
    if (squared > (disc.radius + reach) * (disc.radius + reach)) return false;
    const float height = dx * disc.nx + dy * disc.ny + dz * disc.nz;
    const float beside = std::sqrt(std::max(squared - height * height, 0.0f));
    const float inner = std::max(beside - disc.radius, 0.0f);
    const float outer = beside + disc.radius;
    range.low = height * height + inner * inner;
    if (range.low > reach * reach) return false;
    range.low = std::sqrt(range.low);
    range.high = std::sqrt(height * height + outer * outer);
    return true;
}

struct Cell {
    int first[3];
    int size;
};

struct Task {
    Cell cell;
    List candidates;
};

class BandSearch {
public:
    BandSearch(const SurfaceMesh& mesh, const NodeGrid& grid, float band,
               const std::function<void(const NodeHit&)>& visit)
        : m_mesh(mesh), m_grid(grid), m_band(band), m_visit(visit), m_slack(1e-3f * grid.spacing) {
        const Vec3d origin(grid.origin);
        m_discs.reserve(mesh.triangles.size());
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
            m_discs.push_back({static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z),
                               static_cast<float>(radius), normal.x, normal.y, normal.z});
        }
    }

    void run() {
        int size = taskSize;
        while (size < std::max({m_grid.size[0], m_grid.size[1], m_grid.size[2]})) size *= 2;
        List all(m_discs.size());
        for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
        std::vector<Task> tasks;
        split({{0, 0, 0}, size}, all, tasks);
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

    void split(const Cell& cell, const List& candidates, std::vector<Task>& tasks) const {
        if (cell.size == taskSize) {
            tasks.push_back({cell, candidates});
            return;
        }
        List kept;
        std::vector<float> scratch;
        forChildren(cell, [&](const Cell& child) {
            filter(child, candidates, kept, scratch);
            if (!kept.empty()) split(child, kept, tasks);
        });
    }

    struct Scratch {
        std::vector<List> lists = std::vector<List>(8);  // one a level
        std::vector<float> nearest;
    };

    void search(const Cell& cell, const List& candidates, Scratch& scratch, std::size_t level) const {
        if (cell.size == leafSize) {
            searchNodes(cell, candidates);
            return;
        }
        forChildren(cell, [&](const Cell& child) {
            List& kept = scratch.lists[level];
            filter(child, candidates, kept, scratch.nearest);
            if (!kept.empty()) search(child, kept, scratch, level + 1);
        });
    }

    // Keeps the triangles that can be nearest to a node of the cell: with c its centre and h its half diagonal, the
    // nearest one of a node is within d(c) + h of it, so within d(c) + 2 h of c.
    void filter(const Cell& cell, const List& candidates, List& kept, std::vector<float>& scratch) const {
        const float half = 0.5f * static_cast<float>(cell.size - 1) * m_grid.spacing;
        const float halfDiagonal = half * 1.7320509f;
        const float x = static_cast<float>(cell.first[0]) * m_grid.spacing + half;
        const float y = static_cast<float>(cell.first[1]) * m_grid.spacing + half;
        const float z = static_cast<float>(cell.first[2]) * m_grid.spacing + half;
        const Vec3d centre =
            Vec3d(m_grid.origin) + Vec3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        float reach = m_band + halfDiagonal + m_slack;
        const float large = 2.0f * halfDiagonal;
        std::vector<float>& nearest = scratch;
        nearest.clear();
        kept.clear();
        for (const std::uint32_t t : candidates) {
            Range range{};
            if (!rangeOf(m_discs[t], x, y, z, reach, range)) continue;
            // The disc of a triangle that is large beside the cell says little.
            if (m_discs[t].radius > large) {
                range.low = static_cast<float>(std::sqrt(closest(t, centre).distanceSquared));
                range.high = range.low;
                if (range.low > reach) continue;
            }
            reach = std::min(reach, range.high + 2.0f * halfDiagonal + m_slack);
            kept.push_back(t);
            nearest.push_back(range.low);
        }
        // The first ones were kept while the reach was still long.
        std::size_t count = 0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            kept[count] = kept[i];
            count += nearest[i] <= reach ? 1 : 0;
        }
        kept.resize(count);
    }

    void searchNodes(const Cell& cell, const List& candidates) const {
        std::uint32_t guess = candidates.front();
        for (int z = cell.first[2]; z < std::min(cell.first[2] + leafSize, m_grid.size[2]); ++z) {
            for (int y = cell.first[1]; y < std::min(cell.first[1] + leafSize, m_grid.size[1]); ++y) {
                for (int x = cell.first[0]; x < std::min(cell.first[0] + leafSize, m_grid.size[0]); ++x)
                    guess = searchNode(x, y, z, guess, candidates);
            }
        }
    }

    // Starts with `guess`, which is near, so that most others are ruled out by their discs. Gives the nearest.
    std::uint32_t searchNode(int x, int y, int z, std::uint32_t guess, const List& candidates) const {
        const Vec3d p = m_grid.node(x, y, z);
        const float px = static_cast<float>(x) * m_grid.spacing;
        const float py = static_cast<float>(y) * m_grid.spacing;
        const float pz = static_cast<float>(z) * m_grid.spacing;
        ClosestPoint best = closest(guess, p);
        std::uint32_t triangle = guess;
        auto bestSquared = static_cast<float>(best.distanceSquared);
        float limit = std::sqrt(bestSquared) + m_slack;
        for (const std::uint32_t t : candidates) {
            Range range{};
            if (t == guess || !rangeOf(m_discs[t], px, py, pz, limit, range)) continue;
            const ClosestPoint place = closest(t, p);
            const auto squared = static_cast<float>(place.distanceSquared);
            if (squared < bestSquared || (squared == bestSquared && t < triangle)) {
                best = place;
                triangle = t;
                bestSquared = squared;
                limit = std::sqrt(squared) + m_slack;
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
    std::vector<Disc> m_discs;
};

}  // namespace

void searchBand(const SurfaceMesh& mesh, const NodeGrid& grid, float band,
                const std::function<void(const NodeHit&)>& visit) {
    BandSearch(mesh, grid, band, visit).run();
}

}  // namespace whorl
