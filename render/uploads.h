// SPDX-License-Identifier: Apache-2.0
// Counts of what went to the graphics card.
#pragma once

#include <cstdint>

namespace whorl {

/// Since the renderer was made.
struct Uploads {
    std::uint64_t meshes = 0;
    std::uint64_t mapTiles = 0;
    std::uint64_t guideBlocks = 0;
    std::uint64_t strands = 0;
    std::uint64_t licTiles = 0;  ///< of hair texture: tones and colours
    std::uint64_t bytes = 0;
    bool operator==(const Uploads&) const = default;
};

}  // namespace whorl
