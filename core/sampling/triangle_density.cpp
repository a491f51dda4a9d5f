// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/triangle_density.h"

#include "core/base/parallel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace whorl {
namespace {

// Texels along a side of a triangle, at most: UVs of strangers can cross the map a million times.
constexpr double mostTexels = 4096.0;
constexpr float blurOfMap = 1.0f / 256.0f;

// The groom with blurred density maps.
std::unique_ptr<const Groom> withBlurredMaps(const Groom& groom) {
    auto copy = std::make_unique<Groom>(groom);
    for (const Group& group : *groom.groups) {
        const std::string& name = group.params.general.density.map;
        const Map* map = name.empty() ? nullptr : groom.maps.find(name);
        if (!map || map->empty() || copy->maps.find(name) != map) continue;
        copy->maps.set(name, blurred(*map, std::max(1.0f, blurOfMap * static_cast<float>(map->width()))));
    }
    return copy;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace

Map blurred(const Map& map, float sigma) {
    const int reach = static_cast<int>(std::ceil(3.0f * sigma));
    std::vector<float> weights;
    float sum = 0.0f;
    for (int i = -reach; i <= reach; ++i) {
        weights.push_back(std::exp(-0.5f * static_cast<float>(i * i) / (sigma * sigma)));
        sum += weights.back();
    }
    for (float& weight : weights) weight /= sum;
    const int width = map.width(), height = map.height(), channels = map.channels();
    const auto at = [&](int x, int y, int c) { return static_cast<std::size_t>((y * width + x) * channels + c); };
    std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(channels)),
        across(texels.size());
    const auto rows = static_cast<std::size_t>(height);
    const auto wrapped = [](int i, int size) { return (i % size + size) % size; };
    parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < channels; ++c) {
                    const float texel = map.texel(x, y, c);
                    texels[at(x, y, c)] = std::isfinite(texel) ? texel : 0.0f;
                }
            }
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < channels; ++c) {
                    float mean = 0.0f;
                    for (int i = -reach; i <= reach; ++i)
                        mean += weights[static_cast<std::size_t>(i + reach)] * texels[at(wrapped(x + i, width), y, c)];
                    across[at(x, y, c)] = mean;
                }
            }
        }
    });
    parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            float* row = &texels[at(0, y, 0)];
            std::fill_n(row, width * channels, 0.0f);
            for (int i = -reach; i <= reach; ++i) {
                const float weight = weights[static_cast<std::size_t>(i + reach)];
                const float* from = &across[at(0, wrapped(y + i, height), 0)];
                for (int x = 0; x < width * channels; ++x) row[x] += weight * from[x];
            }
        }
    });
    Map result = map;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) result.setTexel(x, y, c, texels[at(x, y, c)]);
    return result;
}

TriangleDensities::TriangleDensities(const Groom& groom, TriangleDensity way)
    : m_mesh(*groom.mesh),
      m_way(way),
      m_blurred(way == TriangleDensity::Blurred ? withBlurredMaps(groom) : nullptr),
      m_density(m_blurred ? *m_blurred : groom) {}

TriangleDensities::~TriangleDensities() = default;

float TriangleDensities::mean(std::uint32_t triangle, const std::array<glm::vec2, 3>& piece) const {
    const glm::vec2* uv = &m_mesh.cornerUvs[std::size_t{3} * triangle];
    std::array<glm::vec2, 3> uvs;
    for (std::size_t k = 0; k < 3; ++k) uvs[k] = uv[0] + (uv[1] - uv[0]) * piece[k].x + (uv[2] - uv[0]) * piece[k].y;
    return m_way == TriangleDensity::Texels ? texels(triangle, uvs) : corners(triangle, uvs);
}

float TriangleDensities::corners(std::uint32_t triangle, const std::array<glm::vec2, 3>& uvs) const {
    float sum = 0.0f;
    for (const glm::vec2& uv : uvs) sum += m_density.at(triangle, uv);
    return sum / 3.0f;
}

// Texels whose middles lie in the triangle, each once; when there are none, its own middle.
float TriangleDensities::texels(std::uint32_t triangle, const std::array<glm::vec2, 3>& uvs) const {
    const glm::dvec2 size(m_density.mapWidth(), m_density.mapHeight());
    const glm::dvec2 a = glm::dvec2(uvs[0]) * size, b = glm::dvec2(uvs[1]) * size, c = glm::dvec2(uvs[2]) * size;
    const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
    const double area = cross(b - a, c - a);
    double sum = 0.0;
    std::size_t count = 0;
    const bool sane =
        high.x - low.x < mostTexels && high.y - low.y < mostTexels && std::abs(low.x) < 1e9 && std::abs(low.y) < 1e9;
    for (double y = std::ceil(low.y - 0.5) + 0.5; sane && area != 0.0 && y <= high.y; y += 1.0) {
        for (double x = std::ceil(low.x - 0.5) + 0.5; x <= high.x; x += 1.0) {
            const glm::dvec2 p(x, y);
            const double u = cross(b - a, p - a) / area, v = cross(c - b, p - b) / area, w = cross(a - c, p - c) / area;
            if (u < 0.0 || v < 0.0 || w < 0.0) continue;
            sum += static_cast<double>(m_density.at(triangle, glm::vec2(p / size)));
            ++count;
        }
    }
    if (count == 0) return m_density.at(triangle, (uvs[0] + uvs[1] + uvs[2]) / 3.0f);
    return static_cast<float>(sum / static_cast<double>(count));
}

}  // namespace whorl
