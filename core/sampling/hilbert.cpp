// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/hilbert.h"

#include "core/surface/surface_point.h"

#include <algorithm>
#include <array>
#include <utility>

namespace whorl {
namespace {
constexpr int orderBits = 20;
}

std::uint64_t hilbertIndex(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::array<std::uint32_t, 3> axes{x, y, z};
    // From the finest rotation to the coarsest: exchange or invert the lower bits, as the curve turns in each octant.
    for (std::uint32_t bit = 1u << (orderBits - 1); bit > 1; bit >>= 1) {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t& axis : axes) {
            if (axis & bit) {
                axes[0] ^= below;
            } else {
                const std::uint32_t change = (axes[0] ^ axis) & below;
                axes[0] ^= change;
                axis ^= change;
            }
        }
    }
    // Gray encode.
    axes[1] ^= axes[0];
    axes[2] ^= axes[1];
    std::uint32_t flip = 0;
    for (std::uint32_t bit = 1u << (orderBits - 1); bit > 1; bit >>= 1) {
        if (axes[2] & bit) flip ^= bit - 1;
    }
    std::uint64_t index = 0;
    for (int bit = orderBits - 1; bit >= 0; --bit) {
        for (const std::uint32_t axis : axes) index = index << 1 | (((axis ^ flip) >> bit) & 1u);
    }
    return index;
}

std::vector<std::uint32_t> hilbertOrder(const SurfaceMesh& mesh) {
    const Bounds bounds = boundsOf(mesh);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(mesh.triangles.size());
    const glm::vec3 size = bounds.empty() ? glm::vec3(0.0f) : bounds.size();
    const double longest = static_cast<double>(std::max({size.x, size.y, size.z}));
    const double cells = (1 << orderBits) - 1;
    const auto cell = [&](float coordinate, float low) {
        const double place =
            longest > 0.0 ? (static_cast<double>(coordinate) - static_cast<double>(low)) / longest : 0.0;
        // Written so that not-a-number is cell 0.
        return place > 0.0 ? static_cast<std::uint32_t>(std::min(place, 1.0) * cells) : 0u;
    };
    for (std::uint32_t t = 0; t < keys.size(); ++t) {
        const glm::vec3 centre = positionAt(mesh, {t, 1.0f / 3.0f, 1.0f / 3.0f});
        keys[t] = {
            hilbertIndex(cell(centre.x, bounds.min.x), cell(centre.y, bounds.min.y), cell(centre.z, bounds.min.z)), t};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
    return order;
}

}  // namespace whorl
