// SPDX-License-Identifier: Apache-2.0
// Moves strands from one layout to another.
#pragma once

#include "core/hair/strands.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Strands [first, last) of one layout that are `strands` and `vertices` further on in another.
struct StrandRun {
    std::uint32_t first, last;
    std::int64_t strands, vertices;
};

/// Adds such a run in pieces that threads can share.
void addRuns(std::uint32_t first, std::uint32_t last, std::int64_t strands, std::int64_t vertices,
             std::vector<StrandRun>& runs);

/// Copies all of `runs` to where they go in `to`, which has room for them, by all threads.
void copyRuns(std::span<const StrandRun> runs, const Strands& from, Strands& to);

/// to = from, by all threads.
void copyStrands(const Strands& from, Strands& to);

}  // namespace whorl
