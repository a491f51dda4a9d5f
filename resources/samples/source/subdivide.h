// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/halfmesh.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace whorl::samples {

/// Edges to be cut and the vertex each is cut at. Edges must be added in the order collectEdges gives them.
class EdgeCuts {
public:
    void add(uint32_t a, uint32_t b, uint32_t vertex) { m_cuts.push_back({key(a, b), vertex}); }
    bool empty() const { return m_cuts.empty(); }

    static constexpr uint32_t kNone = ~0u;
    uint32_t find(uint32_t a, uint32_t b) const;

private:
    static uint64_t key(uint32_t a, uint32_t b) { return a < b ? uint64_t(a) << 32 | b : uint64_t(b) << 32 | a; }
    std::vector<std::pair<uint64_t, uint32_t>> m_cuts;
};

/// Replaces every triangle that has cut edges by two, three or four triangles with the same label.
void subdivide(HalfMesh& mesh, const EdgeCuts& cuts);

}  // namespace whorl::samples
