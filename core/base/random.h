// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: a pure function of (seed, index, channel), so any thread can make any hair.
#pragma once

#include <cstdint>

namespace whorl {

/// Bijective 64-bit mixer (SplitMix64 finaliser; Steele, Lea, Flood 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

/// 64 random bits for item `index` of stream `seed`; `channel` separates the uses of one item (root, frizz, colour).
constexpr std::uint64_t randomBits(std::uint32_t seed, std::uint64_t index, std::uint32_t channel) {
    return mix64(mix64(index + 0x9e3779b97f4a7c15ull * (1ull + channel)) ^ (0xd1b54a32d192ed03ull * (1ull + seed)));
}

/// Uniform in [0, 1), 24 bits.
constexpr float unitFloat(std::uint64_t bits) {
    return static_cast<float>(bits >> 40) * 0x1p-24f;
}

/// Uniform in [0, 1), 53 bits.
constexpr double unitDouble(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Uniform in [0, 1) for (seed, index, channel).
constexpr float randomFloat(std::uint32_t seed, std::uint64_t index, std::uint32_t channel) {
    return unitFloat(randomBits(seed, index, channel));
}

}  // namespace whorl
