// SPDX-License-Identifier: Apache-2.0
#include "core/surface/atlas.h"

#include "core/surface/atlas_charts.h"
#include "core/surface/atlas_pack.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

using atlas::Chart;

double uvArea(const glm::vec2* uv) {
    const glm::dvec2 a = glm::dvec2(uv[1]) - glm::dvec2(uv[0]);
    const glm::dvec2 b = glm::dvec2(uv[2]) - glm::dvec2(uv[0]);
    return std::abs(a.x * b.y - a.y * b.x);
}

std::vector<glm::ivec2> texelSizes(const std::vector<Chart>& charts, double texelsPerMetre, int gap) {
    std::vector<glm::ivec2> sizes;
    sizes.reserve(charts.size());
    for (const Chart& chart : charts) {
        const glm::dvec2 size = glm::ceil(glm::min(chart.size * texelsPerMetre, glm::dvec2(1e8)));
        sizes.push_back(glm::max(glm::ivec2(size), glm::ivec2(1)) + glm::ivec2(gap));
    }
    return sizes;
}

struct Packing {
    std::vector<glm::ivec2> places;
    double texelsPerMetre = 0.0;
};

// The largest scale at which all charts fit, by halving.
Packing packLargest(const std::vector<Chart>& charts, int side, int gap) {
    double area = 0.0;
    for (const Chart& chart : charts) area += std::max(chart.size.x * chart.size.y, 1e-300);
    const double full = static_cast<double>(side) / std::sqrt(area);  // no gaps, no waste
    Packing best;
    double low = 0.0, high = full;
    for (int step = 0; step < 14; ++step) {
        const double scale = step == 0 ? full * 0.8 : 0.5 * (low + high);
        if (auto places = atlas::pack(texelSizes(charts, scale, gap), side)) {
            best = {std::move(*places), scale};
            low = scale;
        } else {
            high = scale;
        }
    }
    return best;
}

}  // namespace

void makeAtlas(SurfaceMesh& mesh, int mapSize, int gapTexels) {
    mesh.cornerUvs.assign(mesh.triangles.size() * 3, glm::vec2(0.0f));
    mesh.madeAtlas = true;
    const std::vector<Chart> charts = atlas::makeCharts(mesh);
    if (charts.empty()) return;

    // Tens of thousands of loose pieces leave no room for gaps: the grid gets finer, the gaps thinner.
    int side = std::max(mapSize, 1);
    Packing packing = packLargest(charts, side, gapTexels);
    while (packing.places.empty() && side < (1 << 24)) {
        side *= 2;
        packing = packLargest(charts, side, gapTexels);
    }
    if (packing.places.empty()) return;
    const double margin = 0.5 * static_cast<double>(gapTexels);
    for (std::size_t c = 0; c < charts.size(); ++c) {
        const glm::dvec2 place = glm::dvec2(packing.places[c]) + glm::dvec2(margin);
        for (std::size_t i = 0; i < charts[c].triangles.size() * 3; ++i) {
            const glm::dvec2 texel = place + charts[c].corners[i] * packing.texelsPerMetre;
            const glm::dvec2 uv = glm::clamp(texel / static_cast<double>(side), 0.0, 1.0);
            mesh.cornerUvs[std::size_t{charts[c].triangles[i / 3]} * 3 + i % 3] = glm::vec2(uv);
        }
    }
}

bool needsAtlas(const SurfaceMesh& mesh) {
    if (mesh.cornerUvs.size() != mesh.triangles.size() * 3) return true;
    std::size_t withArea = 0;
    std::size_t flat = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 a(mesh.positions[mesh.triangles[t].x]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.positions[mesh.triangles[t].y]) - a,
                                             glm::dvec3(mesh.positions[mesh.triangles[t].z]) - a);
        if (!(glm::dot(normal, normal) > 0.0)) continue;
        ++withArea;
        if (!(uvArea(&mesh.cornerUvs[t * 3]) > 0.0)) ++flat;
    }
    return withArea == 0 || flat * 2 > withArea;
}

}  // namespace whorl
