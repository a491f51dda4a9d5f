// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/sub_triangle_sampler.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/hilbert.h"
#include "core/sampling/sub_triangle_positions.h"
#include "core/sampling/texel_depth.h"
#include "core/surface/surface_point.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

namespace whorl {
namespace {

using SubTriangle = SubTriangleSampler::SubTriangle;

constexpr std::size_t trianglesPerBlock = 256;

// Subdivides one triangle depth first and keeps what has weight.
class Subdivider {
public:
    Subdivider(const SurfaceMesh& mesh, const DensityLookup& density, std::uint32_t triangle, int depth,
               std::vector<SubTriangle>& out)
        : m_density(density), m_out(out), m_triangle(triangle), m_depth(depth), m_area(triangleArea(mesh, triangle)) {
        const std::size_t corner = std::size_t{3} * triangle;
        m_uv = mesh.cornerUvs[corner];
        m_toB = mesh.cornerUvs[corner + 1] - m_uv;
        m_toC = mesh.cornerUvs[corner + 2] - m_uv;
    }

    void run() {
        if (m_area > 0.0 && m_density.growsOn(m_triangle)) visit({}, wholeTriangle, 0);
    }

private:
    // Stores the sub-triangle or its parts. Returns its density when it is stored whole, else a negative number.
    float visit(const SubTrianglePlace& place, std::uint32_t position, int depth) {
        if (depth == m_depth) {
            const float density =
                m_density.at(m_triangle, m_uv + m_toB * place.barycentreU() + m_toC * place.barycentreV());
            store(position, depth, density);
            return density;
        }
        const std::size_t first = m_out.size();
        std::array<float, 4> densities{};
        // Middle one second: consecutive ones then touch, which keeps ranges of the distribution compact.
        for (const unsigned j : {0u, 3u, 1u, 2u})
            densities[j] = visit(place.child(j), childPosition(position, j), depth + 1);
        const float density = densities[0];
        if (density < 0.0f || densities[1] != density || densities[2] != density || densities[3] != density)
            return -1.0f;
        m_out.resize(first);
        store(position, depth, density);
        return density;
    }

    void store(std::uint32_t position, int depth, float density) {
        const double weight = std::ldexp(m_area, -2 * depth) * static_cast<double>(density);
        const double most = static_cast<double>(std::numeric_limits<float>::max());
        const auto rounded = static_cast<float>(std::min(weight, most));
        if (rounded > 0.0f) m_out.push_back({m_triangle, position, rounded});
    }

    const DensityLookup& m_density;
    std::vector<SubTriangle>& m_out;
    std::uint32_t m_triangle;
    int m_depth;
    double m_area;
    glm::vec2 m_uv{0.0f};
    glm::vec2 m_toB{0.0f};
    glm::vec2 m_toC{0.0f};
};

}  // namespace

Result<SubTriangleSampler> SubTriangleSampler::build(const SurfaceMesh& mesh, const DensityLookup& density,
                                                     const Options& options, Progress& progress) {
    SubTriangleSampler sampler;
    const std::size_t triangles = mesh.triangles.size();
    const int maxDepth = std::clamp(options.maxDepth, 0, deepestSubdivision);
    const std::vector<std::uint32_t> order = hilbertOrder(mesh);
    std::vector<std::uint8_t> depths(triangles);
    parallelFor(triangles, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            depths[t] = static_cast<std::uint8_t>(
                texelDepth(mesh, static_cast<std::uint32_t>(t), density.mapWidth(), density.mapHeight(), maxDepth));
        }
    });
    const int allowed = allowedDepth(depths, maxDepth, options.maxSubTriangles);

    std::vector<std::vector<SubTriangle>> blocks((triangles + trianglesPerBlock - 1) / trianglesPerBlock);
    std::atomic<std::size_t> done{0};
    parallelFor(triangles, trianglesPerBlock, [&](std::size_t begin, std::size_t end) {
        if (progress.cancelled()) return;
        std::vector<SubTriangle>& block = blocks[begin / trianglesPerBlock];
        for (std::size_t i = begin; i < end; ++i)
            Subdivider(mesh, density, order[i], std::min<int>(depths[order[i]], allowed), block).run();
        const std::size_t sum = done.fetch_add(end - begin, std::memory_order_relaxed) + (end - begin);
        progress.report(0.9f * static_cast<float>(sum) / static_cast<float>(triangles), "Measuring density");
    });
    if (progress.cancelled()) return cancelledError();

    std::vector<std::size_t> firstOfBlock(blocks.size() + 1, 0);
    for (std::size_t i = 0; i < blocks.size(); ++i) firstOfBlock[i + 1] = firstOfBlock[i] + blocks[i].size();
    sampler.m_subTriangles.resize(firstOfBlock.back());
    parallelFor(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::copy(blocks[i].begin(), blocks[i].end(),
                      sampler.m_subTriangles.begin() + static_cast<std::ptrdiff_t>(firstOfBlock[i]));
            blocks[i] = {};
        }
    });
    sampler.m_places = subTrianglePlaces(allowed).data();
    sampler.buildDistribution(options.gridPercent);
    return sampler;
}

void SubTriangleSampler::buildDistribution(float gridPercent) {
    const std::size_t count = m_subTriangles.size();
    if (count == 0) return;
    m_cumulative.resize(count);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        sum += static_cast<double>(m_subTriangles[i].weight);
        m_cumulative[i] = sum;
    }
    m_total = sum;

    const double share = gridPercent > 0.0f ? static_cast<double>(std::min(gridPercent, 400.0f)) / 100.0 : 0.0;
    const auto cells = static_cast<std::size_t>(std::ceil(static_cast<double>(count) * share));
    if (cells == 0) return;
    m_grid.resize(cells + 1);
    m_cellsPerWeight = static_cast<double>(cells) / sum;
    // `cellOf` never decreases, so whatever it rounds to, the answer for a weight in cell c is not before the first
    // sub-triangle whose sum reaches cell c, and not after the first whose sum is in a later cell.
    std::size_t next = 0;
    for (std::size_t i = 0; i < count && next < cells; ++i) {
        for (const std::size_t cell = cellOf(m_cumulative[i]); next <= cell; ++next)
            m_grid[next] = static_cast<std::uint32_t>(i);
    }
    for (; next <= cells; ++next) m_grid[next] = static_cast<std::uint32_t>(count - 1);
}

std::size_t SubTriangleSampler::memoryBytes() const {
    return m_subTriangles.capacity() * sizeof(SubTriangle) + m_cumulative.capacity() * sizeof(double) +
           m_grid.capacity() * sizeof(std::uint32_t);
}

std::size_t SubTriangleSampler::cellOf(double weight) const {
    return std::min(static_cast<std::size_t>(weight * m_cellsPerWeight), m_grid.size() - 2);
}

// First sub-triangle in [begin, end) whose sum is above `weight`; `end` when there is none.
std::size_t SubTriangleSampler::find(double weight, std::size_t begin, std::size_t end) const {
    while (begin < end) {
        const std::size_t middle = begin + (end - begin) / 2;
        if (m_cumulative[middle] > weight) {
            end = middle;
        } else {
            begin = middle + 1;
        }
    }
    return begin;
}

std::size_t SubTriangleSampler::select(double selection) const {
    assert(!empty());
    const double weight = selection * m_total;
    if (m_grid.empty()) return find(weight, 0, m_subTriangles.size() - 1);
    const std::size_t cell = cellOf(weight);
    return find(weight, m_grid[cell], m_grid[cell + 1]);
}

SurfacePoint SubTriangleSampler::place(std::size_t subTriangle, float a, float b) const {
    const SubTriangle& chosen = m_subTriangles[subTriangle];
    const SubTrianglePlace in = chosen.position == wholeTriangle ? SubTrianglePlace{} : m_places[chosen.position];
    const float root = std::sqrt(a);
    const float u = std::clamp(in.u + in.size * (1.0f - root), 0.0f, 1.0f);
    const float v = std::clamp(in.v + in.size * (b * root), 0.0f, 1.0f - u);
    return {chosen.triangle, u, v};
}

SurfacePoint SubTriangleSampler::sample(double selection, float a, float b) const {
    return place(select(selection), a, b);
}

SurfacePoint SubTriangleSampler::sampleByBisection(double selection, float a, float b) const {
    return place(find(selection * m_total, 0, m_subTriangles.size() - 1), a, b);
}

SurfacePoint SubTriangleSampler::stratifiedRoot(std::uint64_t index, std::uint64_t count, std::uint32_t seed) const {
    assert(index < count);
    // Far from the channels that the generator uses for shape and colour.
    constexpr std::uint32_t channel = 0x726f6f74;
    const double jitter = unitDouble(randomBits(seed, index, channel));
    const std::uint64_t inside = randomBits(seed, index, channel + 1);
    return sample((static_cast<double>(index) + jitter) / static_cast<double>(count), unitFloat(inside),
                  unitFloat(inside << 24));
}

}  // namespace whorl
