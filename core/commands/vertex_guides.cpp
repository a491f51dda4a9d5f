// SPDX-License-Identifier: Apache-2.0
#include "core/commands/vertex_guides.h"

#include "core/base/random.h"
#include "core/brushes/constraints.h"
#include "core/brushes/guide_shape.h"
#include "core/hair/curve.h"
#include "core/sampling/density.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

constexpr std::size_t mostGuides = 1000000;
constexpr std::uint32_t splitChannel = 91;
constexpr int deepest = 24;

// A triangle inside a triangle of the mesh, by its corners' barycentric weights (u, v).
using Piece = std::array<glm::vec2, 3>;

float areaShare(const Piece& piece) {
    const glm::vec2 a = piece[1] - piece[0], b = piece[2] - piece[0];
    return std::abs(a.x * b.y - a.y * b.x);
}

// Where guides go.
class Places {
public:
    Places(const SurfaceMesh& mesh, const Groom& groom, const VertexGuides& options)
        : m_mesh(mesh), m_groom(groom), m_density(groom), m_triangles(groom, options.density), m_options(options) {}

    void addVertices() {
        std::vector<std::uint8_t> done(m_mesh.positions.size(), 0);
        for (std::uint32_t t = 0; t < m_mesh.triangleCount(); ++t) {
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = m_mesh.triangles[t][corner];
                const SurfacePoint root{t, corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f};
                if (done[vertex] || !(densityAt(root) > 0.0f)) continue;
                done[vertex] = 1;
                m_roots.push_back(root);
            }
        }
    }

    void addInside(std::uint32_t triangle) {
        const double area = triangleArea(m_mesh, triangle);
        if (!(area > 0.0)) return;
        m_splits = 0;
        split(triangle, {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}, area, 0);
    }

    std::vector<SurfacePoint>& roots() { return m_roots; }
    int groupAt(const SurfacePoint& root) const {
        return std::clamp(m_density.groupAt(uvAt(m_mesh, root)), 0, static_cast<int>(m_groom.groups->size()) - 1);
    }

private:
    float densityAt(const SurfacePoint& root) const { return m_density.at(root.triangle, uvAt(m_mesh, root)); }

    void split(std::uint32_t triangle, const Piece& piece, double area, int depth) {
        if (depth == deepest || m_roots.size() > mostGuides) return;
        if (!m_density.growsOn(triangle)) return;
        const float density = m_triangles.mean(triangle, piece);
        const double wanted = static_cast<double>(density * areaShare(piece) * m_options.perSquareMetre) * area;
        if (!(wanted > 1.0)) return;
        // Not too near an edge: slivers would be split without end.
        float a = 0.2f + randomFloat(seed(), triangle, splitChannel + 2 * m_splits);
        float b = 0.2f + randomFloat(seed(), triangle, splitChannel + 2 * m_splits + 1);
        float c = 0.2f + std::abs(a - b);
        ++m_splits;
        const float sum = a + b + c;
        a /= sum, b /= sum, c /= sum;
        const glm::vec2 inside = piece[0] * a + piece[1] * b + piece[2] * c;
        const SurfacePoint root{triangle, inside.x, inside.y};
        if (densityAt(root) > 0.0f) m_roots.push_back(root);
        split(triangle, {piece[0], piece[1], inside}, area, depth + 1);
        split(triangle, {piece[1], piece[2], inside}, area, depth + 1);
        split(triangle, {piece[2], piece[0], inside}, area, depth + 1);
    }

    std::uint32_t seed() const { return static_cast<std::uint32_t>(m_groom.counts->seed); }

    const SurfaceMesh& m_mesh;
    const Groom& m_groom;
    DensityLookup m_density;
    TriangleDensities m_triangles;
    const VertexGuides& m_options;
    std::vector<SurfacePoint> m_roots;
    std::uint32_t m_splits = 0;
};

}  // namespace

Result<void> placeGuidesOnVertices(Groom& groom, const Surface& surface, const VertexGuides& options,
                                   Progress& progress) {
    const SurfaceMesh& mesh = surface.mesh();
    const Map* lengths = options.lengthMap.empty() ? nullptr : groom.maps.find(options.lengthMap);
    if (!options.lengthMap.empty() && !lengths) return Error{"There is no map \"" + options.lengthMap + "\"."};
    Places places(mesh, groom, options);
    places.addVertices();
    for (std::uint32_t t = 0; t < mesh.triangleCount() && options.perSquareMetre > 0.0f; ++t) {
        if (t % 4096 == 0 && progress.cancelled()) return cancelledError();
        places.addInside(t);
    }
    if (places.roots().size() > mostGuides)
        return Error{"There would be more than " + std::to_string(mostGuides) +
                     " guides; ask for fewer a square metre, or place a number of them instead."};
    if (places.roots().empty())
        return Error{"No guide has a place: no part grows hair, or the density is zero everywhere."};

    const float whole = options.length > 0.0f ? options.length : defaultGuideLength(surface);
    const SkinClearance skin = SkinClearance::of(surface);
    GuideSet guides;
    guides.setNextId(groom.guides.nextId());
    for (std::size_t i = 0; i < places.roots().size(); ++i) {
        if (i % 64 == 0) {
            if (progress.cancelled()) return cancelledError();
            progress.report(static_cast<float>(i) / static_cast<float>(places.roots().size()), "Placing guides");
        }
        const SurfacePoint& root = places.roots()[i];
        const float length = whole * (lengths ? lengths->sample(uvAt(mesh, root)) : 1.0f);
        if (!(length > 0.0f)) continue;
        const int group = places.groupAt(root);
        const int segments = std::max((*groom.groups)[static_cast<std::size_t>(group)].params.general.segments, 1);
        const glm::vec3 position = positionAt(mesh, root), normal = normalAt(mesh, root);
        std::vector<glm::vec3> points{position};
        for (int k = 1; k <= segments; ++k) {
            const float share = static_cast<float>(k * (k + 1)) / static_cast<float>(segments * (segments + 1));
            points.push_back(position + normal * (length * share));
        }
        const std::vector<glm::vec3> straight = points;
        settle(points, straight, skin);
        guides.append(root, static_cast<std::uint8_t>(group), points);
    }
    if (guides.empty()) return Error{"All guides would have no length: the map is black where hair grows."};
    groom.guides = std::move(guides);
    return {};
}

std::vector<glm::vec3> tessellated(std::span<const glm::vec3> points, int segments) {
    // A Catmull-Rom piece is the Bezier curve with the control points b, b + (c - a) / 6, c - (d - b) / 6, c.
    constexpr int fine = 32;
    const std::size_t pieces = points.size() - 1;
    std::vector<double> along{0.0};
    glm::vec3 before = points[0];
    for (std::size_t i = 1; i <= pieces * fine; ++i) {
        const glm::vec3 here = strandPoint(points, static_cast<float>(i) / fine);
        along.push_back(along.back() + static_cast<double>(glm::distance(before, here)));
        before = here;
    }
    std::vector<glm::vec3> even{points.front()};
    for (int k = 1; k < segments; ++k) {
        const double wanted = along.back() * k / segments;
        const auto after = std::upper_bound(along.begin() + 1, along.end() - 1, wanted);
        const double low = *(after - 1), high = *after;
        const double place =
            static_cast<double>(after - 1 - along.begin()) + (high > low ? (wanted - low) / (high - low) : 0.0);
        even.push_back(strandPoint(points, static_cast<float>(place / fine)));
    }
    even.push_back(points.back());
    return even;
}

Result<void> tessellateGuides(Groom& groom, int group, int segments) {
    if (group < 0 || static_cast<std::size_t>(group) >= groom.groups->size()) return Error{"There is no such group."};
    if (segments < 1 || segments > 100) return Error{"Guides have 1 to 100 segments."};
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        if (groom.guides.group(i) != group) continue;
        groom.guides.setPoints(i, tessellated(groom.guides.points(i), segments));
    }
    groom.groups.edit()[static_cast<std::size_t>(group)].params.general.segments = segments;
    return {};
}

}  // namespace whorl
