// SPDX-License-Identifier: Apache-2.0
#include "core/lic/bake.h"

#include "core/base/parallel.h"
#include "core/lic/painter.h"
#include "core/lic/reference.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

float sampled(const Groom& groom, const Driven& number, glm::vec2 uv) {
    const Map* map = number.map.empty() ? nullptr : groom.maps.find(number.map);
    return map && !map->empty() ? number.value * map->sample(uv) : number.value;
}

/// The convolution at every texel of the skin, by LicReference; where nothing can be said, the mean.
Result<std::vector<float>> referenceLight(const Groom& groom, const std::shared_ptr<const Surface>& surface,
                                          const DirectionField& field, std::span<const SurfacePoint> places, int size,
                                          Progress& progress) {
    const LicParams& params = *groom.lic;
    const LicReference lic(surface, field);
    std::vector<float> light(places.size(), params.white);
    const auto side = static_cast<std::size_t>(size);
    parallelFor(side, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first * side; i < last * side && !progress.cancelled(); ++i) {
            if (places[i].triangle == noTriangle) continue;
            const glm::vec2 uv = uvAt(surface->mesh(), places[i]);
            LicOptions options;
            options.length = std::max(sampled(groom, params.length, uv), 0.0f);
            options.grain = std::max(sampled(groom, params.grain, uv), 1e-5f);
            options.white = params.white;
            options.kernel = params.kernel.index == 1 ? LicKernel::Box : LicKernel::Hann;
            options.seed = params.seed;
            light[i] = lic.at(places[i], options).value_or(params.white);
        }
    });
    if (progress.cancelled()) return cancelledError();
    return light;
}

/// Grows the chart outward: texels that are not known take what a neighbour holds, `margin` times over.
void addMargin(LicBake& bake, int margin) {
    const int size = bake.size;
    std::vector<std::uint32_t> rim, next;
    const auto at = [size](int x, int y) { return static_cast<std::uint32_t>(y * size + x); };
    constexpr int around[8][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    for (std::uint32_t i = 0; i < bake.texels.size(); ++i) {
        if (bake.texels[i] != LicBake::Texel::Outside) rim.push_back(i);
    }
    for (int pass = 0; pass < margin && !rim.empty(); ++pass) {
        next.clear();
        for (const std::uint32_t from : rim) {
            const int x = static_cast<int>(from) % size, y = static_cast<int>(from) / size;
            for (const auto& step : around) {
                const int nx = x + step[0], ny = y + step[1];
                if (nx < 0 || ny < 0 || nx >= size || ny >= size) continue;
                const std::uint32_t to = at(nx, ny);
                if (bake.texels[to] != LicBake::Texel::Outside) continue;
                bake.texels[to] = LicBake::Texel::Margin;
                bake.colour[to] = bake.colour[from];
                bake.opacity[to] = bake.opacity[from];
                bake.flow[to] = bake.flow[from];
                bake.height[to] = bake.height[from];
                next.push_back(to);
            }
        }
        rim.swap(next);
    }
}

}  // namespace

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

std::optional<TangentFrame> tangentFrame(const SurfaceMesh& mesh, const SurfacePoint& point) {
    const glm::uvec3 corners = mesh.triangles[point.triangle];
    const std::size_t first = std::size_t{point.triangle} * 3;
    const glm::vec3 e1 = mesh.positions[corners.y] - mesh.positions[corners.x];
    const glm::vec3 e2 = mesh.positions[corners.z] - mesh.positions[corners.x];
    const glm::vec2 d1 = mesh.cornerUvs[first + 1] - mesh.cornerUvs[first];
    const glm::vec2 d2 = mesh.cornerUvs[first + 2] - mesh.cornerUvs[first];
    const float area = d1.x * d2.y - d1.y * d2.x;
    if (!(std::abs(area) > 0.0f)) return std::nullopt;
    const glm::vec3 normal = normalAt(mesh, point);
    // Where u grows: the gradient's sign is that of the area.
    glm::vec3 tangent = (e1 * d2.y - e2 * d1.y) * (area > 0.0f ? 1.0f : -1.0f);
    tangent -= normal * glm::dot(normal, tangent);
    const float length = glm::length(tangent);
    if (!(length > 0.0f)) return std::nullopt;
    tangent /= length;
    return TangentFrame{tangent, glm::cross(normal, tangent) * (area > 0.0f ? 1.0f : -1.0f)};
}

Result<LicBake> bakeLic(const Groom& groom, std::shared_ptr<const Surface> surface, const DirectionField& field,
                        const BakeOptions& options, Progress& progress) {
    const SurfaceMesh& mesh = surface->mesh();
    const int size = options.size;
    const auto painter = LicPainter::make(surface, size, progress, LicLayout::Mesh);
    if (!painter) return painter.error();
    const auto texture = painter->paint(groom, field, nullptr, progress);
    if (!texture) return texture.error();
    const std::vector<SurfacePoint> places = placesOfTexels(mesh, size);
    std::vector<float> light;
    if (options.reference) {
        auto made = referenceLight(groom, surface, field, places, size, progress);
        if (!made) return made.error();
        light = std::move(*made);
    }
    const LicParams& params = *groom.lic;
    const std::size_t count = places.size();
    LicBake bake;
    bake.size = size;
    bake.mostHeight = params.height;
    bake.texels.assign(count, LicBake::Texel::Outside);
    bake.colour.assign(count, glm::vec3(0.0f));
    bake.opacity.assign(count, 0.0f);
    bake.flow.assign(count, glm::vec2(0.0f));
    bake.height.assign(count, 0.0f);
    const auto side = static_cast<std::size_t>(size);
    parallelFor(side, 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first * side; i < last * side; ++i) {
            if (places[i].triangle == noTriangle) continue;
            bake.texels[i] = LicBake::Texel::Inside;
            const float value = options.reference ? light[i] : static_cast<float>((*texture->light)[i]) / 255.0f;
            bake.opacity[i] = static_cast<float>((*texture->cover)[i]) / 255.0f;
            // Bare skin has the colour of the hair around it, for filters at the border.
            const float tone = bake.opacity[i] > 0.0f ? licTone(value, texture->mean, texture->deviation) : 0.0f;
            const float shade = std::max(1.0f + params.contrast * tone, 0.0f);
            glm::vec3 own;
            for (int c = 0; c < 3; ++c)
                own[c] = linearFromSrgb(static_cast<float>((*texture->colours)[3 * i + static_cast<std::size_t>(c)]) /
                                        255.0f);
            bake.colour[i] = licColour(own, texture->mean) * shade;
            if (!(bake.opacity[i] > 0.0f)) continue;
            bake.height[i] = params.height * value;
            const auto frame = tangentFrame(mesh, places[i]);
            if (!frame) continue;
            const glm::vec3 direction = field.at(places[i]);
            const glm::vec2 flow(glm::dot(direction, frame->tangent), glm::dot(direction, frame->bitangent));
            const float length = glm::length(flow);
            if (length > 1e-6f) bake.flow[i] = flow / length;
        }
    });
    addMargin(bake, options.margin);
    return bake;
}

Map imageOf(const LicBake& bake, BakeMap map, TexelFormat format, bool encoded) {
    const bool three = map == BakeMap::Colour || map == BakeMap::Flow;
    Map image(bake.size, bake.size, three ? 3 : 1, format, 0.0f);
    image.srgb = map == BakeMap::Colour && encoded;
    for (int y = 0; y < bake.size; ++y) {
        for (int x = 0; x < bake.size; ++x) {
            const auto at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(bake.size) + static_cast<std::size_t>(x);
            switch (map) {
                case BakeMap::Colour:
                    for (int c = 0; c < 3; ++c) {
                        const float value = bake.colour[at][c];
                        image.setTexel(x, y, c, encoded ? srgbFromLinear(std::min(value, 1.0f)) : value);
                    }
                    break;
                case BakeMap::Flow:
                    for (int c = 0; c < 2; ++c) image.setTexel(x, y, c, 0.5f + 0.5f * bake.flow[at][c]);
                    break;
                case BakeMap::Opacity:
                    image.setTexel(x, y, 0, bake.opacity[at]);
                    break;
                case BakeMap::Height:
                    image.setTexel(x, y, 0, bake.mostHeight > 0.0f ? bake.height[at] / bake.mostHeight : 0.0f);
                    break;
            }
        }
    }
    return image;
}

}  // namespace whorl
