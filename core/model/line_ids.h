// SPDX-License-Identifier: Apache-2.0
// Numbers of partings and strokes.
#pragma once

#include <cstdint>
#include <set>
#include <span>

namespace whorl {

/// The id that a new line gets: one more than the largest, or the smallest that is free.
template <class Line>
std::uint32_t nextLineId(std::span<const Line> lines) {
    std::set<std::uint32_t> taken;
    for (const Line& line : lines) taken.insert(line.id);
    if (taken.empty() || *taken.rbegin() < UINT32_MAX) return taken.empty() ? 1 : *taken.rbegin() + 1;
    std::uint32_t id = 1;
    while (taken.contains(id)) ++id;
    return id;
}

}  // namespace whorl
