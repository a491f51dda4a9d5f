// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/halfmesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace whorl::samples {

using glm::ivec3;
using glm::vec3;

std::vector<MeshEdge> collectEdges(const std::vector<std::array<uint32_t, 3>>& triangles) {
    struct Half {
        uint32_t far;
        int32_t triangle;
    };
    // Half edges are grouped by their smaller vertex first; the groups are so small that sorting them costs little.
    uint32_t vertices = 0;
    for (const auto& t : triangles) {
        vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    }
    std::vector<uint32_t> first(size_t(vertices) + 1, 0);
    auto eachHalf = [&](auto&& visit) {
        for (size_t t = 0; t < triangles.size(); ++t) {
            for (int c = 0; c < 3; ++c) {
                const uint32_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
                visit(std::min(a, b), Half{std::max(a, b), static_cast<int32_t>(t)});
            }
        }
    };
    eachHalf([&](uint32_t near, const Half&) { ++first[near + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Half> halves(triangles.size() * 3);
    std::vector<uint32_t> fill(first.begin(), first.end() - 1);
    eachHalf([&](uint32_t near, const Half& half) { halves[fill[near]++] = half; });
    std::vector<MeshEdge> edges;
    edges.reserve(halves.size() / 2 + 1);
    for (uint32_t v = 0; v < vertices; ++v) {
        const auto begin = halves.begin() + first[v], end = halves.begin() + first[v + 1];
        std::sort(begin, end, [](const Half& l, const Half& r) {
            return l.far != r.far ? l.far < r.far : l.triangle < r.triangle;
        });
        for (auto it = begin; it != end;) {
            const bool paired = it + 1 != end && it[1].far == it->far;
            edges.push_back({v, it->far, it->triangle, paired ? it[1].triangle : -1});
            it += paired ? 2 : 1;
        }
    }
    return edges;
}

vec3 fieldGradient(const Field& surface, const vec3& p) {
    constexpr float kStep = 2e-4f;
    // Four taps at the corners of a tetrahedron cost two evaluations less than central differences.
    constexpr std::array<std::array<float, 3>, 4> kTaps = {{{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}}};
    vec3 sum(0.0f);
    for (const auto& tap : kTaps) {
        const vec3 dir(tap[0], tap[1], tap[2]);
        sum += dir * surface(p + dir * kStep);
    }
    if (p.x == 0.0f) {
        sum.x = 0.0f;
    }
    return sum / (4.0f * kStep);
}

vec3 fieldNormal(const Field& surface, const vec3& p) {
    const vec3 gradient = fieldGradient(surface, p);
    const float slope = glm::length(gradient);
    return slope > 0.0f ? gradient / slope : vec3(0.0f, 1.0f, 0.0f);
}

vec3 projectToSurface(const Field& surface, vec3 p, int steps) {
    for (int i = 0; i < steps; ++i) {
        const float d = surface(p);
        if (std::abs(d) < 2e-6f) {
            break;
        }
        const vec3 gradient = fieldGradient(surface, p);
        const float slope = glm::length(gradient);
        if (slope == 0.0f) {
            break;
        }
        // A field that is steeper or flatter than a true distance needs the slope to converge; the cap keeps a
        // point from being thrown off where the field has a kink.
        p -= gradient / slope * std::clamp(d / std::max(slope, 0.3f), -2e-3f, 2e-3f);
    }
    return p;
}

namespace {

class TetMarcher {
public:
    TetMarcher(const Field& surface, const vec3& lo, const vec3& hi, float cell)
        : m_surface(surface), m_lo(lo), m_cell(cell), m_cells(ivec3(glm::ceil((hi - lo) / (cell * kBlock))) * kBlock) {
        const size_t points = size_t(m_cells.x + 1) * size_t(m_cells.y + 1) * size_t(m_cells.z + 1);
        m_values.assign(points, std::numeric_limits<float>::quiet_NaN());
        m_vertexOf.assign(points * 8, kNone);
    }

    HalfMesh run() {
        for (int z = 0; z < m_cells.z; z += kBlock) {
            for (int y = 0; y < m_cells.y; y += kBlock) {
                for (int x = 0; x < m_cells.x; x += kBlock) {
                    block(ivec3(x, y, z));
                }
            }
        }
        m_mesh.labels.assign(m_mesh.triangles.size(), 0);
        return std::move(m_mesh);
    }

private:
    static constexpr int kBlock = 4;
    static constexpr uint32_t kNone = ~0u;

    vec3 point(const ivec3& g) const { return m_lo + vec3(g) * m_cell; }
    size_t index(const ivec3& g) const {
        return (size_t(g.z) * size_t(m_cells.y + 1) + size_t(g.y)) * size_t(m_cells.x + 1) + size_t(g.x);
    }

    float value(const ivec3& g) {
        float& v = m_values[index(g)];
        if (std::isnan(v)) {
            v = m_surface(point(g));
            if (v == 0.0f) {
                v = 1e-9f;  // keeps every crossing strictly inside an edge
            }
        }
        return v;
    }

    void block(const ivec3& corner) {
        // Blocks far from the surface are skipped. The factor allows for fields that overstate distance.
        const float halfDiagonal = 0.5f * std::sqrt(3.0f) * m_cell * kBlock;
        const float centre = m_surface(point(corner) + vec3(0.5f * m_cell * kBlock));
        if (std::abs(centre) > halfDiagonal * 1.8f) {
            return;
        }
        for (int z = 0; z < kBlock; ++z) {
            for (int y = 0; y < kBlock; ++y) {
                for (int x = 0; x < kBlock; ++x) {
                    cube(corner + ivec3(x, y, z));
                }
            }
        }
    }

    void cube(const ivec3& g) {
        // The six tetrahedra around the main diagonal; the split agrees between neighbouring cubes.
        constexpr int kPaths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
        for (const auto& path : kPaths) {
            tetrahedron({g, g + offset(path[0]), g + offset(path[1]), g + offset(7)});
        }
    }

    static ivec3 offset(int bits) { return {bits & 1, bits >> 1 & 1, bits >> 2 & 1}; }

    void tetrahedron(const std::array<ivec3, 4>& corners) {
        std::array<int, 4> inside{}, outside{};
        int ni = 0, no = 0;
        for (int i = 0; i < 4; ++i) {
            (value(corners[i]) < 0.0f ? inside[ni++] : outside[no++]) = i;
        }
        if (ni == 0 || no == 0) {
            return;
        }
        vec3 outward(0.0f);
        for (int i = 0; i < ni; ++i) {
            outward -= vec3(corners[inside[i]]) / float(ni);
        }
        for (int i = 0; i < no; ++i) {
            outward += vec3(corners[outside[i]]) / float(no);
        }
        auto crossing = [&](int a, int b) { return vertexOn(corners[a], corners[b]); };
        if (ni == 1) {
            emit(crossing(inside[0], outside[0]), crossing(inside[0], outside[1]), crossing(inside[0], outside[2]),
                 outward);
        } else if (no == 1) {
            emit(crossing(inside[0], outside[0]), crossing(inside[1], outside[0]), crossing(inside[2], outside[0]),
                 outward);
        } else {
            const uint32_t a = crossing(inside[0], outside[0]);
            const uint32_t b = crossing(inside[0], outside[1]);
            const uint32_t c = crossing(inside[1], outside[1]);
            const uint32_t d = crossing(inside[1], outside[0]);
            emit(a, b, c, outward);
            emit(a, c, d, outward);
        }
    }

    uint32_t vertexOn(ivec3 a, ivec3 b) {
        if (index(b) < index(a)) {
            std::swap(a, b);
        }
        const ivec3 step = b - a;
        uint32_t& vertex = m_vertexOf[index(a) * 8 + size_t(step.x + 2 * step.y + 4 * step.z)];
        if (vertex == kNone) {
            vertex = static_cast<uint32_t>(m_mesh.positions.size());
            const float va = value(a), vb = value(b);
            const float t = std::clamp(va / (va - vb), 0.03f, 0.97f);
            m_mesh.positions.push_back(point(a) + (point(b) - point(a)) * t);
        }
        return vertex;
    }

    void emit(uint32_t a, uint32_t b, uint32_t c, const vec3& outward) {
        const auto& p = m_mesh.positions;
        const bool flipped = glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), outward) < 0.0f;
        m_mesh.triangles.push_back(flipped ? std::array<uint32_t, 3>{a, c, b} : std::array<uint32_t, 3>{a, b, c});
    }

    const Field& m_surface;
    vec3 m_lo;
    float m_cell;
    ivec3 m_cells;
    std::vector<float> m_values;
    std::vector<uint32_t> m_vertexOf;
    HalfMesh m_mesh;
};

}  // namespace

HalfMesh polygonise(const Field& surface, const vec3& lo, const vec3& hi, float cell) {
    return TetMarcher(surface, lo, hi, cell).run();
}

}  // namespace whorl::samples
