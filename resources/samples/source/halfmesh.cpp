// SPDX-License-Identifier: Apache-2.0
#include "halfmesh.h"

#include "subdivide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace whorl::samples {

using glm::ivec3;
using glm::vec3;

std::vector<MeshEdge> collectEdges(const std::vector<std::array<uint32_t, 3>>& triangles) {
    struct Half {
        uint64_t key;
        int32_t triangle;
    };
    std::vector<Half> halves;
    halves.reserve(triangles.size() * 3);
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (int c = 0; c < 3; ++c) {
            const uint64_t a = triangles[t][c];
            const uint64_t b = triangles[t][(c + 1) % 3];
            halves.push_back({std::min(a, b) << 32 | std::max(a, b), static_cast<int32_t>(t)});
        }
    }
    std::sort(halves.begin(), halves.end(),
              [](const Half& l, const Half& r) { return l.key != r.key ? l.key < r.key : l.triangle < r.triangle; });
    std::vector<MeshEdge> edges;
    edges.reserve(halves.size() / 2 + 1);
    for (size_t i = 0; i < halves.size();) {
        const bool paired = i + 1 < halves.size() && halves[i + 1].key == halves[i].key;
        edges.push_back({static_cast<uint32_t>(halves[i].key >> 32), static_cast<uint32_t>(halves[i].key),
                         halves[i].triangle, paired ? halves[i + 1].triangle : -1});
        i += paired ? 2 : 1;
    }
    return edges;
}

vec3 fieldNormal(const Field& surface, const vec3& p) {
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
    const float len = glm::length(sum);
    return len > 0.0f ? sum / len : vec3(0.0f, 1.0f, 0.0f);
}

vec3 projectToSurface(const Field& surface, vec3 p, int steps) {
    for (int i = 0; i < steps; ++i) {
        const float d = surface(p);
        if (std::abs(d) < 2e-6f) {
            break;
        }
        const vec3 n = fieldNormal(surface, p);
        constexpr float kProbe = 3e-4f;
        const float slope = (surface(p + n * kProbe) - surface(p - n * kProbe)) / (2.0f * kProbe);
        // A field that is steeper or flatter than a true distance needs the slope to converge; the cap keeps a
        // point from being thrown off where the field has a kink.
        p -= n * std::clamp(d / std::max(slope, 0.3f), -2e-3f, 2e-3f);
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

void splitRegion(HalfMesh& mesh, uint8_t from, uint8_t to, const Field& cut) {
    std::vector<float> side(mesh.positions.size());
    for (size_t i = 0; i < side.size(); ++i) {
        side[i] = cut(mesh.positions[i]);
    }
    EdgeCuts cuts;
    for (const MeshEdge& e : collectEdges(mesh.triangles)) {
        const bool touches = mesh.labels[e.left] == from || (e.right >= 0 && mesh.labels[e.right] == from);
        if (touches && (side[e.a] > 0.0f) != (side[e.b] > 0.0f)) {
            const float t = std::clamp(side[e.a] / (side[e.a] - side[e.b]), 0.05f, 0.95f);
            cuts.add(e.a, e.b, static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(mesh.positions[e.a] + (mesh.positions[e.b] - mesh.positions[e.a]) * t);
        }
    }
    side.resize(mesh.positions.size(), 0.0f);
    subdivide(mesh, cuts);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& tri = mesh.triangles[t];
        // Every piece has its old corners on one side only; the corners made by the cut count as zero.
        if (mesh.labels[t] == from && side[tri[0]] + side[tri[1]] + side[tri[2]] > 0.0f) {
            mesh.labels[t] = to;
        }
    }
}

void absorbSpecks(HalfMesh& mesh) {
    const std::vector<MeshEdge> edges = collectEdges(mesh.triangles);
    const size_t count = mesh.triangles.size();
    // Taking a speck away can join or free others, so a few rounds.
    for (int round = 0; round < 3; ++round) {
        std::vector<uint32_t> leader(count);
        std::iota(leader.begin(), leader.end(), 0u);
        auto find = [&](uint32_t i) {
            while (leader[i] != i) {
                i = leader[i] = leader[leader[i]];
            }
            return i;
        };
        for (const MeshEdge& e : edges) {
            if (e.right >= 0 && mesh.labels[size_t(e.left)] == mesh.labels[size_t(e.right)]) {
                const uint32_t a = find(uint32_t(e.left)), b = find(uint32_t(e.right));
                leader[std::max(a, b)] = std::min(a, b);
            }
        }
        std::vector<uint32_t> size(count, 0);
        for (uint32_t t = 0; t < count; ++t) {
            ++size[find(t)];
        }
        std::array<uint32_t, 256> largest{};
        for (uint32_t t = 0; t < count; ++t) {
            largest[mesh.labels[t]] = std::max(largest[mesh.labels[t]], size[find(t)]);
        }
        std::vector<int> adopt(count, -1);
        for (const MeshEdge& e : edges) {
            if (e.right < 0) {
                continue;
            }
            const uint32_t a = find(uint32_t(e.left)), b = find(uint32_t(e.right));
            const uint8_t la = mesh.labels[a], lb = mesh.labels[b];
            if (la != lb && size[a] * 8 < largest[la] && size[b] > size[a]) {
                adopt[a] = lb;
            } else if (la != lb && size[b] * 8 < largest[lb] && size[a] > size[b]) {
                adopt[b] = la;
            }
        }
        std::vector<uint8_t> labels = mesh.labels;
        for (uint32_t t = 0; t < count; ++t) {
            if (adopt[find(t)] >= 0) {
                labels[t] = uint8_t(adopt[find(t)]);
            }
        }
        mesh.labels = labels;
    }
}

void append(HalfMesh& mesh, const HalfMesh& other, uint8_t labelOffset) {
    const auto base = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (size_t t = 0; t < other.triangles.size(); ++t) {
        const auto& tri = other.triangles[t];
        mesh.triangles.push_back({tri[0] + base, tri[1] + base, tri[2] + base});
        mesh.labels.push_back(static_cast<uint8_t>(other.labels[t] + labelOffset));
    }
}

}  // namespace whorl::samples
