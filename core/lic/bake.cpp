// SPDX-License-Identifier: Apache-2.0
#include "core/lic/bake.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

/// The place of the skin in the middle of each texel; triangle noTriangle where there is none.
std::vector<SurfacePoint> placesOfTexels(const SurfaceMesh& mesh, int size) {
    std::vector<SurfacePoint> places(static_cast<std::size_t>(size) * static_cast<std::size_t>(size),
                                     {noTriangle, 0.0f, 0.0f});
    const auto texels = static_cast<double>(size);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        glm::dvec2 p[3];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const glm::vec2 uv = mesh.cornerUvs[t * 3 + k];
            p[k] = glm::dvec2(static_cast<double>(uv.x), 1.0 - static_cast<double>(uv.y)) * texels;
        }
        const glm::dvec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
        const double area = e1.x * e2.y - e1.y * e2.x;
        const double reach = std::max(
            {std::abs(p[0].x), std::abs(p[0].y), std::abs(e1.x), std::abs(e1.y), std::abs(e2.x), std::abs(e2.y)});
        // UVs may lie anywhere; a texture's middle is what is baked.
        if (!(std::abs(area) > 0.0) || !(reach < 16.0 * texels)) continue;
        const auto low = [&](double a, double b, double c) {
            return std::max(static_cast<int>(std::ceil(std::min({a, b, c}) - 0.5)), 0);
        };
        const auto high = [&](double a, double b, double c) {
            return std::min(static_cast<int>(std::floor(std::max({a, b, c}) - 0.5)), size - 1);
        };
        for (int y = low(p[0].y, p[1].y, p[2].y); y <= high(p[0].y, p[1].y, p[2].y); ++y) {
            for (int x = low(p[0].x, p[1].x, p[2].x); x <= high(p[0].x, p[1].x, p[2].x); ++x) {
                const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - p[0];
                const double u = (d.x * e2.y - d.y * e2.x) / area, v = (e1.x * d.y - e1.y * d.x) / area;
                if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
                places[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)] = {
                    t, static_cast<float>(u), static_cast<float>(v)};
            }
        }
    }
    return places;
}

}  // namespace

Result<LicBake> bakeLic(const LicReference& lic, const LicOptions& options, int size, int margin,
                        const std::function<float(const SurfacePoint&)>& cover, Progress& progress) {
    const std::vector<SurfacePoint> places = placesOfTexels(lic.surface().mesh(), size);
    const std::size_t count = places.size();
    const auto side = static_cast<std::size_t>(size);
    std::vector<float> values(count, -1.0f), covers(count, -1.0f);  // below zero: not known
    parallelFor(side, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first * side; i < last * side && !progress.cancelled(); ++i) {
            if (places[i].triangle == noTriangle) continue;
            const auto value = lic.at(places[i], options);
            values[i] = value.value_or(0.0f);
            covers[i] = value ? (cover ? std::clamp(cover(places[i]), 0.0f, 1.0f) : 1.0f) : 0.0f;
        }
    });
    if (progress.cancelled()) return cancelledError();
    for (int pass = 0; pass < margin; ++pass) {
        const std::vector<float> known = values, covered = covers;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const std::size_t at = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
                if (known[at] >= 0.0f) continue;
                float sum = 0.0f, covering = 0.0f, neighbours = 0.0f;
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        if (x + dx < 0 || y + dy < 0 || x + dx >= size || y + dy >= size) continue;
                        const std::size_t next =
                            static_cast<std::size_t>(y + dy) * side + static_cast<std::size_t>(x + dx);
                        if (known[next] < 0.0f) continue;
                        sum += known[next];
                        covering += covered[next];
                        neighbours += 1.0f;
                    }
                }
                if (neighbours == 0.0f) continue;
                values[at] = sum / neighbours;
                covers[at] = covering / neighbours;
            }
        }
    }
    LicBake bake{Map(size, size, 1, TexelFormat::U8, 0.0f), Map(size, size, 1, TexelFormat::U8, 0.0f)};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
            if (values[at] < 0.0f) continue;
            bake.brightness.setTexel(x, y, 0, values[at]);
            bake.coverage.setTexel(x, y, 0, covers[at]);
        }
    }
    return bake;
}

}  // namespace whorl
