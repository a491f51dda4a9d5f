// SPDX-License-Identifier: Apache-2.0
#include "render/passes/strokes_pass.h"

#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whorl {
namespace {

using Lines = std::vector<std::vector<glm::vec3>>;

/// Two unit vectors along the skin at `normal`.
std::pair<glm::vec3, glm::vec3> tangents(const glm::vec3& normal) {
    const glm::vec3 aside = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 u = glm::normalize(glm::cross(aside, normal));
    return {u, glm::cross(normal, u)};
}

float sizeOf(const SurfaceMesh& mesh) {
    const Bounds bounds = boundsOf(mesh);
    if (bounds.empty()) return 1.0f;
    const glm::vec3 size = bounds.size();
    return std::max({size.x, size.y, size.z});
}

/// Two short lines that end at `tip`, which is reached along `way`.
void addHead(Lines& lines, const glm::vec3& tip, const glm::vec3& way, const glm::vec3& normal, float length) {
    const glm::vec3 side = glm::cross(normal, way);
    for (const float turn : {1.0f, -1.0f}) lines.push_back({tip - way * length + side * (0.5f * turn * length), tip});
}

struct Drawn {
    const SurfaceMesh& mesh;
    float size;  // of the mesh
    Lines lines{};
    Lines circles{};

    glm::vec3 lifted(const SurfacePoint& point) const {
        return positionAt(mesh, point) + normalAt(mesh, point) * (0.002f * size);
    }

    void add(const FieldStroke& stroke) {
        std::vector<glm::vec3> line;
        for (const SurfacePoint& point : stroke.points) line.push_back(lifted(point));
        if (stroke.kind == StrokeKind::Along && line.size() >= 2) {
            const glm::vec3 last = line.back() - line[line.size() - 2];
            const float length = glm::length(last);
            if (length > 0.0f)
                addHead(lines, line.back(), last / length, normalAt(mesh, stroke.points.back()), 0.012f * size);
        } else if (stroke.kind != StrokeKind::Along && !line.empty()) {
            addArrows(stroke, line[line.size() / 2], normalAt(mesh, stroke.points[line.size() / 2]));
        }
        if (line.size() >= 2) lines.push_back(std::move(line));
    }

    // Arrows around a place: to it, from it or around it, as far as the stroke reaches.
    void addArrows(const FieldStroke& stroke, const glm::vec3& centre, const glm::vec3& normal) {
        const float radius = stroke.radius > 0.0f ? stroke.radius : 0.03f * size;
        const auto [u, v] = tangents(normal);
        const auto at = [&, u = u, v = v](float angle, float share) {
            return centre + (u * std::cos(angle) + v * std::sin(angle)) * (radius * share);
        };
        constexpr int pieces = 48;
        constexpr float round = 2.0f * std::numbers::pi_v<float>;
        std::vector<glm::vec3>& circle = circles.emplace_back();
        for (int i = 0; i <= pieces; ++i) circle.push_back(at(round * static_cast<float>(i) / pieces, 1.0f));
        const float spin = stroke.kind == StrokeKind::Whorl ? 1.0f : -1.0f;
        for (int arrow = 0; arrow < 4; ++arrow) {
            const float angle = round * static_cast<float>(arrow) / 4.0f;
            std::vector<glm::vec3>& line = lines.emplace_back();
            if (turns(stroke.kind)) {
                for (int i = 0; i <= 8; ++i) line.push_back(at(angle + spin * 0.14f * static_cast<float>(i), 0.45f));
            } else {
                const bool inwards = stroke.kind == StrokeKind::Attract;
                line = {at(angle, inwards ? 0.6f : 0.2f), at(angle, inwards ? 0.2f : 0.6f)};
            }
            const glm::vec3 tip = line.back(), way = tip - line[line.size() - 2];
            addHead(lines, tip, glm::normalize(way), normal, 0.12f * radius);
        }
    }
};

}  // namespace

Result<StrokesPass> StrokesPass::create() {
    StrokesPass pass;
    for (LineRibbons* ribbons : {&pass.m_lines, &pass.m_chosen, &pass.m_circles, &pass.m_turns, &pass.m_saddles}) {
        Result<LineRibbons> lines = LineRibbons::create();
        if (!lines) return lines.error();
        *ribbons = std::move(*lines);
    }
    return pass;
}

void StrokesPass::setGroom(const Groom& groom, std::uint32_t selected, Uploads& uploads) {
    if (groom.strokes.sameAs(m_strokes) && groom.mesh.sameAs(m_mesh) && selected == m_selected) return;
    m_strokes = groom.strokes;
    m_mesh = groom.mesh;
    m_selected = selected;
    const float size = m_strokes->empty() ? 1.0f : sizeOf(*m_mesh);
    Drawn all{*m_mesh, size}, chosen{*m_mesh, size};
    for (const FieldStroke& stroke : *m_strokes) (stroke.id == selected ? chosen : all).add(stroke);
    all.circles.insert(all.circles.end(), chosen.circles.begin(), chosen.circles.end());
    m_lines.set(all.lines, uploads);
    m_chosen.set(chosen.lines, uploads);
    m_circles.set(all.circles, uploads);
}

void StrokesPass::setSingularities(const Groom& groom, std::span<const FieldSingularity> places, Uploads& uploads) {
    if (groom.mesh.sameAs(m_starsMesh) && std::ranges::equal(places, m_stars)) return;
    m_starsMesh = groom.mesh;
    m_stars.assign(places.begin(), places.end());
    Lines stars[2];
    const SurfaceMesh& mesh = *groom.mesh;
    const float size = places.empty() ? 1.0f : sizeOf(mesh);
    for (const FieldSingularity& place : places) {
        if (place.triangle >= mesh.triangleCount()) continue;  // of a mesh that was
        const SurfacePoint middle{place.triangle, 1.0f / 3.0f, 1.0f / 3.0f};
        const glm::vec3 normal = triangleNormal(mesh, place.triangle);
        const glm::vec3 centre = positionAt(mesh, middle) + normal * (0.003f * size);
        const auto [u, v] = tangents(normal);
        for (int ray = 0; ray < 3; ++ray) {
            const float angle = std::numbers::pi_v<float> * static_cast<float>(ray) / 3.0f;
            const glm::vec3 way = (u * std::cos(angle) + v * std::sin(angle)) * (0.008f * size);
            stars[place.index < 0 ? 1 : 0].push_back({centre - way, centre + way});
        }
    }
    m_turns.set(stars[0], uploads);
    m_saddles.set(stars[1], uploads);
}

void StrokesPass::draw(glm::ivec2 size) {
    const glm::vec3 dark(0.55f, 0.16f, 0.02f), bright(1.0f, 0.62f, 0.08f);
    m_circles.draw(size, {.root = bright, .tip = bright, .halfWidth = 0.8f, .opacity = 0.6f, .hiddenOpacity = 0.1f});
    m_lines.draw(size, {.root = dark, .tip = bright, .halfWidth = 2.0f});
    m_chosen.draw(size, {.root = glm::vec3(0.9f), .tip = glm::vec3(1.0f), .halfWidth = 2.8f});
    m_turns.draw(size, {.root = glm::vec3(1, 0.1f, 0.3f), .tip = glm::vec3(1, 0.1f, 0.3f), .hiddenOpacity = 0.05f});
    m_saddles.draw(size, {.root = glm::vec3(0.1f, 0.4f, 1), .tip = glm::vec3(0.1f, 0.4f, 1), .hiddenOpacity = 0.05f});
}

}  // namespace whorl
