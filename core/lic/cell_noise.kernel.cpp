// SPDX-License-Identifier: Apache-2.0
#include "core/lic/cell_noise.kernel.h"

#include "core/base/random_lanes.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

constexpr std::size_t atOnce = 64;

// As in solidNoise: cells count from a million below zero. Loops of one width each become vectors.
void cellsOf(const float* __restrict places, const float* __restrict grain, std::uint32_t* __restrict cells) {
    for (std::size_t i = 0; i < atOnce; ++i) {
        const float count = places[i] / grain[i];
        const float low = count < -1e9f ? -1e9f : count;
        const float limited = low > 1e9f ? 1e9f : low;
        const std::int32_t whole = static_cast<std::int32_t>(limited);
        const std::int32_t floor = whole - (static_cast<float>(whole) > limited ? 1 : 0);
        cells[i] = static_cast<std::uint32_t>(floor + (1 << 20)) & 0x1fffffu;
    }
}

void hash(const std::uint32_t* __restrict x, const std::uint32_t* __restrict y, const std::uint32_t* __restrict z,
          std::uint64_t stream, std::uint64_t* __restrict bits) {
    for (std::size_t i = 0; i < atOnce; ++i) {
        const std::uint64_t index =
            x[i] | (static_cast<std::uint64_t>(y[i]) << 21) | (static_cast<std::uint64_t>(z[i]) << 42);
        bits[i] = random_lanes::mixed(random_lanes::mixed(index + 0x9e3779b97f4a7c15ull) ^ stream);
    }
}

void choose(const std::uint64_t* __restrict bits, std::int64_t limit, std::uint64_t* __restrict chosen) {
    for (std::size_t i = 0; i < atOnce; ++i) {
        const std::uint64_t white = static_cast<std::int64_t>(bits[i] >> 40) < limit ? 1 : 0;
        chosen[i] = white | ((bits[i] >> 7) & 2u) | ((bits[i] >> 12) & 0xf0u);
    }
}

}  // namespace

void cellNoise(const CellNoise& n, std::size_t count) {
    // Uniform numbers are multiples of 2^-24: those below `white` are whole numbers below this.
    const float share = n.white * 0x1p24f;
    const std::int32_t cut = static_cast<std::int32_t>(share);
    const std::int64_t limit = cut + (static_cast<float>(cut) < share ? 1 : 0);
    const std::uint64_t stream = 0xd1b54a32d192ed03ull * (1ull + n.seed);
    for (std::size_t first = 0; first < count; first += atOnce) {
        const std::size_t some = count - first < atOnce ? count - first : atOnce;
        float places[3][atOnce], grain[atOnce];
        std::uint32_t cells[3][atOnce];
        std::uint64_t bits[atOnce], chosen[atOnce];
        const float* const from[3] = {n.x + first, n.y + first, n.z + first};
        for (std::size_t i = 0; i < atOnce; ++i) grain[i] = i < some ? n.grain[first + i] : 1.0f;
        for (int axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < atOnce; ++i) places[axis][i] = i < some ? from[axis][i] : 0.0f;
            cellsOf(places[axis], grain, cells[axis]);
        }
        hash(cells[0], cells[1], cells[2], stream, bits);
        choose(bits, limit, chosen);
        for (std::size_t i = 0; i < some; ++i) n.values[first + i] = static_cast<std::uint8_t>(chosen[i]);
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
