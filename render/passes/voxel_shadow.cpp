// SPDX-License-Identifier: Apache-2.0
#include "render/passes/voxel_shadow.h"

#include "core/base/parallel.h"
#include "render/passes/scene_block.h"
#include "render/passes/voxel_sum.kernel.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace whorl {
namespace {

constexpr int side = VoxelShadow::size;
constexpr std::size_t slice = std::size_t{side} * side;
constexpr std::size_t cells = slice * side;
constexpr float layersOfCoverage = 4.0f;
constexpr float fixedPoint = 1024.0f;  // counts of one layer
constexpr float softness = 1.0f / (VoxelShadow::nearLayers * fixedPoint);
constexpr std::size_t grain = 256;  // hairs

// Calls deposit(cell, amount) for short steps along the drawn hairs. `toGrid` maps to cells, x y z of a grid of `n`.
template <class Deposit>
void walk(const Strands& strands, std::uint32_t stride, std::size_t begin, std::size_t end, const glm::mat4& toGrid,
          int n, float countsOfArea, Deposit&& deposit) {
    const glm::vec3 x(toGrid[0]);
    const glm::vec3 y(toGrid[1]);
    const glm::vec3 z(toGrid[2]);
    const glm::vec3 origin(toGrid[3]);
    for (std::size_t i = begin; i < end; ++i) {
        const std::size_t hair = i * stride;
        const std::uint32_t first = strands.firstVertex[hair];
        const std::uint32_t last = strands.firstVertex[hair + 1];
        if (last - first < 2) continue;
        glm::vec3 from = strands.positions[first];
        glm::vec3 fromGrid = x * from.x + y * from.y + z * from.z + origin;
        for (std::uint32_t vertex = first + 1; vertex < last; ++vertex) {
            const glm::vec3 to = strands.positions[vertex];
            const glm::vec3 toGridPlace = x * to.x + y * to.y + z * to.z + origin;
            const glm::vec3 way = toGridPlace - fromGrid;
            const float reach = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
            const int steps = std::clamp(static_cast<int>(reach) + 1, 1, n);
            const glm::vec3 metres = to - from;
            const float length = std::sqrt(glm::dot(metres, metres));
            const float width = 0.5f * (strands.widths[vertex - 1] + strands.widths[vertex]);
            const float opacity = strands.colours[vertex].w;
            const auto amount = static_cast<std::uint32_t>(
                std::min(length * width * opacity * countsOfArea / static_cast<float>(steps) + 0.5f, 1e6f));
            const float share = 1.0f / static_cast<float>(steps);
            for (int step = 0; step < steps; ++step) {
                const glm::vec3 p = fromGrid + way * ((static_cast<float>(step) + 0.5f) * share);
                const int cx = std::clamp(static_cast<int>(p.x), 0, n - 1);
                const int cy = std::clamp(static_cast<int>(p.y), 0, n - 1);
                const int cz = std::clamp(static_cast<int>(p.z), 0, n - 1);
                deposit((static_cast<std::size_t>(cz) * static_cast<std::size_t>(n) + static_cast<std::size_t>(cy)) *
                                static_cast<std::size_t>(n) +
                            static_cast<std::size_t>(cx),
                        amount);
            }
            from = to;
            fromGrid = toGridPlace;
        }
    }
}

void add(std::uint32_t& cell, std::uint32_t amount) {
    std::atomic_ref<std::uint32_t>(cell).fetch_add(amount, std::memory_order_relaxed);
}

}  // namespace

Bounds vertexBounds(const Strands& strands) {
    constexpr std::size_t block = 16384;
    std::vector<Bounds> parts((strands.vertexCount() + block - 1) / block);
    parallelFor(strands.vertexCount(), block, [&](std::size_t begin, std::size_t end) {
        glm::vec3 low(1e30f);
        glm::vec3 high(-1e30f);
        for (std::size_t i = begin; i < end; ++i) {
            low = glm::min(low, strands.positions[i]);
            high = glm::max(high, strands.positions[i]);
        }
        parts[begin / block].min = low;
        parts[begin / block].max = high;
    });
    Bounds all;
    for (const Bounds& part : parts) {
        all.min = glm::min(all.min, part.min);
        all.max = glm::max(all.max, part.max);
    }
    return all;
}

void VoxelShadow::place(const Strands& strands, const glm::vec3& towardsLight) {
    const glm::mat3 axes = lightAxes(towardsLight);
    constexpr std::size_t block = 16384;
    std::vector<Bounds> parts((strands.vertexCount() + block - 1) / block);
    parallelFor(strands.vertexCount(), block, [&](std::size_t begin, std::size_t end) {
        glm::vec3 low(1e30f);
        glm::vec3 high(-1e30f);
        for (std::size_t i = begin; i < end; ++i) {
            const glm::vec3 p = axes * strands.positions[i];
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        parts[begin / block].min = low;
        parts[begin / block].max = high;
    });
    Bounds box;
    for (const Bounds& part : parts) {
        box.min = glm::min(box.min, part.min);
        box.max = glm::max(box.max, part.max);
    }
    // Two empty voxels around: outside the volume the texture repeats its border, which must mean no hair.
    const glm::vec3 extent =
        glm::max(box.size(), glm::vec3(1e-4f)) * (static_cast<float>(side) / static_cast<float>(side - 4));
    const glm::vec3 low = box.centre() - extent * 0.5f;
    const glm::vec3 scale(1.0f / extent.x, 1.0f / extent.y, 1.0f / extent.z);
    m_voxel = extent / static_cast<float>(side);
    m_matrix = glm::mat4(1.0f);
    // z runs with the light, away from the lamp.
    for (int column = 0; column < 3; ++column) {
        m_matrix[column] = glm::vec4(axes[column] * scale * glm::vec3(1.0f, 1.0f, -1.0f), 0.0f);
    }
    m_matrix[3] = glm::vec4(-low.x * scale.x, -low.y * scale.y, 1.0f + low.z * scale.z, 1.0f);
}

void VoxelShadow::build(const Strands& strands, const HairDetail& detail, const glm::vec3& towardsLight) {
    m_empty = strands.vertexCount() == 0;
    m_texels.resize(cells);
    if (m_empty) {
        std::fill(m_texels.begin(), m_texels.end(), std::uint16_t{0});
        return;
    }
    place(strands, towardsLight);
    m_counts.resize(cells);
    parallelFor(cells, slice * 8, [&](std::size_t begin, std::size_t end) {
        std::fill(m_counts.begin() + static_cast<std::ptrdiff_t>(begin),
                  m_counts.begin() + static_cast<std::ptrdiff_t>(end), 0u);
    });
    glm::mat4 toGrid = m_matrix;
    for (int column = 0; column < 4; ++column) toGrid[column] *= static_cast<float>(side);
    const float countsOfArea = layersOfCoverage * fixedPoint * detail.widthScale / (m_voxel.x * m_voxel.y);
    parallelFor(detail.hairs(strands), grain, [&](std::size_t begin, std::size_t end) {
        walk(strands, detail.stride, begin, end, toGrid, side, countsOfArea,
             [&](std::size_t cell, std::uint32_t amount) { add(m_counts[cell], amount); });
    });
    constexpr float texelsOfCount = 65535.0f / (fullLayers * fixedPoint);
    const auto sum = WHORL_PICK(sumVoxels);
    parallelFor(side, 16, [&](std::size_t begin, std::size_t end) {
        sum(m_counts.data(), m_texels.data(), texelsOfCount, softness, static_cast<int>(begin), static_cast<int>(end));
    });
}

void VoxelShadow::buildReference(const Strands& strands, const HairDetail& detail, const glm::vec3& towardsLight) {
    m_empty = strands.vertexCount() == 0;
    m_texels.assign(cells, 0);
    if (m_empty) return;
    place(strands, towardsLight);
    m_counts.assign(cells, 0);
    glm::mat4 toGrid = m_matrix;
    for (int column = 0; column < 4; ++column) toGrid[column] *= static_cast<float>(side);
    const float countsOfArea = layersOfCoverage * fixedPoint * detail.widthScale / (m_voxel.x * m_voxel.y);
    walk(strands, detail.stride, 0, detail.hairs(strands), toGrid, side, countsOfArea,
         [&](std::size_t cell, std::uint32_t amount) { m_counts[cell] += amount; });
    constexpr float texelsOfCount = 65535.0f / (fullLayers * fixedPoint);
    const auto count = [&](std::size_t x, std::size_t y, std::size_t z) { return m_counts[z * slice + y * side + x]; };
    std::vector<float> all(cells);
    std::vector<float> middle(cells);
    for (std::size_t y = 0; y < side; ++y) {
        for (std::size_t x = 0; x < side; ++x) {
            std::uint32_t sum = 0;
            for (std::size_t z = 0; z < side; ++z) {
                const std::uint32_t above = count(x, y > 0 ? y - 1 : y, z);
                const std::uint32_t below = count(x, y + 1 < side ? y + 1 : y, z);
                const std::uint32_t here = (above + 2 * count(x, y, z) + below) >> 2;
                const std::size_t at = z * slice + y * side + x;
                all[at] = static_cast<float>(sum + (here >> 1));
                const float far = z >= nearVoxels ? all[at - nearVoxels * slice] : 0.0f;
                const float near = all[at] - far;
                middle[at] = far + near / (1.0f + near * softness);
                sum += here;
            }
        }
    }
    for (std::size_t i = 0; i < cells; ++i) {
        const std::size_t x = i % side;
        if (x == 0 || x + 1 == side) continue;
        const float spread = (0.25f * (middle[i - 1] + middle[i + 1]) + 0.5f * middle[i]) * texelsOfCount;
        m_texels[i] = static_cast<std::uint16_t>(static_cast<int>(std::min(spread, 65535.0f)));
    }
}

void AmbientVolume::build(const Strands& strands, const HairDetail& detail) {
    constexpr int n = size;
    constexpr std::size_t count = std::size_t{n} * n * n;
    m_texels.assign(count, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    m_scale = glm::vec3(0.0f);
    m_offset = glm::vec3(-1.0f);
    if (strands.vertexCount() == 0) return;
    // Cubic cells, so that all directions count alike.
    const Bounds box = vertexBounds(strands);
    const glm::vec3 extents = box.size();
    const float extent =
        std::max({extents.x, extents.y, extents.z, 1e-4f}) * (static_cast<float>(n) / static_cast<float>(n - 4));
    m_scale = glm::vec3(1.0f / extent);
    m_offset = glm::vec3(0.5f) - box.centre() * m_scale;
    const float cell = extent / static_cast<float>(n);
    glm::mat4 toGrid(1.0f);
    for (int axis = 0; axis < 3; ++axis) {
        toGrid[axis] *= m_scale[axis] * static_cast<float>(n);
        toGrid[axis].w = 0.0f;
    }
    toGrid[3] = glm::vec4(m_offset * static_cast<float>(n), 1.0f);
    std::vector<std::uint32_t> counts(count, 0);
    parallelFor(detail.hairs(strands), grain, [&](std::size_t begin, std::size_t end) {
        walk(strands, detail.stride, begin, end, toGrid, n, fixedPoint * detail.widthScale / (cell * cell),
             [&](std::size_t at, std::uint32_t amount) { add(counts[at], amount); });
    });

    // Light from the 6 sides and 8 corners of a cube, each swept once through the grid.
    struct Way {
        int x, y, z;
    };
    std::vector<Way> ways;
    for (int z = -1; z <= 1; ++z) {
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                const int steps = std::abs(x) + std::abs(y) + std::abs(z);
                if (steps == 1 || steps == 3) ways.push_back({x, y, z});
            }
        }
    }
    std::vector<std::vector<float>> open(ways.size(), std::vector<float>(count));
    parallelFor(ways.size(), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<float> sums(count);
        for (std::size_t w = begin; w < end; ++w) {
            const Way way = ways[w];
            const float length = std::sqrt(static_cast<float>(way.x * way.x + way.y * way.y + way.z * way.z));
            const auto each = [](int towards, int i) { return towards > 0 ? n - 1 - i : i; };
            for (int k = 0; k < n; ++k) {
                for (int j = 0; j < n; ++j) {
                    for (int i = 0; i < n; ++i) {
                        const int x = each(way.x, i);
                        const int y = each(way.y, j);
                        const int z = each(way.z, k);
                        const int nx = x + way.x;
                        const int ny = y + way.y;
                        const int nz = z + way.z;
                        const auto at = static_cast<std::size_t>((z * n + y) * n + x);
                        float beyond = 0.0f;  // hair from the next cell on
                        float far = 0.0f;     // and from the one behind that
                        float near = 0.5f * static_cast<float>(counts[at]) * length / fixedPoint;
                        if (nx >= 0 && nx < n && ny >= 0 && ny < n && nz >= 0 && nz < n) {
                            const auto before = static_cast<std::size_t>((nz * n + ny) * n + nx);
                            const float neighbour = static_cast<float>(counts[before]) * length / fixedPoint;
                            far = sums[before];
                            near += neighbour;
                            beyond = far + neighbour;
                        }
                        sums[at] = beyond;
                        open[w][at] = std::exp(-1.1f * (far + near / (1.0f + near / nearCover)));
                    }
                }
            }
        }
    });
    parallelFor(count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; ++at) {
            glm::vec4 sum(0.0f);
            for (std::size_t w = 0; w < ways.size(); ++w) {
                const glm::vec3 way = glm::normalize(glm::vec3(ways[w].x, ways[w].y, ways[w].z));
                sum += glm::vec4(way, 1.0f) * open[w][at];
            }
            const glm::vec3 bent(sum);
            const float length = glm::length(bent);
            m_texels[at] =
                glm::vec4(length > 1e-3f ? bent / length : glm::vec3(0.0f), sum.w / static_cast<float>(ways.size()));
        }
    });
}

}  // namespace whorl
