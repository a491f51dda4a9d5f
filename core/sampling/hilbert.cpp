// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/hilbert.h"

#include "core/base/parallel.h"
#include "core/surface/surface_point.h"

#include <algorithm>
#include <array>
#include <utility>

namespace whorl {
namespace {

constexpr int orderBits = 20;

// How the curve lies in an octant: axis k of the curve is axis from[k] of space, turned round where inverted[k]; `flip`
// turns all digits of the Gray code round.
struct Turn {
    std::array<int, 3> from{0, 1, 2};
    std::array<int, 3> inverted{0, 0, 0};
    int flip = 0;
    constexpr bool operator==(const Turn&) const = default;
};

struct Step {
    std::uint8_t next = 0;   // turn of the octant
    std::uint8_t digit = 0;  // its number on the curve
};

// By turn and octant (bits of x, y, z): Skilling's exchanges and inversions of all lower bits, one level at a time.
using Steps = std::array<std::array<Step, 8>, 48>;

constexpr Steps makeSteps() {
    Steps steps{};
    std::array<Turn, 49> turns{};
    std::size_t count = 1;
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t octant = 0; octant < 8; ++octant) {
            const Turn turn = turns[t];
            const std::array<int, 3> raw{static_cast<int>(octant >> 2 & 1), static_cast<int>(octant >> 1 & 1),
                                         static_cast<int>(octant & 1)};
            std::array<int, 3> bits{};
            for (std::size_t k = 0; k < 3; ++k)
                bits[k] = raw[static_cast<std::size_t>(turn.from[k])] ^ turn.inverted[k];
            Turn next = turn;
            for (std::size_t k = 0; k < 3; ++k) {
                if (bits[k]) {
                    next.inverted[0] ^= 1;
                } else {
                    std::swap(next.from[0], next.from[k]);
                    std::swap(next.inverted[0], next.inverted[k]);
                }
            }
            const int g0 = bits[0], g1 = bits[1] ^ g0, g2 = bits[2] ^ g1;
            next.flip ^= g2;
            std::size_t found = 0;
            while (found < count && !(turns[found] == next)) ++found;
            if (found == count) turns[count++] = next;
            const int digit = (g0 ^ turn.flip) << 2 | (g1 ^ turn.flip) << 1 | (g2 ^ turn.flip);
            steps[t][octant] = {static_cast<std::uint8_t>(found), static_cast<std::uint8_t>(digit)};
        }
    }
    return steps;
}

constexpr Steps steps = makeSteps();

struct Key {
    std::uint64_t index;
    std::uint32_t triangle;
};

// By index; equal ones stay in order.
void sortKeys(std::vector<Key>& keys) {
    constexpr int bits = 10;
    constexpr std::size_t buckets = std::size_t{1} << bits;
    std::vector<Key> other(keys.size());
    for (int shift = 0; shift < 3 * orderBits; shift += bits) {
        std::array<std::size_t, buckets> place{};
        for (const Key& key : keys) ++place[key.index >> shift & (buckets - 1)];
        if (place[keys.front().index >> shift & (buckets - 1)] == keys.size()) continue;
        std::size_t before = 0;
        for (std::size_t& p : place) before += std::exchange(p, before);
        for (const Key& key : keys) other[place[key.index >> shift & (buckets - 1)]++] = key;
        keys.swap(other);
    }
}

}  // namespace

std::uint64_t hilbertIndex(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::uint64_t index = 0;
    std::size_t turn = 0;
    for (int bit = orderBits - 1; bit >= 0; --bit) {
        const std::size_t octant = (x >> bit & 1u) << 2 | (y >> bit & 1u) << 1 | (z >> bit & 1u);
        const Step step = steps[turn][octant];
        index = index << 3 | step.digit;
        turn = step.next;
    }
    return index;
}

std::vector<std::uint32_t> hilbertOrder(const SurfaceMesh& mesh) {
    const Bounds bounds = boundsOf(mesh);
    std::vector<Key> keys(mesh.triangles.size());
    if (keys.empty()) return {};
    const glm::vec3 size = bounds.empty() ? glm::vec3(0.0f) : bounds.size();
    const double longest = static_cast<double>(std::max({size.x, size.y, size.z}));
    const double cells = (1 << orderBits) - 1;
    const auto cell = [&](float coordinate, float low) {
        const double place =
            longest > 0.0 ? (static_cast<double>(coordinate) - static_cast<double>(low)) / longest : 0.0;
        // Written so that not-a-number is cell 0.
        return place > 0.0 ? static_cast<std::uint32_t>(std::min(place, 1.0) * cells) : 0u;
    };
    parallelFor(keys.size(), 8192, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto t = static_cast<std::uint32_t>(i);
            const glm::vec3 centre = positionAt(mesh, {t, 1.0f / 3.0f, 1.0f / 3.0f});
            keys[i] = {
                hilbertIndex(cell(centre.x, bounds.min.x), cell(centre.y, bounds.min.y), cell(centre.z, bounds.min.z)),
                t};
        }
    });
    sortKeys(keys);
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].triangle;
    return order;
}

}  // namespace whorl
