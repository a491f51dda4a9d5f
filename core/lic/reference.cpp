// SPDX-License-Identifier: Apache-2.0
#include "core/lic/reference.h"

#include "core/base/random.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whorl {

float solidNoise(const glm::vec3& place, const LicOptions& options) {
    const auto cell = [&](float x) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / options.grain)) + (1 << 20)) &
               0x1fffffu;
    };
    const std::uint64_t index = cell(place.x) | (cell(place.y) << 21) | (cell(place.z) << 42);
    return randomFloat(static_cast<std::uint32_t>(options.seed), index, 0) < options.white ? 1.0f : 0.0f;
}

LicReference::LicReference(std::shared_ptr<const Surface> surface, DirectionField field)
    : m_surface(std::move(surface)), m_field(std::move(field)), m_walk(m_surface->mesh()) {}

std::vector<LicReference::Place> LicReference::streamline(const SurfacePoint& from, float metres, float step,
                                                          bool backward) const {
    const SurfaceMesh& mesh = m_surface->mesh();
    const float sign = backward ? -1.0f : 1.0f;
    std::vector<Place> places{{from, positionAt(mesh, from)}};
    if (m_field.at(from) == glm::vec3(0.0f)) return {};
    for (int k = 1; static_cast<float>(k) * step <= metres * 1.0001f; ++k) {
        const SurfacePoint here = places.back().point;
        const glm::vec3 normal = normalAt(mesh, here);
        // The direction `way` metres along `d`, turned back to here; zero where hair ends on the way.
        const auto sample = [&](const glm::vec3& d, float way) {
            const SurfaceWalk::Step to = m_walk.go(mesh, here, d, way);
            if (to.walked < way * 0.999f || m_field.parted(here, to.point)) return glm::vec3(0.0f);
            return minimalRotation(normalAt(mesh, to.point), normal) * direction(to.point, sign);
        };
        const glm::vec3 d1 = direction(here, sign);
        const glm::vec3 d2 = sample(d1, 0.5f * step);
        if (d2 == glm::vec3(0.0f)) break;
        const glm::vec3 d3 = sample(d2, 0.5f * step);
        if (d3 == glm::vec3(0.0f)) break;
        const glm::vec3 d4 = sample(d3, step);
        if (d4 == glm::vec3(0.0f)) break;
        const glm::vec3 mean = d1 + 2.0f * (d2 + d3) + d4;
        if (!(glm::length(mean) > 1e-3f)) break;
        const SurfaceWalk::Step to = m_walk.go(mesh, here, mean, step);
        if (to.walked < step * 0.999f || m_field.parted(here, to.point) || m_field.at(to.point) == glm::vec3(0.0f))
            break;
        places.push_back({to.point, positionAt(mesh, to.point)});
    }
    return places;
}

std::optional<float> LicReference::at(const SurfacePoint& point, const LicOptions& options) const {
    const float step = 0.5f * options.grain;
    double sum = 0.0, weights = 0.0;
    for (const bool backward : {false, true}) {
        const std::vector<Place> line = streamline(point, options.length, step, backward);
        if (line.empty()) return std::nullopt;
        // The place itself counts once.
        for (std::size_t k = backward ? 1 : 0; k < line.size(); ++k) {
            const double along = static_cast<double>(static_cast<float>(k) * step / std::max(options.length, step));
            const double weight =
                options.kernel == LicKernel::Box ? 1.0 : 0.5 + 0.5 * std::cos(std::numbers::pi * std::min(along, 1.0));
            sum += weight * static_cast<double>(solidNoise(line[k].position, options));
            weights += weight;
        }
    }
    return weights > 0.0 ? static_cast<float>(sum / weights)
                         : solidNoise(positionAt(m_surface->mesh(), point), options);
}

}  // namespace whorl
