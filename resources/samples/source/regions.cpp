// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/halfmesh.h"
#include "resources/samples/source/subdivide.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace whorl::samples {

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
