// SPDX-License-Identifier: Apache-2.0
// The random numbers of core/base/random.h for kernels. Internal linkage only (see core/base/simd.h).
#pragma once

#include <cstdint>

namespace whorl::random_lanes {

static inline std::uint64_t mixed(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

/// As randomFloat.
static inline float uniform(std::uint32_t seed, std::uint64_t index, std::uint32_t channel) {
    const std::uint64_t bits =
        mixed(mixed(index + 0x9e3779b97f4a7c15ull * (1ull + channel)) ^ (0xd1b54a32d192ed03ull * (1ull + seed)));
    return static_cast<float>(static_cast<std::int32_t>(bits >> 40)) * 0x1p-24f;
}

}  // namespace whorl::random_lanes
