// SPDX-License-Identifier: Apache-2.0
#include "core/surface/distance_field.h"

#include "core/base/parallel.h"
#include "core/surface/band_search.h"
#include "core/surface/pseudo_normals.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whorl {
namespace {

constexpr int bandNodes = 6;
// Not yet known: farther from the skin than the band.
constexpr float unknown = std::numeric_limits<float>::max();

// Gives the nodes beyond the band their side: those that the border of the grid reaches are outside, a closed pocket
// is where most of the band around it is.
void fillBeyondBand(const NodeGrid& grid, float band, std::vector<float>& values) {
    std::vector<std::size_t> open;
    std::vector<std::size_t> pocket;
    const std::size_t steps[3] = {1, grid.index(0, 1, 0), grid.index(0, 0, 1)};
    // The first pocket starts at a corner of the grid, which is always beyond the band.
    for (std::size_t start = 0; start < values.size(); ++start) {
        if (values[start] != unknown) continue;
        pocket.clear();
        open.assign(1, start);
        values[start] = band;
        std::int64_t balance = 0;
        while (!open.empty()) {
            const std::size_t node = open.back();
            open.pop_back();
            if (start != 0) pocket.push_back(node);
            const std::size_t place[3] = {node % steps[1], node / steps[1] % static_cast<std::size_t>(grid.size[1]),
                                          node / steps[2]};
            for (int axis = 0; axis < 3; ++axis) {
                const auto visit = [&](std::size_t next) {
                    if (values[next] == unknown) {
                        values[next] = band;
                        open.push_back(next);
                    } else if (values[next] != band) {
                        balance += values[next] > 0.0f ? 1 : -1;
                    }
                };
                if (place[axis] > 0) visit(node - steps[axis]);
                if (place[axis] + 1 < static_cast<std::size_t>(grid.size[axis])) visit(node + steps[axis]);
            }
        }
        if (balance < 0) {
            for (const std::size_t node : pocket) values[node] = -band;
        }
    }
}

}  // namespace

DistanceField DistanceField::build(const SurfaceMesh& mesh, int resolution) {
    DistanceField field;
    const Bounds bounds = boundsOf(mesh);
    if (bounds.empty()) return field;
    const glm::vec3 size = bounds.size();
    const float longest = std::max({size.x, size.y, size.z});
    if (!(longest > 0.0f) || !std::isfinite(longest)) return field;

    NodeGrid grid;
    grid.spacing = longest / static_cast<float>(std::clamp(resolution, 16, 256) - 1);
    // One node more than the band, so that the border of the grid is beyond it.
    const int margin = bandNodes + 1;
    grid.origin = bounds.min - glm::vec3(static_cast<float>(margin) * grid.spacing);
    for (int axis = 0; axis < 3; ++axis)
        grid.size[axis] = static_cast<int>(std::ceil(size[axis] / grid.spacing)) + 1 + 2 * margin;

    const PseudoNormals sides(mesh);
    std::vector<float> values(grid.count(), unknown);
    const float band = bandNodes * grid.spacing;
    searchBand(mesh, grid, band, [&](const NodeHit& hit) {
        values[hit.index] = sides.inside(hit.position, hit.nearest) ? -hit.distance : hit.distance;
    });
    field.m_band = band;
    fillBeyondBand(grid, band, values);
    field.m_origin = grid.origin;
    field.m_spacing = grid.spacing;
    field.m_perMetre = 1.0f / grid.spacing;
    field.storeBricks(values, grid.size);
    return field;
}

namespace {

// A distance changes by at most sqrt(3) spacings across a cell. More means that the side flips far from the skin,
// beyond the rim of an open mesh; that is outside.
constexpr float mostSpacings = 1.8f;

float range(const float (&corners)[8]) {
    float low = corners[0], high = corners[0];
    for (const float value : corners) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return high - low;
}

float mixed(float a, float b, float t) {
    return a + (b - a) * t;
}

// True when the values of a cell among the 4 x 4 x 4 nodes differ by more than `most`.
bool cellDiffers(const float* nodes, float most) {
    float low[64], high[64];
    std::copy_n(nodes, 64, low);
    std::copy_n(nodes, 64, high);
    // Entries whose neighbour is in the next row or layer hold nonsense and are not looked at.
    for (const int step : {1, 4, 16}) {
        for (int i = 0; i + step < 64; ++i) {
            low[i] = std::min(low[i], low[i + step]);
            high[i] = std::max(high[i], high[i + step]);
        }
    }
    for (int z = 0; z < 3; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x)
                if (high[z * 16 + y * 4 + x] - low[z * 16 + y * 4 + x] > most) return true;
    return false;
}

}  // namespace

void DistanceField::storeBricks(const std::vector<float>& values, const int (&size)[3]) {
    int counts[3];
    for (int axis = 0; axis < 3; ++axis) {
        counts[axis] = (size[axis] - 1 + brickCells - 1) / brickCells;
        m_last[axis] = static_cast<float>(size[axis] - 1);
    }
    m_brickCounts[0] = counts[0];
    m_brickCounts[1] = counts[1];
    // Nodes beyond the end of the grid repeat the last ones.
    const auto gather = [&](std::size_t brick, float* nodes) {
        const int first[3] = {static_cast<int>(brick) % counts[0] * brickCells,
                              static_cast<int>(brick) / counts[0] % counts[1] * brickCells,
                              static_cast<int>(brick) / (counts[0] * counts[1]) * brickCells};
        for (int z = 0; z < brickNodes; ++z) {
            for (int y = 0; y < brickNodes; ++y) {
                const int row = std::min(first[2] + z, size[2] - 1) * size[1] + std::min(first[1] + y, size[1] - 1);
                const float* from = values.data() + static_cast<std::ptrdiff_t>(row) * size[0];
                for (int x = 0; x < brickNodes; ++x) *nodes++ = from[std::min(first[0] + x, size[0] - 1)];
            }
        }
    };
    m_bricks.resize(static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
                    static_cast<std::size_t>(counts[2]));
    constexpr std::size_t grain = 1024;
    parallelFor(m_bricks.size(), grain, [&](std::size_t begin, std::size_t end) {
        float nodes[nodesOfBrick];
        for (std::size_t b = begin; b < end; ++b) {
            gather(b, nodes);
            const auto [low, high] = std::minmax_element(nodes, nodes + nodesOfBrick);
            if (*low == *high && std::abs(*low) == m_band) {
                m_bricks[b] = *low > 0.0f ? FarOutside : FarInside;
            } else {
                m_bricks[b] = *low < 0.0f && *high > 0.0f && cellDiffers(nodes, mostSpacings * m_spacing) ? flips : 0;
            }
        }
    });
    std::int32_t place = 0;
    for (std::int32_t& brick : m_bricks) {
        if (brick < 0) continue;
        brick |= place;
        place += nodesOfBrick;
    }
    m_nodes.resize(static_cast<std::size_t>(place));
    parallelFor(m_bricks.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            if (m_bricks[b] >= 0) gather(b, m_nodes.data() + (m_bricks[b] & ~flips));
    });
}

DistanceField::Sample DistanceField::sampleNear(std::int32_t brick, const glm::ivec3& cell,
                                                const glm::vec3& place) const {
    Sample sample(0.0f);
    sample.m_place = place;
    sample.m_least = 1e-6f * m_spacing;
    auto& c = sample.m_corners;
    const float* first = m_nodes.data() + (brick & ~flips) + (cell.z * brickNodes + cell.y) * brickNodes + cell.x;
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) c[(z * 2 + y) * 2 + x] = first[(z * brickNodes + y) * brickNodes + x];
    if ((brick & flips) != 0 && range(c) > mostSpacings * m_spacing)
        for (float& value : c) value = std::abs(value);
    sample.m_distance = mixed(mixed(mixed(c[0], c[1], place.x), mixed(c[2], c[3], place.x), place.y),
                              mixed(mixed(c[4], c[5], place.x), mixed(c[6], c[7], place.x), place.y), place.z);
    return sample;
}

glm::vec3 DistanceField::Sample::gradient() const {
    if (m_least < 0.0f) return glm::vec3(0.0f);
    const auto& c = m_corners;
    const glm::vec3& t = m_place;
    const glm::vec3 slope(mixed(mixed(c[1] - c[0], c[3] - c[2], t.y), mixed(c[5] - c[4], c[7] - c[6], t.y), t.z),
                          mixed(mixed(c[2] - c[0], c[3] - c[1], t.x), mixed(c[6] - c[4], c[7] - c[5], t.x), t.z),
                          mixed(mixed(c[4] - c[0], c[5] - c[1], t.x), mixed(c[6] - c[2], c[7] - c[3], t.x), t.y));
    const float length = glm::length(slope);
    return length > m_least ? slope / length : glm::vec3(0.0f);
}

}  // namespace whorl
