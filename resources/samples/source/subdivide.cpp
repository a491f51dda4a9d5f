// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/subdivide.h"

#include <algorithm>

namespace whorl::samples {

uint32_t EdgeCuts::find(uint32_t a, uint32_t b) const {
    const uint64_t wanted = key(a, b);
    const auto it = std::lower_bound(m_cuts.begin(), m_cuts.end(), wanted,
                                     [](const auto& cut, uint64_t value) { return cut.first < value; });
    return it != m_cuts.end() && it->first == wanted ? it->second : kNone;
}

void subdivide(HalfMesh& mesh, const EdgeCuts& cuts) {
    if (cuts.empty()) {
        return;
    }
    const size_t count = mesh.triangles.size();
    auto add = [&](uint32_t a, uint32_t b, uint32_t c, uint8_t label) {
        mesh.triangles.push_back({a, b, c});
        mesh.labels.push_back(label);
    };
    for (size_t t = 0; t < count; ++t) {
        auto v = mesh.triangles[t];
        const uint8_t label = mesh.labels[t];
        std::array<uint32_t, 3> mid{};
        int n = 0;
        for (int c = 0; c < 3; ++c) {
            mid[c] = cuts.find(v[c], v[(c + 1) % 3]);
            n += mid[c] != EdgeCuts::kNone;
        }
        if (n == 0) {
            continue;
        }
        if (n == 3) {
            mesh.triangles[t] = {mid[0], mid[1], mid[2]};
            add(v[0], mid[0], mid[2], label);
            add(v[1], mid[1], mid[0], label);
            add(v[2], mid[2], mid[1], label);
            continue;
        }
        // Turn the triangle until edge 0 is the one that decides: the only cut edge, or the first of two.
        while (n == 1 ? mid[0] == EdgeCuts::kNone : mid[2] != EdgeCuts::kNone) {
            v = {v[1], v[2], v[0]};
            mid = {mid[1], mid[2], mid[0]};
        }
        if (n == 1) {
            mesh.triangles[t] = {v[0], mid[0], v[2]};
            add(mid[0], v[1], v[2], label);
        } else {
            mesh.triangles[t] = {mid[0], v[1], mid[1]};
            const auto& p = mesh.positions;
            if (glm::distance(p[v[0]], p[mid[1]]) < glm::distance(p[mid[0]], p[v[2]])) {
                add(v[0], mid[0], mid[1], label);
                add(v[0], mid[1], v[2], label);
            } else {
                add(v[0], mid[0], v[2], label);
                add(mid[0], mid[1], v[2], label);
            }
        }
    }
}

}  // namespace whorl::samples
