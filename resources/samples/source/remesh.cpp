// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/mesh_topology.h"
#include "resources/samples/source/subdivide.h"

#include <algorithm>
#include <cmath>

namespace whorl::samples {

using glm::vec3;

namespace {

class Remesher : private MeshTopology {
public:
    Remesher(HalfMesh& mesh, const Field& surface, const Field& edgeLength)
        : MeshTopology(mesh), m_surface(surface), m_length(edgeLength) {}

    void run(int iterations) {
        for (int i = 0; i < iterations; ++i) {
            splitLong();
            for (int pass = 0; pass < 12 && collapseShort(); ++pass) {
            }
            for (int pass = 0; pass < 4 && flip(); ++pass) {
            }
            relax(i + 1 == iterations ? 4 : 1);
        }
        splitBridges();
        for (int pass = 0; pass < 3 && flip(); ++pass) {
        }
    }

private:
    void cut(const std::vector<const MeshEdge*>& chosen) {
        EdgeCuts cuts;
        for (const MeshEdge* e : chosen) {
            cuts.add(e->a, e->b, static_cast<uint32_t>(m_mesh.positions.size()));
            m_mesh.positions.push_back(middle(*e));
        }
        subdivide(m_mesh, cuts);
    }

    void splitLong() {
        m_edges = collectEdges(m_mesh.triangles);
        std::vector<const MeshEdge*> chosen;
        for (const MeshEdge& e : m_edges) {
            if (length(e) > 1.33f * m_length(middle(e))) {
                chosen.push_back(&e);
            }
        }
        cut(chosen);
    }

    /// An edge through the inside of a region that joins two points of its border would fold flat when unwrapped.
    void splitBridges() {
        analyse();
        std::vector<const MeshEdge*> chosen;
        for (const MeshEdge& e : m_edges) {
            if (!isFeature(e) && m_lines[e.a] > 0 && m_lines[e.b] > 0) {
                chosen.push_back(&e);
            }
        }
        const size_t before = m_mesh.positions.size();
        cut(chosen);
        for (size_t i = before; i < m_mesh.positions.size(); ++i) {
            m_mesh.positions[i] = projectToSurface(m_surface, m_mesh.positions[i], 4);
        }
    }

    bool collapseShort() {
        analyse();
        std::vector<char> touched(m_mesh.positions.size(), 0);
        std::vector<uint32_t> target(m_mesh.positions.size());
        for (size_t i = 0; i < target.size(); ++i) {
            target[i] = static_cast<uint32_t>(i);
        }
        bool any = false;
        std::vector<uint32_t> ringA, ringB, common;
        for (const MeshEdge& e : m_edges) {
            if (touched[e.a] || touched[e.b] || length(e) > 0.75f * m_length(middle(e))) {
                continue;
            }
            uint32_t gone = e.a, kept = e.b;
            if (m_lines[gone] > m_lines[kept]) {
                std::swap(gone, kept);
            }
            vec3 place = m_mesh.positions[kept];
            if (m_lines[gone] > 0) {
                if (m_lines[gone] != 2 || !isFeature(e)) {
                    continue;
                }
                if (m_lines[kept] == 2) {
                    place = middle(e);
                }
            } else if (m_lines[kept] == 0) {
                place = middle(e);
            }
            neighbours(gone, ringA);
            neighbours(kept, ringB);
            common.clear();
            std::set_intersection(ringA.begin(), ringA.end(), ringB.begin(), ringB.end(), std::back_inserter(common));
            if (common.size() != (e.right < 0 ? 1u : 2u) || ringA.size() + ringB.size() < 8 ||
                (e.right >= 0 && m_onBorder[gone] && m_onBorder[kept])) {
                continue;
            }
            const bool clean = std::none_of(ringA.begin(), ringA.end(), [&](uint32_t v) { return touched[v]; }) &&
                               std::none_of(ringB.begin(), ringB.end(), [&](uint32_t v) { return touched[v]; });
            if (!clean || !staysUnfolded(gone, kept, place) || !staysUnfolded(kept, gone, place)) {
                continue;
            }
            for (uint32_t v : ringA) {
                touched[v] = 1;
            }
            for (uint32_t v : ringB) {
                touched[v] = 1;
            }
            m_mesh.positions[kept] = place;
            target[gone] = kept;
            any = true;
        }
        if (any) {
            compact(target);
        }
        return any;
    }

    /// Whether the triangles around `moved` (but not `other`) keep their side and size when it goes to `place`.
    bool staysUnfolded(uint32_t moved, uint32_t other, const vec3& place) const {
        bool good = true;
        eachTriangle(moved, [&](uint32_t t) {
            const auto& tri = m_mesh.triangles[t];
            if (tri[0] == other || tri[1] == other || tri[2] == other) {
                return;
            }
            std::array<vec3, 3> now, then;
            for (int c = 0; c < 3; ++c) {
                now[c] = m_mesh.positions[tri[c]];
                then[c] = tri[c] == moved ? place : now[c];
            }
            const vec3 n0 = glm::cross(now[1] - now[0], now[2] - now[0]);
            const vec3 n1 = glm::cross(then[1] - then[0], then[2] - then[0]);
            const float limit = 1.4f * m_length(place);
            if (glm::dot(n0, n1) < 0.35f * glm::length(n0) * glm::length(n1) || glm::length(n1) < 1e-9f) {
                good = false;
            }
            for (int c = 0; c < 3; ++c) {
                good = good && glm::distance(then[c], then[(c + 1) % 3]) < limit;
            }
        });
        return good;
    }

    void compact(const std::vector<uint32_t>& target) {
        std::vector<uint32_t> renamed(m_mesh.positions.size(), ~0u);
        uint32_t used = 0;
        for (size_t i = 0; i < target.size(); ++i) {
            if (target[i] == i) {
                renamed[i] = used;
                m_mesh.positions[used++] = m_mesh.positions[i];
            }
        }
        m_mesh.positions.resize(used);
        size_t out = 0;
        for (size_t t = 0; t < m_mesh.triangles.size(); ++t) {
            const auto& tri = m_mesh.triangles[t];
            const std::array<uint32_t, 3> now{renamed[target[tri[0]]], renamed[target[tri[1]]],
                                              renamed[target[tri[2]]]};
            if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0]) {
                m_mesh.triangles[out] = now;
                m_mesh.labels[out++] = m_mesh.labels[t];
            }
        }
        m_mesh.triangles.resize(out);
        m_mesh.labels.resize(out);
    }

    static float angleAt(const vec3& apex, const vec3& a, const vec3& b) {
        const vec3 u = a - apex, v = b - apex;
        return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
    }

    /// Turns edges towards the Delaunay condition.
    bool flip() {
        analyse();
        std::vector<char> touched(m_mesh.positions.size(), 0);
        bool any = false;
        std::vector<uint32_t> ring;
        for (const MeshEdge& e : m_edges) {
            if (isFeature(e)) {
                continue;
            }
            auto& left = m_mesh.triangles[e.left];
            auto& right = m_mesh.triangles[e.right];
            int corner = 0;
            while (left[corner] == e.a || left[corner] == e.b) {
                ++corner;
            }
            const uint32_t a = left[(corner + 1) % 3], b = left[(corner + 2) % 3], c = left[corner];
            const uint32_t d = right[0] + right[1] + right[2] - a - b;
            if (touched[a] || touched[b] || touched[c] || touched[d] || (m_lines[c] > 0 && m_lines[d] > 0)) {
                continue;
            }
            const auto& p = m_mesh.positions;
            if (angleAt(p[c], p[a], p[b]) + angleAt(p[d], p[a], p[b]) < 3.1416f + 0.02f) {
                continue;
            }
            neighbours(c, ring);
            if (std::binary_search(ring.begin(), ring.end(), d)) {
                continue;
            }
            const vec3 n0 = glm::normalize(glm::cross(p[a] - p[c], p[b] - p[c]));
            const vec3 n1 = glm::normalize(glm::cross(p[b] - p[d], p[a] - p[d]));
            const vec3 m0 = glm::normalize(glm::cross(p[a] - p[c], p[d] - p[c]));
            const vec3 m1 = glm::normalize(glm::cross(p[b] - p[d], p[c] - p[d]));
            const vec3 n = n0 + n1;
            if (!(glm::dot(m0, n) > 0.5f && glm::dot(m1, n) > 0.5f)) {
                continue;
            }
            left = {a, d, c};
            right = {b, c, d};
            touched[a] = touched[b] = touched[c] = touched[d] = 1;
            any = true;
        }
        return any;
    }

    void relax(int projections) {
        analyse();
        const std::vector<vec3> old = m_mesh.positions;
        std::vector<std::array<uint32_t, 2>> along(old.size());
        std::vector<uint8_t> found(old.size(), 0);
        for (const MeshEdge& e : m_edges) {
            if (isFeature(e)) {
                if (m_lines[e.a] == 2) {
                    along[e.a][found[e.a]++] = e.b;
                }
                if (m_lines[e.b] == 2) {
                    along[e.b][found[e.b]++] = e.a;
                }
            }
        }
        std::vector<uint32_t> ring;
        for (uint32_t v = 0; v < old.size(); ++v) {
            vec3 p = old[v];
            if (m_lines[v] == 0) {
                neighbours(v, ring);
                vec3 centre(0.0f);
                for (uint32_t w : ring) {
                    centre += old[w];
                }
                const vec3 n = fieldNormal(m_surface, p);
                const vec3 move = centre / float(ring.size()) - p;
                p += 0.7f * (move - n * glm::dot(n, move));
                p.x = std::max(p.x, 1e-5f);
            } else if (m_lines[v] == 2) {
                const vec3 a = old[along[v][0]], b = old[along[v][1]];
                const vec3 line = glm::normalize(b - a);
                const vec3 move = 0.5f * (a + b) - p;
                const vec3 slide = line * glm::dot(move, line);
                // Mostly an even spacing; a little straightening takes the teeth out of a freshly cut line.
                p += 0.5f * slide + 0.25f * (move - slide);
            }
            p = projectToSurface(m_surface, p, projections);
            if (m_onBorder[v]) {
                p.x = 0.0f;
            }
            m_mesh.positions[v] = p;
        }
    }

    const Field& m_surface;
    const Field& m_length;
};

}  // namespace

void remesh(HalfMesh& mesh, const Field& surface, const Field& edgeLength, int iterations) {
    Remesher(mesh, surface, edgeLength).run(iterations);
}

}  // namespace whorl::samples
