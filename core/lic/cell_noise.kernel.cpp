// SPDX-License-Identifier: Apache-2.0
#include "core/lic/cell_noise.kernel.h"

#include "core/base/random_lanes.h"

namespace whorl::WHORL_SIMD_NAMESPACE {
namespace {

// As in solidNoise: cells count from a million below zero.
inline std::uint64_t cellOf(float x, float grain) {
    const float cells = x / grain;
    const float low = cells < -1e9f ? -1e9f : cells;
    const float limited = low > 1e9f ? 1e9f : low;
    const std::int32_t whole = static_cast<std::int32_t>(limited);
    const std::int32_t floor = whole - (static_cast<float>(whole) > limited ? 1 : 0);
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(floor + (1 << 20)) & 0x1fffffu);
}

}  // namespace

void cellNoise(const CellNoise& n, std::size_t count) {
    // Uniform numbers are multiples of 2^-24: those below `white` are whole numbers below this.
    const float share = n.white * 0x1p24f;
    const std::int32_t cut = static_cast<std::int32_t>(share);
    const std::int64_t limit = cut + (static_cast<float>(cut) < share ? 1 : 0);
    const std::uint64_t stream = 0xd1b54a32d192ed03ull * (1ull + n.seed);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t index =
            cellOf(n.x[i], n.grain[i]) | (cellOf(n.y[i], n.grain[i]) << 21) | (cellOf(n.z[i], n.grain[i]) << 42);
        const std::uint64_t bits = random_lanes::mixed(random_lanes::mixed(index + 0x9e3779b97f4a7c15ull) ^ stream);
        const std::uint64_t white = static_cast<std::int64_t>(bits >> 40) < limit ? 1 : 0;
        n.values[i] = static_cast<std::uint8_t>(white | ((bits >> 7) & 2u) | ((bits >> 12) & 0xf0u));
    }
}

}  // namespace whorl::WHORL_SIMD_NAMESPACE
