// SPDX-License-Identifier: Apache-2.0
#include "core/field/direction_field.h"

#include "core/field/field_state.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace whorl {

bool FieldDomain::apart(const PartingIndex::Root& a, const PartingIndex::Root& b) const {
    // Neighbours whose way meets the line; those around its end are neighbours of each other, too.
    return partings.detour(a, b) > 1.0f;
}

bool FieldDomain::separated(std::uint32_t a, std::uint32_t b) const {
    return apart(root(a), root(b));
}

glm::vec3 FieldDomain::tangent(std::uint32_t vertex, const glm::vec3& direction) const {
    return direction - normals[vertex] * glm::dot(normals[vertex], direction);
}

std::complex<double> FieldDomain::inFrame(std::uint32_t vertex, const glm::vec3& direction) const {
    const glm::vec3 second = glm::cross(normals[vertex], axes[vertex]);
    return {static_cast<double>(glm::dot(direction, axes[vertex])), static_cast<double>(glm::dot(direction, second))};
}

glm::vec3 FieldDomain::fromFrame(std::uint32_t vertex, std::complex<double> value) const {
    const glm::vec3 second = glm::cross(normals[vertex], axes[vertex]);
    return axes[vertex] * static_cast<float>(value.real()) + second * static_cast<float>(value.imag());
}

std::complex<double> FieldDomain::turn(std::uint32_t from, std::uint32_t to) const {
    const std::complex<double> turned = inFrame(to, minimalRotation(normals[from], normals[to]) * axes[from]);
    const double length = std::abs(turned);
    return length > 0.0 ? turned / length : 1.0;
}

std::span<const glm::vec3> DirectionField::vertices() const {
    return m_state ? std::span<const glm::vec3>(m_state->directions) : std::span<const glm::vec3>();
}

std::span<const std::uint8_t> DirectionField::grows() const {
    return m_state ? std::span<const std::uint8_t>(m_state->domain->grows) : std::span<const std::uint8_t>();
}

glm::vec3 DirectionField::at(const SurfacePoint& point) const {
    if (!m_state) return glm::vec3(0.0f);
    const FieldDomain& domain = *m_state->domain;
    const SurfaceMesh& mesh = domain.mesh();
    if (point.triangle >= mesh.triangleCount() || !domain.grows[point.triangle]) return glm::vec3(0.0f);
    const glm::uvec3 corners = mesh.triangles[point.triangle];
    const float shares[3] = {1.0f - point.u - point.v, point.u, point.v};
    const glm::vec3 normal = normalAt(mesh, point);
    const bool careful = domain.nearParting[point.triangle] != 0;
    const PartingIndex::Root here{careful ? positionAt(mesh, point) : glm::vec3(0.0f), normal};
    glm::vec3 sum(0.0f), all(0.0f);
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = corners[k];
        const glm::vec3 turned =
            minimalRotation(domain.normals[vertex], normal) * m_state->directions[vertex] * shares[k];
        all += turned;
        if (careful && domain.apart(here, domain.root(vertex))) continue;
        sum += turned;
    }
    // Every corner beyond a parting: a sliver that has no vertex of its own follows its triangle.
    if (sum == glm::vec3(0.0f)) sum = all;
    sum -= normal * glm::dot(normal, sum);
    const float length = glm::length(sum);
    return length > 1e-6f ? sum / length : glm::vec3(0.0f);
}

bool DirectionField::parted(const SurfacePoint& a, const SurfacePoint& b) const {
    if (!m_state) return false;
    const FieldDomain& domain = *m_state->domain;
    if (domain.partings.empty() || (domain.nearParting[a.triangle] == 0 && domain.nearParting[b.triangle] == 0))
        return false;
    const SurfaceMesh& mesh = domain.mesh();
    return domain.apart({positionAt(mesh, a), normalAt(mesh, a)}, {positionAt(mesh, b), normalAt(mesh, b)});
}

std::vector<FieldSingularity> DirectionField::singularities() const {
    std::vector<FieldSingularity> found;
    if (!m_state) return found;
    const FieldDomain& domain = *m_state->domain;
    const SurfaceMesh& mesh = domain.mesh();
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        if (!domain.grows[t]) continue;
        const glm::uvec3 corners = mesh.triangles[t];
        double turned = 0.0;
        std::complex<double> around = 1.0;
        bool whole = true;
        for (int k = 0; k < 3 && whole; ++k) {
            const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
            const std::complex<double> from = domain.inFrame(a, m_state->directions[a]);
            const std::complex<double> to = domain.inFrame(b, m_state->directions[b]);
            whole =
                std::abs(from) > 0.0 && std::abs(to) > 0.0 && !(domain.nearParting[t] != 0 && domain.separated(a, b));
            if (!whole) break;
            const std::complex<double> along = domain.turn(a, b);
            turned += std::arg(to / (along * from));
            around *= along;
        }
        if (!whole) continue;
        // What the skin itself turns a vector by around the triangle is not the field's doing.
        const int index = static_cast<int>(std::lround((turned + std::arg(around)) / (2.0 * std::numbers::pi)));
        if (index != 0) found.push_back({t, index});
    }
    return found;
}

}  // namespace whorl
