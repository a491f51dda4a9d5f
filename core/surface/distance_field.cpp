// SPDX-License-Identifier: Apache-2.0
#include "core/surface/distance_field.h"

#include "core/surface/band_search.h"
#include "core/surface/pseudo_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
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

DistanceField DistanceField::build(const SurfaceQuery& query, int resolution) {
    DistanceField field;
    const Bounds bounds = boundsOf(query.mesh());
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

    const PseudoNormals sides(query.mesh());
    field.m_values.assign(grid.count(), unknown);
    const float band = bandNodes * grid.spacing;
    searchBand(query.mesh(), grid, band, [&](const NodeHit& hit) {
        field.m_values[hit.index] = sides.inside(hit.position, hit.nearest) ? -hit.distance : hit.distance;
    });
    field.m_band = band;
    fillBeyondBand(grid, band, field.m_values);
    field.m_origin = grid.origin;
    field.m_spacing = grid.spacing;
    for (int axis = 0; axis < 3; ++axis) field.m_size[axis] = grid.size[axis];
    return field;
}

namespace {

struct Cell {
    std::array<float, 8> corners;  // x fastest, then y, then z
    glm::vec3 place;               // 0 to 1
};

// The cell around `p`; false outside the grid.
bool cellAt(const glm::vec3& p, const glm::vec3& origin, float spacing, const int (&size)[3],
            const std::vector<float>& values, Cell& cell) {
    if (values.empty()) return false;
    const glm::vec3 q = (p - origin) / spacing;
    int first[3];
    for (int axis = 0; axis < 3; ++axis) {
        if (!(q[axis] >= 0.0f && q[axis] < static_cast<float>(size[axis] - 1))) return false;
        first[axis] = static_cast<int>(q[axis]);
        cell.place[axis] = q[axis] - static_cast<float>(first[axis]);
    }
    const auto nx = static_cast<std::size_t>(size[0]);
    const auto ny = static_cast<std::size_t>(size[1]);
    const float* corner = values.data() +
                          (static_cast<std::size_t>(first[2]) * ny + static_cast<std::size_t>(first[1])) * nx +
                          static_cast<std::size_t>(first[0]);
    const float* above = corner + nx * ny;
    cell.corners = {corner[0], corner[1], corner[nx], corner[nx + 1], above[0], above[1], above[nx], above[nx + 1]};
    // A distance changes by at most sqrt(3) spacings across a cell. More means that the side flips far from the skin,
    // beyond the rim of an open mesh; that is outside.
    const auto [low, high] = std::minmax_element(cell.corners.begin(), cell.corners.end());
    if (*high - *low > 1.8f * spacing) {
        for (float& value : cell.corners) value = std::abs(value);
    }
    return true;
}

float mixed(float a, float b, float t) {
    return a + (b - a) * t;
}

}  // namespace

float DistanceField::distance(const glm::vec3& p) const {
    Cell cell;
    if (!cellAt(p, m_origin, m_spacing, m_size, m_values, cell)) return m_band;
    const auto& c = cell.corners;
    const glm::vec3& t = cell.place;
    return mixed(mixed(mixed(c[0], c[1], t.x), mixed(c[2], c[3], t.x), t.y),
                 mixed(mixed(c[4], c[5], t.x), mixed(c[6], c[7], t.x), t.y), t.z);
}

glm::vec3 DistanceField::gradient(const glm::vec3& p) const {
    Cell cell;
    if (!cellAt(p, m_origin, m_spacing, m_size, m_values, cell)) return glm::vec3(0.0f);
    const auto& c = cell.corners;
    const glm::vec3& t = cell.place;
    const glm::vec3 slope(mixed(mixed(c[1] - c[0], c[3] - c[2], t.y), mixed(c[5] - c[4], c[7] - c[6], t.y), t.z),
                          mixed(mixed(c[2] - c[0], c[3] - c[1], t.x), mixed(c[6] - c[4], c[7] - c[5], t.x), t.z),
                          mixed(mixed(c[4] - c[0], c[5] - c[1], t.x), mixed(c[6] - c[2], c[7] - c[3], t.x), t.y));
    const float length = glm::length(slope);
    return length > 1e-6f * m_spacing ? slope / length : glm::vec3(0.0f);
}

}  // namespace whorl
