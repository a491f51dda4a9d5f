// SPDX-License-Identifier: Apache-2.0
#include "core/hair/guide_voronoi.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/surface/closest_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace whorl {
namespace {

constexpr int ofMesh = -1;  // an edge of the mesh's triangle
constexpr double facing = 0.1;
constexpr std::uint64_t jitterChannel = 90;

struct Corner {
    Vec3d position{0.0};
    int edge = ofMesh;  // the guide behind the edge from this corner to the next
};
using Polygon = std::vector<Corner>;

struct Near {
    double distance;
    std::uint32_t guide;
};

// What all threads share.
struct Guides {
    const GuideIndex& index;
    std::size_t group;
    std::span<const GuideRoot> roots;
    std::vector<Vec3d> places;  // moved a little
};

std::vector<Vec3d> movedPlaces(const GuideIndex& index, std::size_t group) {
    const std::span<const GuideRoot> roots = index.rootsOf(group);
    Bounds bounds;
    for (const GuideRoot& root : roots) bounds.add(root.position);
    const double least = 1e-7 * static_cast<double>(glm::length(bounds.size()));
    std::vector<Vec3d> places(roots.size());
    parallelFor(roots.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto apart =
                static_cast<double>(index.reach(group, roots[i].position, std::min<std::size_t>(2, roots.size())));
            Vec3d jitter(0.0);
            for (std::uint32_t axis = 0; axis < 3; ++axis)
                jitter[static_cast<int>(axis)] =
                    static_cast<double>(randomFloat(1, roots[i].id, static_cast<std::uint32_t>(jitterChannel) + axis)) -
                    0.5;
            places[i] = Vec3d(roots[i].position) + jitter * std::max(1e-4 * apart, least);
        }
    });
    return places;
}

// Clips triangles of the mesh. One object a thread.
class Clipper {
public:
    explicit Clipper(const Guides& guides) : m_guides(guides) {}

    void clip(const std::array<Vec3d, 3>& triangle, std::vector<glm::uvec3>& out) {
        const Vec3d across = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        const double area = glm::length(across);
        if (!(area > 0.0)) return;
        m_normal = across / area;
        m_waiting.clear();
        m_seen.clear();
        if (!push(nearestFacing((triangle[0] + triangle[1] + triangle[2]) / 3.0))) return;
        for (std::size_t i = 0; i < m_waiting.size(); ++i) {
            const std::uint32_t guide = m_waiting[i];
            m_polygon.clear();
            for (const Vec3d& corner : triangle) m_polygon.push_back({corner, ofMesh});
            cutToCell(guide);
            if (m_polygon.size() < 3) continue;
            for (std::size_t k = 0; k < m_polygon.size(); ++k) {
                const int before = m_polygon[(k + m_polygon.size() - 1) % m_polygon.size()].edge;
                const int after = m_polygon[k].edge;
                if (after != ofMesh) push(static_cast<std::uint32_t>(after));
                if (before == ofMesh || after == ofMesh || before == after) continue;
                std::array<std::uint32_t, 3> triple{guide, static_cast<std::uint32_t>(before),
                                                    static_cast<std::uint32_t>(after)};
                std::sort(triple.begin(), triple.end());
                out.emplace_back(triple[0], triple[1], triple[2]);
            }
        }
    }

private:
    bool faces(std::uint32_t guide) const { return glm::dot(Vec3d(m_guides.roots[guide].normal), m_normal) > facing; }

    bool push(std::optional<std::uint32_t> guide) {
        if (!guide) return false;
        if (std::find(m_seen.begin(), m_seen.end(), *guide) != m_seen.end()) return false;
        m_seen.push_back(*guide);
        m_waiting.push_back(*guide);
        return true;
    }

    // All guides within `radius` of a place, nearest first.
    void around(const Vec3d& place, float radius) {
        m_guides.index.within(m_guides.group, glm::vec3(place), radius, m_found);
        m_near.clear();
        for (const std::uint32_t guide : m_found) {
            if (faces(guide)) m_near.push_back({glm::distance(m_guides.places[guide], place), guide});
        }
        std::sort(m_near.begin(), m_near.end(), [](const Near& a, const Near& b) {
            return a.distance != b.distance ? a.distance < b.distance : a.guide < b.guide;
        });
    }

    std::optional<std::uint32_t> nearestFacing(const Vec3d& place) {
        const std::size_t all = m_guides.roots.size();
        float radius = m_guides.index.reach(m_guides.group, glm::vec3(place), 1) * 1.01f + 1e-12f;
        for (int tries = 0; tries < 40; ++tries, radius *= 2.0f) {
            around(place, radius);
            if (!m_near.empty()) return m_near.front().guide;
            if (m_found.size() == all) break;
        }
        return std::nullopt;
    }

    // Keeps the part of the polygon that is nearer to `guide` than to any other that faces it.
    void cutToCell(std::uint32_t guide) {
        const Vec3d centre = m_guides.places[guide];
        double reach = 0.0;
        const auto measure = [&] {
            reach = 0.0;
            for (const Corner& corner : m_polygon) reach = std::max(reach, glm::distance(corner.position, centre));
        };
        measure();
        const std::size_t all = m_guides.roots.size();
        // Guides farther away than twice the farthest corner do not cut; start with a few and look at more as needed.
        float radius =
            std::max(m_guides.index.reach(m_guides.group, glm::vec3(centre), std::min<std::size_t>(12, all)) * 1.01f,
                     static_cast<float>(reach) * 0.01f + 1e-20f);
        double done = -1.0;
        while (true) {
            around(centre, radius);
            for (const Near& near : m_near) {
                if (near.guide == guide || near.distance <= done) continue;
                if (near.distance > 2.0 * reach) return;
                cut(centre, m_guides.places[near.guide], static_cast<int>(near.guide));
                if (m_polygon.size() < 3) return;
                measure();
            }
            if (static_cast<double>(radius) * 0.99 > 2.0 * reach || m_found.size() == all) return;
            done = m_near.empty() ? done : m_near.back().distance;
            radius *= 2.0f;
        }
    }

    // Sutherland and Hodgman against the bisector of two guides.
    void cut(const Vec3d& own, const Vec3d& other, int guide) {
        const Vec3d way = other - own;
        const double middle = glm::dot(way, (own + other) * 0.5);
        m_cut.clear();
        for (std::size_t i = 0; i < m_polygon.size(); ++i) {
            const Corner& here = m_polygon[i];
            const Corner& next = m_polygon[(i + 1) % m_polygon.size()];
            const double a = glm::dot(way, here.position) - middle, b = glm::dot(way, next.position) - middle;
            if (a <= 0.0) m_cut.push_back(here);
            if ((a <= 0.0) == (b <= 0.0)) continue;
            const Vec3d place = here.position + (next.position - here.position) * (a / (a - b));
            // Going out, the cut follows; coming in, what is left of the old edge.
            m_cut.push_back({place, a <= 0.0 ? guide : here.edge});
        }
        std::swap(m_cut, m_polygon);
    }

    const Guides& m_guides;
    Vec3d m_normal{0.0};
    Polygon m_polygon, m_cut;
    std::vector<std::uint32_t> m_waiting, m_seen, m_found;
    std::vector<Near> m_near;
};

// The nearest guide of every vertex, whatever way it faces.
std::vector<std::uint32_t> nearestOfVertices(const SurfaceMesh& mesh, const GuideIndex& index, std::size_t group) {
    std::vector<std::uint32_t> nearest(mesh.positions.size());
    parallelFor(nearest.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) nearest[i] = index.nearestRoot(group, mesh.positions[i]);
    });
    return nearest;
}

}  // namespace

std::vector<glm::uvec3> meetingGuides(const Groom& groom, const GuideIndex& index, std::size_t group) {
    const SurfaceMesh& mesh = *groom.mesh;
    const Guides guides{index, group, index.rootsOf(group), movedPlaces(index, group)};
    if (guides.roots.size() < 3) return {};
    const std::vector<std::uint32_t> nearest = nearestOfVertices(mesh, index, group);
    constexpr std::size_t grain = 256;
    std::vector<std::vector<glm::uvec3>> found((mesh.triangleCount() + grain - 1) / grain);
    parallelFor(mesh.triangleCount(), grain, [&](std::size_t begin, std::size_t end) {
        Clipper clipper(guides);
        for (std::size_t t = begin; t < end; ++t) {
            if (!groom.growsHair(partOfTriangle(mesh, static_cast<std::uint32_t>(t)))) continue;
            const glm::uvec3 corners = mesh.triangles[t];
            const glm::vec3 normal = triangleNormal(mesh, static_cast<std::uint32_t>(t));
            const std::uint32_t first = nearest[corners.x];
            // Cells are convex: a triangle with its corners in one cell lies in it.
            if (first == nearest[corners.y] && first == nearest[corners.z] &&
                glm::dot(guides.roots[first].normal, normal) > static_cast<float>(facing))
                continue;
            clipper.clip(
                {Vec3d(mesh.positions[corners.x]), Vec3d(mesh.positions[corners.y]), Vec3d(mesh.positions[corners.z])},
                found[begin / grain]);
        }
    });
    std::vector<glm::uvec3> all;
    for (const std::vector<glm::uvec3>& some : found) all.insert(all.end(), some.begin(), some.end());
    const auto before = [](const glm::uvec3& a, const glm::uvec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::sort(all.begin(), all.end(), before);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace whorl
