// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/halfmesh.h"

#include <algorithm>
#include <vector>

namespace whorl::samples {

/// Neighbourhoods of a half mesh, valid from analyse() until the next change of its triangles.
class MeshTopology {
protected:
    explicit MeshTopology(HalfMesh& mesh) : m_mesh(mesh) {}

    bool isFeature(const MeshEdge& e) const { return e.right < 0 || m_mesh.labels[e.left] != m_mesh.labels[e.right]; }
    glm::vec3 middle(const MeshEdge& e) const { return 0.5f * (m_mesh.positions[e.a] + m_mesh.positions[e.b]); }
    float length(const MeshEdge& e) const { return glm::distance(m_mesh.positions[e.a], m_mesh.positions[e.b]); }

    /// Edges, vertex-to-triangle lists, and how many region borders meet at each vertex.
    void analyse() {
        const size_t n = m_mesh.positions.size();
        m_edges = collectEdges(m_mesh.triangles);
        m_lines.assign(n, 0);
        m_onBorder.assign(n, 0);
        for (const MeshEdge& e : m_edges) {
            if (isFeature(e)) {
                ++m_lines[e.a];
                ++m_lines[e.b];
            }
            if (e.right < 0) {
                m_onBorder[e.a] = m_onBorder[e.b] = 1;
            }
        }
        m_first.assign(n + 1, 0);
        for (const auto& t : m_mesh.triangles) {
            for (uint32_t v : t) {
                ++m_first[v + 1];
            }
        }
        for (size_t i = 0; i < n; ++i) {
            m_first[i + 1] += m_first[i];
        }
        m_around.resize(m_mesh.triangles.size() * 3);
        std::vector<uint32_t> fill(m_first.begin(), m_first.end() - 1);
        for (size_t t = 0; t < m_mesh.triangles.size(); ++t) {
            for (uint32_t v : m_mesh.triangles[t]) {
                m_around[fill[v]++] = static_cast<uint32_t>(t);
            }
        }
    }

    template <typename F>
    void eachTriangle(uint32_t v, F&& f) const {
        for (uint32_t i = m_first[v]; i < m_first[v + 1]; ++i) {
            f(m_around[i]);
        }
    }

    void neighbours(uint32_t v, std::vector<uint32_t>& out) const {
        out.clear();
        eachTriangle(v, [&](uint32_t t) {
            for (uint32_t w : m_mesh.triangles[t]) {
                if (w != v) {
                    out.push_back(w);
                }
            }
        });
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

    HalfMesh& m_mesh;
    std::vector<MeshEdge> m_edges;
    std::vector<uint8_t> m_lines;     // region borders meeting at a vertex
    std::vector<uint8_t> m_onBorder;  // whether a vertex lies on the mirror plane's border
    std::vector<uint32_t> m_first, m_around;
};

}  // namespace whorl::samples
