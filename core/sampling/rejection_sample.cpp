// SPDX-License-Identifier: Apache-2.0
#include "core/base/random.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface_point.h"

#include <algorithm>

namespace whorl {

std::vector<SurfacePoint> rejectionSample(const SurfaceMesh& mesh, const DensityLookup& density, std::size_t count,
                                          std::uint32_t seed) {
    std::vector<double> cumulative(mesh.triangles.size());
    double total = 0.0;
    for (std::uint32_t t = 0; t < cumulative.size(); ++t) {
        const double area = triangleArea(mesh, t);
        if (area > 0.0 && density.growsOn(t)) total += area;
        cumulative[t] = total;
    }
    const float bound = density.upperBound();
    std::vector<SurfacePoint> points;
    if (!(total > 0.0) || !(bound > 0.0f)) return points;
    points.reserve(count);
    // A map that is black but for a few texels would keep us here for ever.
    const std::uint64_t mostTries = 1000000 + 10000 * static_cast<std::uint64_t>(count);
    for (std::uint64_t i = 0; i < mostTries && points.size() < count; ++i) {
        const double weight = unitDouble(randomBits(seed, i, 1)) * total;
        const auto chosen = std::upper_bound(cumulative.begin(), cumulative.end() - 1, weight);
        const std::uint64_t inside = randomBits(seed, i, 2);
        float u = unitFloat(inside);
        float v = unitFloat(inside << 24);
        if (u + v > 1.0f) {
            u = 1.0f - u;
            v = 1.0f - v;
        }
        const SurfacePoint point{static_cast<std::uint32_t>(chosen - cumulative.begin()), u, std::min(v, 1.0f - u)};
        if (randomFloat(seed, i, 3) * bound < density.at(point.triangle, uvAt(mesh, point))) points.push_back(point);
    }
    return points;
}

}  // namespace whorl
