// SPDX-License-Identifier: Apache-2.0
// A map as numbers in rows, ready for bilinear sampling without a thought of its edges.
#pragma once

#include "core/model/map_changes.h"

#include <vector>

namespace whorl {

/// First channel (mean of three) of all texels as Map::sample sees them, in rows of width + 2: a copy of the last
/// column, all columns, a copy of the first; rows alike.
class BorderedTexels {
public:
    /// Larger maps are not worth the memory.
    static constexpr std::size_t mostTexels = std::size_t{1} << 26;
    static bool fits(const Map& map);

    bool empty() const { return m_values.empty(); }
    const float* data() const { return m_values.data(); }
    /// All of a map that `fits`.
    void read(const Map& map);
    /// A part of the map that was read.
    void read(const Map& map, const TexelRect& part);
    std::size_t memoryBytes() const { return m_values.capacity() * sizeof(float); }

private:
    std::vector<float> m_values;
};

}  // namespace whorl
