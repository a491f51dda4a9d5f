// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/sub_triangle_positions.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>
#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

// Weighted sample elimination (Yuksel, "Sample Elimination for Generating Poisson Disk Sample Sets", 2015): from a pool
// of candidates, the one with the most and nearest neighbours goes, until `count` are left. Distances are measured in
// units of the local spacing, so that dense areas keep more.

namespace whorl {
namespace {

// Candidates around one that its density is averaged over, and that may push it out.
constexpr std::size_t densityNeighbours = 12;
constexpr std::size_t mostNeighbours = 40;

struct Pool {
    std::vector<SurfacePoint> points;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<float> densities;  // at the candidate
    std::vector<float> spacings;   // one over the square root of the density around it
};

struct PoolAdaptor {
    const std::vector<glm::vec3>& positions;
    std::size_t kdtree_get_point_count() const { return positions.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return positions[i][static_cast<glm::length_t>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PoolAdaptor>, PoolAdaptor, 3>;

Pool makePool(const SurfaceMesh& mesh, const SubTriangleSampler& sampler, std::size_t size, std::uint32_t seed) {
    constexpr std::uint32_t channel = 0x67756964;  // apart from the roots of hairs with the same seed
    Pool pool;
    pool.points.resize(size);
    pool.positions.resize(size);
    pool.normals.resize(size);
    pool.densities.resize(size);
    pool.spacings.resize(size);
    parallelFor(size, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double jitter = unitDouble(randomBits(seed, i, channel));
            const std::uint64_t inside = randomBits(seed, i, channel + 1);
            const std::size_t chosen = sampler.select((static_cast<double>(i) + jitter) / static_cast<double>(size));
            const SurfacePoint point = sampler.place(chosen, unitFloat(inside), unitFloat(inside << 24));
            const SubTriangleSampler::SubTriangle& sub = sampler.subTriangles()[chosen];
            const double area = std::ldexp(triangleArea(mesh, point.triangle), -2 * depthOfPosition(sub.position));
            pool.points[i] = point;
            pool.positions[i] = positionAt(mesh, point);
            pool.normals[i] = triangleNormal(mesh, point.triangle);
            pool.densities[i] = static_cast<float>(static_cast<double>(sub.weight) / area);
        }
    });
    return pool;
}

// A candidate that `i` crowds, and by how much.
struct Neighbour {
    std::uint32_t index;
    float weight;
};

// Neighbours of all candidates: those of i are [first[i], first[i + 1]).
struct Neighbourhoods {
    std::vector<std::size_t> first;
    std::vector<Neighbour> all;
};

struct Elimination {
    float reach;      // 2 r_max, in units of the local spacing
    float nearLimit;  // nearer than this counts as this: what is that near is cut anyway (2 r_min)

    float weight(float distance) const {
        const float w = 1.0f - std::max(distance, nearLimit) / reach;
        const float w2 = w * w;
        const float w4 = w2 * w2;
        return w4 * w4;
    }
};

// Calls visit(j, squared distance) for the nearest candidates, i itself excluded.
template <class Visit>
void forNearest(const Tree& tree, const Pool& pool, std::size_t i, std::size_t count, Visit&& visit) {
    std::array<std::uint32_t, mostNeighbours + 1> indices;
    std::array<float, mostNeighbours + 1> distances;
    const std::size_t found = tree.knnSearch(&pool.positions[i].x, count + 1, indices.data(), distances.data());
    for (std::size_t k = 0; k < found; ++k) {
        if (indices[k] != i) visit(indices[k], distances[k]);
    }
}

void measureSpacings(const Tree& tree, Pool& pool) {
    parallelFor(pool.points.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            // Candidates lie as dense as the density, so the mean of 1 / density is area / weight around here.
            double sum = 1.0 / static_cast<double>(pool.densities[i]);
            int count = 1;
            forNearest(tree, pool, i, densityNeighbours, [&](std::uint32_t j, float) {
                sum += 1.0 / static_cast<double>(pool.densities[j]);
                ++count;
            });
            pool.spacings[i] = static_cast<float>(std::sqrt(sum / count));
        }
    });
}

Neighbourhoods findNeighbours(const Tree& tree, const Pool& pool, const Elimination& elimination) {
    const std::size_t size = pool.points.size();
    std::vector<std::vector<Neighbour>> found(size);  // of each, those with a smaller spacing
    parallelFor(size, 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            forNearest(tree, pool, i, mostNeighbours, [&](std::uint32_t j, float squared) {
                // Each pair once: from the one that reaches farther.
                if (std::pair(pool.spacings[j], j) >= std::pair(pool.spacings[i], static_cast<std::uint32_t>(i)))
                    return;
                // Two sides of a thin ear do not crowd each other.
                if (glm::dot(pool.normals[i], pool.normals[j]) < 0.0f) return;
                const float distance = std::sqrt(squared) * 2.0f / (pool.spacings[i] + pool.spacings[j]);
                if (distance < elimination.reach) found[i].push_back({j, elimination.weight(distance)});
            });
        }
    });
    Neighbourhoods result;
    result.first.assign(size + 1, 0);
    for (std::size_t i = 0; i < size; ++i) {
        result.first[i + 1] += found[i].size();
        for (const Neighbour& other : found[i]) ++result.first[other.index + 1];
    }
    for (std::size_t i = 0; i < size; ++i) result.first[i + 1] += result.first[i];
    result.all.resize(result.first.back());
    std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
    for (std::size_t i = 0; i < size; ++i) {
        for (const Neighbour& other : found[i]) {
            result.all[next[i]++] = other;
            result.all[next[other.index]++] = {static_cast<std::uint32_t>(i), other.weight};
        }
    }
    return result;
}

}  // namespace

Result<std::vector<SurfacePoint>> evenRoots(const SurfaceMesh& mesh, const SubTriangleSampler& sampler,
                                            std::size_t count, std::uint32_t seed, Progress& progress) {
    std::vector<SurfacePoint> roots;
    if (count == 0 || sampler.empty()) return roots;
    // Five to one as in the paper; for very many roots less, to bound time and memory.
    const std::size_t size = std::max<std::size_t>(count <= 200000 ? 5 * count : 2 * count, 100);
    Pool pool = makePool(mesh, sampler, size, seed);
    progress.report(0.1f, "Spreading guides");
    const PoolAdaptor adaptor{pool.positions};
    const Tree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    if (progress.cancelled()) return cancelledError();
    measureSpacings(tree, pool);
    progress.report(0.2f, "Spreading guides");
    if (progress.cancelled()) return cancelledError();

    // Radius of the densest packing of `count` discs on an area of `total`, which is what the surface is when measured
    // in local spacings; and the limits that the paper recommends.
    const double radius = std::sqrt(sampler.total() / (2.0 * std::sqrt(3.0) * static_cast<double>(count)));
    const double ratio = static_cast<double>(count) / static_cast<double>(size);
    const Elimination elimination{static_cast<float>(2.0 * radius),
                                  static_cast<float>(2.0 * radius * (1.0 - std::pow(ratio, 1.5)) * 0.65)};
    const Neighbourhoods near = findNeighbours(tree, pool, elimination);
    progress.report(0.5f, "Spreading guides");

    std::vector<double> crowding(size, 0.0);
    using Entry = std::pair<double, std::uint32_t>;
    std::vector<Entry> entries;
    entries.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t k = near.first[i]; k < near.first[i + 1]; ++k)
            crowding[i] += static_cast<double>(near.all[k].weight);
        entries.emplace_back(crowding[i], static_cast<std::uint32_t>(i));
    }
    // Entries whose crowding has changed since are stale; a newer one of the same candidate is in the queue.
    std::priority_queue<Entry> queue(std::less<Entry>(), std::move(entries));
    std::vector<bool> gone(size, false);
    for (std::size_t left = size; left > count;) {
        const auto [crowd, i] = queue.top();
        queue.pop();
        if (gone[i] || crowd != crowding[i]) continue;
        gone[i] = true;
        --left;
        for (std::size_t k = near.first[i]; k < near.first[i + 1]; ++k) {
            const Neighbour& other = near.all[k];
            if (gone[other.index]) continue;
            crowding[other.index] -= static_cast<double>(other.weight);
            queue.emplace(crowding[other.index], other.index);
        }
        if (left % 1024 == 0) {
            if (progress.cancelled()) return cancelledError();
            progress.report(1.0f - 0.5f * static_cast<float>(left) / static_cast<float>(size), "Spreading guides");
        }
    }
    for (std::size_t i = 0; i < size; ++i) {
        if (!gone[i]) roots.push_back(pool.points[i]);
    }
    return roots;
}

}  // namespace whorl
