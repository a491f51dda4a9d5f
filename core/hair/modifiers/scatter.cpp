// SPDX-License-Identifier: Apache-2.0
#include "core/hair/modifiers/scatter.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/candidates.h"
#include "core/sampling/hilbert.h"
#include "core/surface/surface_point.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

// Channels of randomBits.
enum Channel : std::uint32_t { Shift = 192, U, V };

}  // namespace

Scatter::Scatter(const SurfaceMesh& mesh, const DensityLookup& density) {
    double total = 0;
    for (const std::uint32_t triangle : hilbertOrder(mesh)) {
        if (!density.growsOn(triangle)) continue;
        const double area = triangleArea(mesh, triangle);
        if (!(area > 0) || !std::isfinite(area)) continue;
        total += area;
        m_triangles.push_back(triangle);
        m_area.push_back(total);
    }
}

HairRoot Scatter::root(const SurfaceMesh& mesh, const DensityLookup& density, std::uint32_t index,
                       std::uint32_t seed) const {
    // Bit reversal over the Hilbert curve: each place falls where the ones before are far away.
    const double shift = unitDouble(randomBits(seed, 0, Shift));
    double along = static_cast<double>(reversed(index)) * 0x1p-32 + shift;
    along -= std::floor(along);
    const auto found = std::upper_bound(m_area.begin(), m_area.end(), along * m_area.back());
    const auto place = static_cast<std::size_t>(std::min(found, m_area.end() - 1) - m_area.begin());
    const float side = std::sqrt(randomFloat(seed, index, U));
    HairRoot root;
    root.id = index;
    root.point = {m_triangles[place], 1.0f - side, randomFloat(seed, index, V) * side};
    root.position = positionAt(mesh, root.point);
    root.normal = normalAt(mesh, root.point);
    root.uv = uvAt(mesh, root.point);
    root.group = static_cast<std::uint8_t>(density.groupAt(root.uv));
    return root;
}

std::vector<HairRoot> Scatter::roots(const SurfaceMesh& mesh, const DensityLookup& density, int group,
                                     std::size_t count, std::uint32_t seed) const {
    std::vector<HairRoot> found;
    if (m_triangles.empty()) return found;
    constexpr std::size_t grain = 1024, mostLookedAt = 64;
    // A whole number of blocks at a time, so that the answer does not depend on how many threads look.
    const std::size_t most = std::min<std::size_t>(std::max<std::size_t>(count, 64) * mostLookedAt, UINT32_MAX);
    std::vector<HairRoot> tried;
    std::vector<std::uint8_t> good;
    for (std::size_t first = 0; first < most && found.size() < count; first += tried.size()) {
        tried.resize(std::clamp<std::size_t>((count - found.size()) * 2, grain, most - first));
        good.assign(tried.size(), 0);
        parallelFor(tried.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                tried[i] = root(mesh, density, static_cast<std::uint32_t>(first + i), seed);
                good[i] = tried[i].group == group && density.at(tried[i].point.triangle, tried[i].uv) > 0.0f;
            }
        });
        for (std::size_t i = 0; i < tried.size() && found.size() < count; ++i)
            if (good[i]) found.push_back(tried[i]);
    }
    return found;
}

}  // namespace whorl
