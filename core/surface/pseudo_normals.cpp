// SPDX-License-Identifier: Apache-2.0
#include "core/surface/pseudo_normals.h"

#include "core/surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace whorl {
namespace {

// First vertex of all that lie at exactly the same position.
std::vector<std::uint32_t> weldByPosition(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
        const glm::vec3& p = positions[i];
        const glm::vec3& q = positions[j];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        if (p.z != q.z) return p.z < q.z;
        return i < j;
    };
    std::sort(order.begin(), order.end(), before);
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

// Unit normal, or zero for a face without area.
Vec3d faceNormal(const SurfaceMesh& mesh, const glm::uvec3& t) {
    const Vec3d a(mesh.positions[t.x]);
    const Vec3d n = glm::cross(Vec3d(mesh.positions[t.y]) - a, Vec3d(mesh.positions[t.z]) - a);
    const double length = glm::length(n);
    return length > 0.0 && std::isfinite(length) ? n / length : Vec3d(0.0);
}

double angleBetween(const Vec3d& a, const Vec3d& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct EdgeUse {
    std::uint64_t key;   // both welded vertices, the lower one first
    std::uint32_t side;  // 3 * triangle + corner that it starts from
};

// What is left when opposite normals cancel is rounding.
glm::vec3 normalised(const Vec3d& sum) {
    const double length = glm::length(sum);
    return length > 1e-6 ? glm::vec3(sum / length) : glm::vec3(0.0f);
}

}  // namespace

PseudoNormals::PseudoNormals(const SurfaceMesh& mesh) : m_mesh(mesh), m_vertexOf(weldByPosition(mesh.positions)) {
    const std::size_t triangles = mesh.triangles.size();
    std::vector<Vec3d> normals(triangles);
    std::vector<Vec3d> vertexSums(mesh.positions.size(), Vec3d(0.0));
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles);
    const auto vertex = [&](std::size_t triangle, std::size_t corner) {
        return m_vertexOf[mesh.triangles[triangle][static_cast<glm::length_t>(corner % 3)]];
    };
    for (std::size_t t = 0; t < triangles; ++t) {
        normals[t] = faceNormal(mesh, mesh.triangles[t]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = vertex(t, k);
            const std::uint32_t to = vertex(t, k + 1);
            const Vec3d p(mesh.positions[from]);
            const double angle =
                angleBetween(Vec3d(mesh.positions[to]) - p, Vec3d(mesh.positions[vertex(t, k + 2)]) - p);
            vertexSums[from] += normals[t] * angle;
            if (from != to) {
                uses.push_back({std::uint64_t{std::min(from, to)} << 32 | std::max(from, to),
                                static_cast<std::uint32_t>(3 * t + k)});
            }
        }
    }
    std::sort(uses.begin(), uses.end(),
              [](const EdgeUse& a, const EdgeUse& b) { return a.key != b.key ? a.key < b.key : a.side < b.side; });

    m_edges.assign(3 * triangles, glm::vec3(0.0f));
    std::vector<Vec3d> faces = normals;
    std::vector<bool> onBorder(mesh.positions.size(), false);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        Vec3d sum(0.0);
        for (; end < uses.size() && uses[end].key == uses[begin].key; ++end) sum += normals[uses[end].side / 3];
        if (end - begin == 1) {
            onBorder[uses[begin].key >> 32] = true;
            onBorder[uses[begin].key & 0xffffffffu] = true;
            continue;
        }
        for (std::size_t i = begin; i < end; ++i) m_edges[uses[i].side] = normalised(sum);
        // Faces on the same three vertices lie in one place; those that look the other way cancel.
        if (end - begin > 64) continue;  // a fan that no real mesh has; looking at all pairs would take for ever
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t j = begin; j < end; ++j) {
                const std::uint32_t mine = uses[i].side / 3;
                const std::uint32_t other = uses[j].side / 3;
                const bool samePlace = vertex(mine, uses[i].side % 3 + 2) == vertex(other, uses[j].side % 3 + 2);
                if (samePlace && glm::dot(normals[mine], normals[other]) < 0.0) faces[mine] = Vec3d(0.0);
            }
        }
    }
    // A degenerate edge is a vertex.
    m_vertices.resize(mesh.positions.size());
    for (std::size_t i = 0; i < m_vertices.size(); ++i)
        m_vertices[i] = onBorder[i] ? glm::vec3(0.0f) : normalised(vertexSums[i]);
    for (std::size_t t = 0; t < triangles; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (vertex(t, k) == vertex(t, k + 1)) m_edges[3 * t + k] = m_vertices[vertex(t, k)];
        }
    }
    m_faces.resize(triangles);
    for (std::size_t t = 0; t < triangles; ++t) m_faces[t] = glm::vec3(faces[t]);
}

bool PseudoNormals::inside(const Vec3d& position, const SurfacePoint& nearest) const {
    constexpr float nothing = 1e-6f;
    const std::uint32_t t = nearest.triangle;
    const float weights[3] = {1.0f - nearest.u - nearest.v, nearest.u, nearest.v};
    int zeros = 0;
    int lastZero = 0;
    int lastWhole = 0;
    for (int k = 0; k < 3; ++k) {
        if (weights[k] <= nothing) {
            ++zeros;
            lastZero = k;
        } else {
            lastWhole = k;
        }
    }
    glm::vec3 normal = m_faces[t];
    if (zeros == 1) normal = m_edges[3 * std::size_t{t} + static_cast<std::size_t>((lastZero + 1) % 3)];
    if (zeros == 2) normal = m_vertices[m_vertexOf[m_mesh.triangles[t][lastWhole]]];
    // In double from the corners: near the skin the difference is all that decides.
    const glm::uvec3 corner = m_mesh.triangles[t];
    const Vec3d place = Vec3d(m_mesh.positions[corner.x]) * (1.0 - double{nearest.u} - double{nearest.v}) +
                        Vec3d(m_mesh.positions[corner.y]) * double{nearest.u} +
                        Vec3d(m_mesh.positions[corner.z]) * double{nearest.v};
    return glm::dot(position - place, Vec3d(normal)) < 0.0;
}

}  // namespace whorl
