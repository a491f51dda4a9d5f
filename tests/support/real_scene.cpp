// SPDX-License-Identifier: Apache-2.0
#include "tests/support/real_scene.h"

#include "core/io/mesh_import.h"
#include "core/io/open.h"
#include "core/surface/adjacency.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace whorl::testing {

std::span<const RealMesh> realMeshes() {
    static constexpr RealMesh meshes[] = {
        {"bust", "bust.whorl", {0.5f, 0.5f}, 0.2f},
        {"creature", "creature.whorl", {0.5f, 0.66f}, 0.12f},
        {"head", "heads/makehuman_derived/head_neutral_sub1.glb", {0.5f, 0.5f}, 0.3f},
        {"cow", "animals/crane/spot/spot.obj", {0.5f, 0.6f}, 0.2f},
        {"duck", "animals/crane/bob/bob_tri.obj", {0.26f, 0.5f}, 0.13f},
        {"armadillo", "animals/odedstein/armadillo/armadillo.obj", {0.5f, 0.42f}, 0.12f},
        {"scanned bunny", "stanford/paper_sizes/bunny_69451_boxuv.glb", {0.68f, 0.5f}, 0.15f},
    };
    return meshes;
}

std::optional<SurfaceMesh> meshOf(const RealMesh& real, const char* samples) {
    const bool sample = std::string_view(real.file).ends_with(".whorl");
    const auto file = sample ? std::filesystem::path(samples) / real.file : realData(real.file);
    if (!file) return std::nullopt;
    Progress progress;
    auto opened = openGroom(*file, progress);
    if (!opened) return std::nullopt;
    return *opened->groom.mesh;
}

CrownScene::CrownScene(const RealMesh& real, SurfaceMesh mesh) : LicScene(std::move(mesh)) {
    const SurfaceMesh& m = *groom.mesh;
    const glm::vec3 size = surface->bounds.size();
    radius = real.radius * std::max({size.x, size.y, size.z});
    crown = surface->bounds.min + size * glm::vec3(real.crown.x, 0.0f, real.crown.y);
    crown = under({}, {}).front();
    // Triangles in the ball around the crown that hang together.
    const auto across = trianglesAcross(m);
    grows.assign(m.triangleCount(), 0);
    std::vector<std::uint32_t> open{placeAt(crown).triangle};
    grows[open.front()] = 1;
    while (!open.empty()) {
        const std::uint32_t here = open.back();
        open.pop_back();
        for (const std::uint32_t next : across[here]) {
            if (next == noTriangle || grows[next]) continue;
            if (glm::distance(positionAt(m, {next, 1.0f / 3.0f, 1.0f / 3.0f}), crown) > radius) continue;
            grows[next] = 1;
            open.push_back(next);
        }
    }
    float lengths = 0.0f, sides = 0.0f;
    for (std::uint32_t t = 0; t < m.triangleCount(); ++t) {
        for (int k = 0; k < 3 && grows[t]; ++k, sides += 1.0f)
            lengths += glm::distance(m.positions[m.triangles[t][k]], m.positions[m.triangles[t][(k + 1) % 3]]);
    }
    edge = lengths / sides;
    part(under({0.0f, -1.2f}, {0.0f, 1.2f}));
    m_slack = 0.05f * edge;
    for (const SurfacePoint& point : groom.partings->front().points)
        if (grows[point.triangle]) m_slack = std::max(m_slack, 1.1f * std::abs(positionAt(m, point).x - crown.x));
    for (const int side : {-1, 1})
        for (int number = 0; number < 4; ++number) stroke(strokePlaces(side, number, 0.0f));
    solve();
}

std::vector<glm::vec3> CrownScene::under(glm::vec2 from, glm::vec2 to) const {
    const int last = static_cast<int>(std::ceil(glm::distance(from, to) / 0.02f));
    std::vector<glm::vec3> places;
    for (int k = 0; k <= last; ++k) {
        const glm::vec2 at = glm::mix(from, to, last > 0 ? static_cast<float>(k) / static_cast<float>(last) : 0.0f);
        const float above = 2.0f * surface->bounds.max.y - surface->bounds.min.y;
        const auto hit =
            surface->query.raycast({crown.x + at.x * radius, above, crown.z + at.y * radius}, {0.0f, -1.0f, 0.0f});
        if (hit) places.push_back(hit->position);
    }
    return places;
}

std::vector<glm::vec3> CrownScene::strokePlaces(int side, int number, float turn) const {
    const glm::vec2 middle(0.45f * static_cast<float>(side), 0.3f * static_cast<float>(number) - 0.45f);
    // Away from the parting, more and less aslant.
    const float angle = turn + 0.3f * static_cast<float>(number % 3) - 0.2f;
    const glm::vec2 way(static_cast<float>(side) * std::cos(angle), std::sin(angle));
    return under(middle - 0.2f * way, middle + 0.2f * way);
}

void CrownScene::turnStrokes(int side, float turn) {
    std::vector<FieldStroke>& strokes = groom.strokes.edit();
    for (int number = 0; number < 4; ++number) {
        const std::size_t at = static_cast<std::size_t>(number) + (side > 0 ? 4 : 0);
        strokes[at].points = *tracedParting(*surface, strokePlaces(side, number, turn));
    }
}

bool CrownScene::separates() const {
    const SurfaceMesh& m = *groom.mesh;
    const std::vector<glm::vec3> line = partingPositions(m, groom.partings->front());
    for (const glm::vec3& end : {line.front(), line.back()})
        if (glm::distance(end, crown) < 1.1f * radius) return false;
    for (std::uint32_t t = 0; t < m.triangleCount(); ++t) {
        if (!grows[t]) continue;
        const glm::uvec3 c = m.triangles[t];
        const int side = sideOf(m.positions[c.x]);
        if (side == sideOf(m.positions[c.y]) && side == sideOf(m.positions[c.z])) continue;
        const glm::vec3 middle = (m.positions[c.x] + m.positions[c.y] + m.positions[c.z]) / 3.0f;
        const float reach = 2.0f * glm::distance(middle, m.positions[c.x]) + partingStep(*surface);
        if (std::ranges::none_of(line, [&](const glm::vec3& p) { return glm::distance(p, middle) < reach; }))
            return false;
    }
    return true;
}

std::pair<float, int> worstAlong(const CrownScene& scene, const FieldStroke& stroke) {
    const SurfaceMesh& mesh = scene.surface->mesh();
    std::vector<glm::vec3> line;
    std::vector<float> before;
    for (const SurfacePoint& point : stroke.points) {
        line.push_back(positionAt(mesh, point));
        before.push_back(line.size() < 2 ? 0.0f : before.back() + glm::distance(line.back(), line[line.size() - 2]));
    }
    const auto after = [&](float way) {
        way = std::clamp(way, 0.0f, before.back());
        std::size_t next = 1;
        while (next + 1 < line.size() && before[next] < way) ++next;
        const float piece = before[next] - before[next - 1];
        return glm::mix(line[next - 1], line[next], piece > 0.0f ? (way - before[next - 1]) / piece : 0.0f);
    };
    std::pair<float, int> worst{0.0f, 0};
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::vec3 direction = scene.field.at(stroke.points[i]);
        const float toEnd = std::min(before[i], before.back() - before[i]);
        if (direction == glm::vec3(0.0f) || toEnd < 0.5f * scene.edge) continue;
        const glm::vec3 normal = normalAt(mesh, stroke.points[i]);
        const glm::vec3 way = after(before[i] + scene.edge) - after(before[i] - scene.edge);
        worst.first = std::max(worst.first, degreesBetween(direction, way - normal * glm::dot(normal, way)));
        ++worst.second;
    }
    return worst;
}

}  // namespace whorl::testing
