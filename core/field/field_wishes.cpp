// SPDX-License-Identifier: Apache-2.0
#include "core/field/field_wishes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

using Complex = FieldMesh::Complex;

/// Weight of a stroke of one edge's length against a unit of smoothness: enough for a fraction of a degree.
constexpr double strokeStrength = 20000.0;
/// Weight of an area of the radius squared: the core holds against what is around it, the rim blends.
constexpr double areaStrength = 2000.0;

/// The wish that the field has direction `way` at a place; nothing where it has none of its own.
void addWish(const FieldMesh& field, const SurfacePoint& point, const glm::vec3& way, double weight,
             std::vector<FieldWish>& wishes) {
    const FieldDomain& domain = *field.domain;
    const SurfaceMesh& mesh = domain.mesh();
    if (!domain.grows[point.triangle]) return;
    const glm::vec3 normal = normalAt(mesh, point);
    const glm::vec3 tangent = way - normal * glm::dot(normal, way);
    if (!(glm::length(tangent) > 1e-9f)) return;
    // Frame at the place: along the stroke is 1.
    const glm::vec3 along = glm::normalize(tangent), left = glm::cross(normal, along);
    const float shares[3] = {1.0f - point.u - point.v, point.u, point.v};
    FieldWish wish;
    const PartingIndex::Root here{positionAt(mesh, point), normal};
    double met = 0.0;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.triangles[point.triangle][k];
        const bool apart = domain.nearParting[point.triangle] != 0 && domain.apart(here, domain.root(corner));
        if (apart) continue;
        wish.unknowns[k] = field.unknown[corner];
        const glm::vec3 turned = minimalRotation(domain.normals[corner], normal) * domain.axes[corner];
        const Complex turn(static_cast<double>(glm::dot(turned, along)), static_cast<double>(glm::dot(turned, left)));
        wish.shares[k] = turn * static_cast<double>(shares[k]);
        met += static_cast<double>(shares[k]);
    }
    if (!(met > 1e-3)) return;
    for (Complex& share : wish.shares) share /= met;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = wish.unknowns[k], b = wish.unknowns[(k + 1) % 3];
        if (a != FieldMesh::none && b != FieldMesh::none && a != b) wish.pairs[k] = field.pairOf(a, b);
    }
    wish.weight = weight;
    wishes.push_back(wish);
}

void addAlong(const FieldMesh& field, const FieldStroke& stroke, std::vector<FieldWish>& wishes) {
    const double step = std::max(field.edgeLength, 1e-12);
    for (const LineByLength& line : linesOf(field.domain->mesh(), stroke.points)) {
        const int places = std::clamp(static_cast<int>(2.0 * static_cast<double>(line.length()) / step), 1, 100000);
        const float share = line.length() / static_cast<float>(places);
        for (int k = 0; k < places && line.length() > 0.0f; ++k) {
            const float here = (static_cast<float>(k) + 0.5f) * share;
            // The direction over an edge's length: a line over flat triangles has kinks where they meet, and the hand
            // shakes.
            const auto reach = static_cast<float>(step);
            const glm::vec3 way = line.at(here + reach) - line.at(here - reach);
            const auto hit = field.domain->surface->query.nearest(line.at(here));
            const double weight = strokeStrength * static_cast<double>(stroke.weight * share) / step;
            if (hit) addWish(field, hit->point, way, weight, wishes);
        }
    }
}

void addAround(const FieldMesh& field, const FieldStroke& stroke, std::vector<FieldWish>& wishes) {
    if (!(stroke.radius > 0.0f)) return;
    const bool whorl = turns(stroke.kind);
    const std::span<const SurfacePoint> points(stroke.points);
    const auto radius = static_cast<double>(stroke.radius);
    for (const WayToLine& way : waysToLine(field, whorl ? points.first(1) : points, stroke.radius)) {
        const double distance = std::abs(way.way);
        if (!(distance > 1e-3 * field.edgeLength)) continue;
        const Complex toLine = way.way / distance;
        FieldWish wish;
        wish.unknowns[0] = way.unknown;
        wish.shares[0] = 1.0;
        // Away from the point, and from there a quarter turn to the left; clockwise to the right.
        wish.wanted = whorl ? -toLine * Complex(0.0, stroke.kind == StrokeKind::Whorl ? 1.0 : -1.0)
                      : stroke.kind == StrokeKind::Repel ? -toLine
                                                         : toLine;
        const double inside = 1.0 - distance * distance / (radius * radius);
        wish.weight = areaStrength * static_cast<double>(stroke.weight) * field.areas[way.unknown] / (radius * radius) *
                      inside * inside;
        wishes.push_back(wish);
    }
}

}  // namespace

LineByLength::LineByLength(std::vector<glm::vec3> points) : m_points(std::move(points)) {
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        m_before.push_back(i == 0 ? 0.0f : m_before.back() + glm::distance(m_points[i - 1], m_points[i]));
    }
}

glm::vec3 LineByLength::at(float metres) const {
    metres = std::clamp(metres, 0.0f, length());
    const auto next = static_cast<std::size_t>(std::ranges::upper_bound(m_before, metres) - m_before.begin());
    if (next >= m_points.size()) return m_points.back();
    const float piece = m_before[next] - m_before[next - 1];
    return glm::mix(m_points[next - 1], m_points[next], piece > 0.0f ? (metres - m_before[next - 1]) / piece : 0.0f);
}

std::vector<LineByLength> linesOf(const SurfaceMesh& mesh, std::span<const SurfacePoint> points) {
    std::vector<LineByLength> lines;
    std::vector<glm::vec3> line;
    const auto finish = [&] {
        if (!line.empty()) lines.emplace_back(std::move(line));
        line = {};
    };
    for (const SurfacePoint& point : points) {
        if (point.triangle < mesh.triangleCount()) {
            line.push_back(positionAt(mesh, point));
        } else {
            finish();
        }
    }
    finish();
    return lines;
}

std::vector<FieldWish> wishesOf(const FieldMesh& field, const FieldStroke& stroke) {
    std::vector<FieldWish> wishes;
    if (!(stroke.weight > 0.0f) || stroke.points.empty()) return wishes;
    if (stroke.kind == StrokeKind::Along) {
        addAlong(field, stroke, wishes);
    } else {
        addAround(field, stroke, wishes);
    }
    return wishes;
}

}  // namespace whorl
