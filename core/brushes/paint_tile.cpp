// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/paint_tile.h"

#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

constexpr int tileSize = Map::tileSize;

std::array<glm::dvec2, 3> cornersInTexels(const SurfaceMesh& mesh, const Map& map, std::uint32_t triangle) {
    std::array<glm::dvec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = glm::dvec2(map.texelFromUv(mesh.cornerUvs[std::size_t{3} * triangle + k]));
    }
    return corners;
}

/// Barycentrics of `p`; all NaN for a triangle without area.
glm::dvec3 barycentrics(const std::array<glm::dvec2, 3>& c, const glm::dvec2& p) {
    const glm::dvec2 ab = c[1] - c[0], ac = c[2] - c[0], ap = p - c[0];
    const double area = ab.x * ac.y - ab.y * ac.x;
    const double u = (ap.x * ac.y - ap.y * ac.x) / area;
    const double v = (ab.x * ap.y - ab.y * ap.x) / area;
    return {1.0 - u - v, u, v};
}

/// Barycentrics of the place of the triangle that is nearest to `p`, and the squared distance.
struct Nearest {
    glm::dvec3 weights{1.0, 0.0, 0.0};
    double squared = 1e300;
};
Nearest nearestPlace(const std::array<glm::dvec2, 3>& c, const glm::dvec2& p) {
    Nearest nearest;
    for (int k = 0; k < 3; ++k) {
        const auto a = static_cast<std::size_t>(k), b = static_cast<std::size_t>((k + 1) % 3);
        const glm::dvec2 edge = c[b] - c[a];
        const double squared = glm::dot(edge, edge);
        const double t = squared > 0.0 ? std::clamp(glm::dot(p - c[a], edge) / squared, 0.0, 1.0) : 0.0;
        const glm::dvec2 away = p - (c[a] + edge * t);
        if (glm::dot(away, away) < nearest.squared) {
            nearest.squared = glm::dot(away, away);
            nearest.weights = glm::dvec3(0.0);
            nearest.weights[static_cast<int>(a)] = 1.0 - t;
            nearest.weights[static_cast<int>(b)] = t;
        }
    }
    return nearest;
}

/// Gathers samples of one tile and of a border around it.
class Gatherer {
public:
    Gatherer(const SurfaceMesh& mesh, const Map& map, int column, int row, int border)
        : m_mesh(mesh),
          m_map(map),
          m_border(border),
          m_side(tileSize + 2 * border),
          m_x(column * tileSize - border),
          m_y(row * tileSize - border),
          m_owner(static_cast<std::size_t>(m_side) * static_cast<std::size_t>(m_side), none) {}

    void addTriangle(std::uint32_t triangle, const TexelBox& box) {
        // The tile as the shifted triangle may meet it: in the map itself or in its repetitions, also to the left and
        // above, where the border of a chart at the map's edge comes back on the other side.
        for (int shiftY = -1; shiftY <= 2; ++shiftY) {
            for (int shiftX = -1; shiftX <= 2; ++shiftX) {
                const int offsetX = shiftX * m_map.width(), offsetY = shiftY * m_map.height();
                if (box.x1 < m_x + offsetX || box.x0 >= m_x + offsetX + m_side || box.y1 < m_y + offsetY ||
                    box.y0 >= m_y + offsetY + m_side) {
                    continue;
                }
                raster(triangle, box, offsetX, offsetY);
            }
        }
    }

    /// Lets the charts grow into uncovered texels, one ring a pass.
    void growBorders() {
        std::vector<std::int32_t> next;
        for (int pass = 0; pass < m_border; ++pass) {
            next = m_owner;
            bool grown = false;
            for (int y = 0; y < m_side; ++y) {
                for (int x = 0; x < m_side; ++x) {
                    if (m_owner[at(x, y)] != none || !nearestNeighbour(x, y, next[at(x, y)])) continue;
                    grown = true;
                }
            }
            m_owner.swap(next);
            if (!grown) break;
        }
    }

    PaintTile finish() {
        PaintTile tile;
        std::vector<std::uint32_t> counts(m_triangles.size() + 1, 0);
        for (const Found& found : m_found) ++counts[found.local + 1];
        for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
        for (std::size_t i = 0; i < m_triangles.size(); ++i) {
            if (counts[i] == counts[i + 1]) continue;
            const std::uint32_t triangle = m_triangles[i].triangle;
            tile.triangles.push_back(
                {triangleNormal(m_mesh, triangle), ballOf(m_mesh, triangle), counts[i], counts[i + 1]});
        }
        tile.samples.resize(m_found.size());
        for (const Found& found : m_found) tile.samples[counts[found.local]++] = found.sample;
        return tile;
    }

private:
    static constexpr std::int32_t none = -1;
    struct Local {
        std::uint32_t triangle;
        std::array<glm::dvec2, 3> corners;  // in texels of the region
    };
    struct Found {
        std::uint32_t local;
        PaintTile::Sample sample;
    };

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(m_side) + static_cast<std::size_t>(x);
    }

    void raster(std::uint32_t triangle, const TexelBox& box, int offsetX, int offsetY) {
        Local local{triangle, cornersInTexels(m_mesh, m_map, triangle)};
        const glm::dvec2 low = glm::min(local.corners[0], glm::min(local.corners[1], local.corners[2]));
        const glm::dvec2 wholeMaps(std::floor(low.x / m_map.width()) * m_map.width(),
                                   std::floor(low.y / m_map.height()) * m_map.height());
        for (glm::dvec2& corner : local.corners) corner -= wholeMaps + glm::dvec2(m_x + offsetX, m_y + offsetY);
        const auto index = static_cast<std::uint32_t>(m_triangles.size());
        m_triangles.push_back(local);
        const int x0 = std::max(0, box.x0 - m_x - offsetX), x1 = std::min(m_side - 1, box.x1 - m_x - offsetX);
        const int y0 = std::max(0, box.y0 - m_y - offsetY), y1 = std::min(m_side - 1, box.y1 - m_y - offsetY);
        bool covers = false;
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                const glm::dvec3 weights = barycentrics(local.corners, {x + 0.5, y + 0.5});
                if (!(std::min({weights.x, weights.y, weights.z}) >= -1e-9)) continue;
                covers = true;
                add(index, x, y, weights);
            }
        }
        if (covers) return;
        // Smaller than a texel: it takes the texel that it lies in, if no other triangle covers that texel's centre.
        const glm::dvec2 middle = (local.corners[0] + local.corners[1] + local.corners[2]) / 3.0;
        const int x = static_cast<int>(std::floor(middle.x)), y = static_cast<int>(std::floor(middle.y));
        if (x >= 0 && y >= 0 && x < m_side && y < m_side) m_small.push_back({index, x, y});
    }

    void add(std::uint32_t local, int x, int y, const glm::dvec3& weights) {
        std::int32_t& owner = m_owner[at(x, y)];
        if (owner == none) owner = static_cast<std::int32_t>(local);
        keep(local, x, y, weights);
    }

    void keep(std::uint32_t local, int x, int y, const glm::dvec3& weights) {
        const int tileX = x - m_border, tileY = y - m_border;
        if (tileX < 0 || tileY < 0 || tileX >= tileSize || tileY >= tileSize) return;
        // Tiles at the right and lower edge reach past the map.
        if (m_x + x >= m_map.width() || m_y + y >= m_map.height()) return;
        const glm::uvec3 corners = m_mesh.triangles[m_triangles[local].triangle];
        const glm::dvec3 p = glm::dvec3(m_mesh.positions[corners.x]) * weights.x +
                             glm::dvec3(m_mesh.positions[corners.y]) * weights.y +
                             glm::dvec3(m_mesh.positions[corners.z]) * weights.z;
        m_found.push_back({local, {glm::vec3(p), static_cast<std::uint16_t>(tileY * tileSize + tileX)}});
    }

    /// Gives an uncovered texel to the nearest of the triangles that own its neighbours.
    bool nearestNeighbour(int x, int y, std::int32_t& owner) {
        Nearest best;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const int nx = x + dx, ny = y + dy;
                if (nx < 0 || ny < 0 || nx >= m_side || ny >= m_side || m_owner[at(nx, ny)] == none) continue;
                const std::int32_t candidate = m_owner[at(nx, ny)];
                if (candidate == owner) continue;
                const Nearest place =
                    nearestPlace(m_triangles[static_cast<std::size_t>(candidate)].corners, {x + 0.5, y + 0.5});
                if (place.squared < best.squared) {
                    best = place;
                    owner = candidate;
                }
            }
        }
        if (owner == none) return false;
        keep(static_cast<std::uint32_t>(owner), x, y, best.weights);
        return true;
    }

public:
    /// Triangles that cover no texel's centre; after all others.
    void addSmall() {
        for (const Small& small : m_small) {
            if (m_owner[at(small.x, small.y)] != none) continue;
            add(small.local, small.x, small.y, glm::dvec3(1.0 / 3.0));
        }
    }

private:
    struct Small {
        std::uint32_t local;
        int x, y;
    };

    const SurfaceMesh& m_mesh;
    const Map& m_map;
    int m_border;
    int m_side;
    int m_x;  // of the region's first texel
    int m_y;
    std::vector<std::int32_t> m_owner;
    std::vector<Local> m_triangles;
    std::vector<Found> m_found;
    std::vector<Small> m_small;
};

}  // namespace

BoundingBall ballOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const glm::uvec3 corners = mesh.triangles[triangle];
    const glm::vec3 a = mesh.positions[corners.x], b = mesh.positions[corners.y], c = mesh.positions[corners.z];
    const glm::vec3 centre = (a + b + c) / 3.0f;
    return {centre, std::max({glm::length(a - centre), glm::length(b - centre), glm::length(c - centre)})};
}

TexelBox texelBox(const SurfaceMesh& mesh, const Map& map, std::uint32_t triangle) {
    const std::array<glm::dvec2, 3> corners = cornersInTexels(mesh, map, triangle);
    const glm::dvec2 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::dvec2 size(map.width(), map.height());
    const glm::dvec2 span = high - low;
    if (!(span.x <= 2.0 * size.x && span.y <= 2.0 * size.y) || !std::isfinite(low.x) || !std::isfinite(low.y))
        return {};
    const glm::dvec2 from = low - glm::floor(low / size) * size;
    return {static_cast<std::int32_t>(std::floor(from.x)), static_cast<std::int32_t>(std::floor(from.y)),
            static_cast<std::int32_t>(std::floor(from.x + span.x)),
            static_cast<std::int32_t>(std::floor(from.y + span.y))};
}

PaintTile buildTile(const SurfaceMesh& mesh, const Map& map, std::span<const TexelBox> boxes,
                    std::span<const std::uint32_t> triangles, int column, int row, int border) {
    Gatherer gatherer(mesh, map, column, row, border);
    for (const std::uint32_t t : triangles) gatherer.addTriangle(t, boxes[t]);
    gatherer.addSmall();
    gatherer.growBorders();
    return gatherer.finish();
}

}  // namespace whorl
