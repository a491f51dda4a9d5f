// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/unwrap.h"

#include <numeric>

namespace whorl::samples {

namespace {

class Groups {
public:
    explicit Groups(size_t n) : m_parent(n) { std::iota(m_parent.begin(), m_parent.end(), 0u); }
    uint32_t find(uint32_t i) {
        while (m_parent[i] != i) {
            i = m_parent[i] = m_parent[m_parent[i]];
        }
        return i;
    }
    void join(uint32_t a, uint32_t b) {
        a = find(a);
        b = find(b);
        // The smaller index leads, so that the numbering follows the mesh.
        m_parent[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> m_parent;
};

uint32_t cornerOf(const HalfMesh& mesh, int32_t triangle, uint32_t vertex) {
    const auto& t = mesh.triangles[size_t(triangle)];
    return uint32_t(triangle) * 3 + (t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
}

}  // namespace

std::vector<Chart> cutCharts(const HalfMesh& mesh, const SeamRules& rules) {
    Groups faces(mesh.triangles.size());
    Groups corners(mesh.triangles.size() * 3);
    std::vector<char> axisCorner(mesh.triangles.size() * 3, 0);
    for (const MeshEdge& e : collectEdges(mesh.triangles)) {
        const glm::vec3 middle = 0.5f * (mesh.positions[e.a] + mesh.positions[e.b]);
        const uint8_t left = mesh.labels[size_t(e.left)];
        if (e.right < 0) {
            if (rules.joinsMirror(left, middle)) {
                axisCorner[cornerOf(mesh, e.left, e.a)] = axisCorner[cornerOf(mesh, e.left, e.b)] = 1;
            }
            continue;
        }
        const uint8_t right = mesh.labels[size_t(e.right)];
        if (left == right || !rules.isSeam(left, right, middle)) {
            faces.join(uint32_t(e.left), uint32_t(e.right));
            corners.join(cornerOf(mesh, e.left, e.a), cornerOf(mesh, e.right, e.a));
            corners.join(cornerOf(mesh, e.left, e.b), cornerOf(mesh, e.right, e.b));
        }
    }
    constexpr uint32_t kNone = ~0u;
    std::vector<Chart> charts;
    std::vector<uint32_t> chartOf(mesh.triangles.size(), kNone);
    std::vector<uint32_t> vertexOf(mesh.triangles.size() * 3, kNone);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        uint32_t& chartIndex = chartOf[faces.find(t)];
        if (chartIndex == kNone) {
            chartIndex = uint32_t(charts.size());
            charts.emplace_back();
        }
        Chart& chart = charts[chartIndex];
        std::array<uint32_t, 3> local{};
        for (uint32_t c = 0; c < 3; ++c) {
            uint32_t& vertex = vertexOf[corners.find(t * 3 + c)];
            if (vertex == kNone) {
                vertex = uint32_t(chart.meshVertex.size());
                chart.meshVertex.push_back(mesh.triangles[t][c]);
                chart.onAxis.push_back(0);
            }
            local[c] = vertex;
            if (axisCorner[t * 3 + c]) {
                chart.onAxis[vertex] = 1;
                chart.joined = true;
            }
        }
        chart.triangles.push_back(local);
        chart.meshTriangle.push_back(t);
    }
    return charts;
}

}  // namespace whorl::samples
