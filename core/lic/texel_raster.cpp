// SPDX-License-Identifier: Apache-2.0
#include "core/lic/texel_raster.h"

#include "core/surface/adjacency.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whorl {
namespace {

constexpr double slack = 1e-6;  // of a share: edges between triangles leave no hole

}  // namespace

TexelAtlas::Raster::Raster(const TexelAtlas& texels)
    : atlas(texels), across(trianglesAcross(texels.mesh())), walk(texels.mesh()) {
    const auto count = static_cast<std::size_t>(atlas.side()) * static_cast<std::size_t>(atlas.side());
    owner.assign(count, none);
    seam.assign(count, none);
    seamDistance.resize(count);
    cover();
    findCharts();
    findSeams();
}

glm::dvec2 TexelAtlas::Raster::shares(std::uint32_t triangle, const glm::dvec2& place) const {
    const glm::dvec2 a(atlas.texelPlace(triangle * 3ull));
    const glm::dvec2 e1 = glm::dvec2(atlas.texelPlace(triangle * 3ull + 1)) - a;
    const glm::dvec2 e2 = glm::dvec2(atlas.texelPlace(triangle * 3ull + 2)) - a, d = place - a;
    const double area = e1.x * e2.y - e1.y * e2.x;
    return area != 0.0 ? glm::dvec2((d.x * e2.y - d.y * e2.x) / area, (e1.x * d.y - e1.y * d.x) / area)
                       : glm::dvec2(0.0);
}

void TexelAtlas::Raster::cover() {
    const int side = atlas.side(), least = pad, most = pad + atlas.size() - 1;
    for (std::uint32_t t = 0; t < atlas.mesh().triangleCount(); ++t) {
        glm::dvec2 p[3];
        for (std::size_t k = 0; k < 3; ++k) p[k] = glm::dvec2(atlas.texelPlace(t * 3ull + k));
        const glm::dvec2 e1 = p[1] - p[0], e2 = p[2] - p[0];
        const double area = e1.x * e2.y - e1.y * e2.x;
        const glm::dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
        if (!(std::abs(area) > 0.0) || !(high.x < 1e8 && high.y < 1e8 && low.x > -1e8 && low.y > -1e8)) continue;
        const int x0 = std::max(static_cast<int>(std::ceil(low.x - 0.5 - slack)), least);
        const int x1 = std::min(static_cast<int>(std::floor(high.x - 0.5 + slack)), most);
        const int y0 = std::max(static_cast<int>(std::ceil(low.y - 0.5 - slack)), least);
        const int y1 = std::min(static_cast<int>(std::floor(high.y - 0.5 + slack)), most);
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - p[0];
                const double u = (d.x * e2.y - d.y * e2.x) / area, v = (e1.x * d.y - e1.y * d.x) / area;
                if (u < -slack || v < -slack || u + v > 1.0 + slack) continue;
                std::uint32_t& at =
                    owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
                if (at == none) {
                    ++covered;
                } else if (u > 1e-4 && v > 1e-4 && u + v < 1.0 - 1e-4) {
                    const glm::dvec2 s = shares(at, {x + 0.5, y + 0.5});
                    if (s.x > 1e-4 && s.y > 1e-4 && s.x + s.y < 1.0 - 1e-4) ++twice;
                }
                at = t;
            }
        }
    }
}

bool TexelAtlas::Raster::isSeam(std::uint32_t triangle, std::uint32_t edge) const {
    const std::uint32_t other = across[triangle][edge];
    if (other == noTriangle) return false;
    const glm::uvec3 here = atlas.mesh().triangles[triangle], there = atlas.mesh().triangles[other];
    const std::uint32_t ends[2] = {edge, (edge + 1) % 3};
    for (const std::uint32_t k : ends) {
        for (std::uint32_t j = 0; j < 3; ++j) {
            if (there[j] != here[k]) continue;
            const glm::vec2 apart = atlas.texelPlace(triangle * 3ull + k) - atlas.texelPlace(other * 3ull + j);
            if (std::abs(apart.x) + std::abs(apart.y) > 0.01f) return true;
        }
    }
    return false;
}

void TexelAtlas::Raster::findCharts() {
    charts.resize(across.size());
    std::iota(charts.begin(), charts.end(), 0u);
    const auto root = [&](std::uint32_t t) {
        while (charts[t] != t) t = charts[t] = charts[charts[t]];
        return t;
    };
    for (std::uint32_t t = 0; t < across.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (across[t][k] == noTriangle || across[t][k] < t || isSeam(t, k)) continue;
            const std::uint32_t a = root(t), b = root(across[t][k]);
            charts[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::uint32_t t = 0; t < across.size(); ++t) charts[t] = root(t);
}

void TexelAtlas::Raster::findSeams() {
    for (std::uint32_t t = 0; t < across.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k)
            if (isSeam(t, k)) besideSeam(t, k);
    }
}

void TexelAtlas::Raster::besideSeam(std::uint32_t triangle, std::uint32_t edge) {
    const glm::vec2 a = atlas.texelPlace(triangle * 3ull + edge);
    const glm::vec2 b = atlas.texelPlace(triangle * 3ull + (edge + 1) % 3);
    const glm::vec2 inside = atlas.texelPlace(triangle * 3ull + (edge + 2) % 3);
    const glm::vec2 along = b - a;
    const float length = glm::length(along);
    if (!(length > 1e-6f)) return;
    glm::vec2 out = glm::vec2(along.y, -along.x) / length;
    if (glm::dot(out, inside - a) > 0.0f) out = -out;
    const auto last = static_cast<float>(atlas.side() - 1);
    const glm::vec2 low = glm::clamp(glm::min(a, b) - margin, glm::vec2(0.0f), glm::vec2(last));
    const glm::vec2 high = glm::clamp(glm::max(a, b) + margin, glm::vec2(0.0f), glm::vec2(last));
    for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
        for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
            const glm::vec2 d = glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) - a;
            const float way = glm::dot(d, along) / length;
            const float over = glm::dot(d, out);
            if (over < 0.0f || over > margin) continue;
            const float beyond = std::max({-way, way - length, 0.0f});
            const float distance = std::sqrt(over * over + beyond * beyond);
            if (distance > margin) continue;
            const auto at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.side()) + static_cast<std::size_t>(x);
            if (distance <= 1.0f && beyond == 0.0f) {
                ++besideSeams;
                if (owner[at] != none && charts[owner[at]] != charts[triangle]) ++taken;
            }
            if (owner[at] != none) continue;
            if (seam[at] != none && seamDistance[at] <= distance) continue;
            seam[at] = triangle * 3 + edge;
            seamDistance[at] = distance;
        }
    }
}

bool TexelAtlas::Raster::roomFor(LicLayout layout) const {
    if (layout == LicLayout::Mesh) return true;
    return twice * 200 <= covered && taken * 50 <= besideSeams;
}

std::optional<TexelAtlas::Raster::Beyond> TexelAtlas::Raster::beyond(std::uint32_t seamEdge,
                                                                     const glm::vec2& place) const {
    const SurfaceMesh& mesh = atlas.mesh();
    const std::uint32_t triangle = seamEdge / 3, k = seamEdge % 3, next = (k + 1) % 3;
    // From the nearest place of the edge straight on over the skin.
    const glm::vec2 a = atlas.texelPlace(triangle * 3ull + k), along = atlas.texelPlace(triangle * 3ull + next) - a;
    const float share = std::clamp(glm::dot(place - a, along) / glm::dot(along, along), 0.001f, 0.999f);
    const glm::vec2 over = place - (a + along * share);
    float corners[3] = {0.0f, 0.0f, 0.0f};
    corners[k] = 1.0f - share;
    corners[next] = share;
    const Gradients g = atlas.gradients(triangle);
    const float xx = glm::dot(g.x, g.x), yy = glm::dot(g.y, g.y), xy = glm::dot(g.x, g.y), area = xx * yy - xy * xy;
    if (!(area > 1e-6f * xx * yy)) return std::nullopt;
    const glm::vec3 way = (g.x * (yy * over.x - xy * over.y) + g.y * (xx * over.y - xy * over.x)) / area;
    const float metres = glm::length(way);
    if (!(metres > 0.0f)) return std::nullopt;
    const SurfaceWalk::Step step = walk.go(mesh, {triangle, corners[1], corners[2]}, way, metres);
    if (step.walked < metres * 0.999f || step.point.triangle == triangle) return std::nullopt;
    // Both planes by the way and what is to its left, in texels.
    const auto axes = [&](std::uint32_t t, const glm::vec3& ahead) {
        const Gradients in = atlas.gradients(t);
        const glm::vec3 left = glm::cross(triangleNormal(mesh, t), ahead);
        return glm::mat2(glm::dot(in.x, ahead), glm::dot(in.y, ahead), glm::dot(in.x, left), glm::dot(in.y, left));
    };
    const glm::mat2 here = axes(triangle, way / metres), there = axes(step.point.triangle, step.direction);
    if (!(std::abs(glm::determinant(here)) > 1e-9f)) return std::nullopt;
    Beyond found{there * glm::inverse(here), glm::vec2(0.0f), step.point};
    const float shares[3] = {1.0f - step.point.u - step.point.v, step.point.u, step.point.v};
    for (std::size_t c = 0; c < 3; ++c) found.place += atlas.texelPlace(step.point.triangle * 3ull + c) * shares[c];
    return found;
}

}  // namespace whorl
