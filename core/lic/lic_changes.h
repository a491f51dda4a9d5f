// SPDX-License-Identifier: Apache-2.0
// Which blocks of an atlas a difference between two grooms or fields touches. Private to painter.cpp.
#pragma once

#include "core/field/direction_field.h"
#include "core/lic/texel_atlas.h"
#include "core/model/groom.h"

#include <string>
#include <vector>

namespace whorl {

using LicBlocks = std::vector<std::uint8_t>;  ///< one a block

/// Made once for an atlas, which must outlive it.
class LicChanges {
public:
    explicit LicChanges(const TexelAtlas& atlas);

    /// Marks blocks where the map of one name in `before` and of the other in `after` give other values.
    void addMap(const Groom& before, const std::string& nameBefore, const Groom& after, const std::string& nameAfter,
                LicBlocks& blocks) const;
    /// Triangles at whose corners the fields differ, ascending.
    std::vector<std::uint32_t> triangles(const DirectionField& before, const DirectionField& after) const;
    /// Triangles that are in the growing area of one of them only.
    std::vector<std::uint32_t> grown(const DirectionField& before, const DirectionField& after) const;
    void addTriangles(std::span<const std::uint32_t> triangles, LicBlocks& blocks) const;

    static void addAll(LicBlocks& blocks) { blocks.assign(blocks.size(), 1); }
    static void add(const LicBlocks& more, LicBlocks& blocks);

private:
    template <class Same>
    std::vector<std::uint32_t> differing(Same&& same) const;

    const TexelAtlas& m_atlas;
    // By cells of the mesh's UVs as TouchedUvs has them, and by triangle: blocks from first[i] up to first[i + 1].
    std::vector<std::uint32_t> m_firstOfCell, m_blocksOfCell;
    std::vector<std::uint32_t> m_firstOfTriangle, m_blocksOfTriangle;
    std::vector<std::uint32_t> m_farOut;  // blocks with UVs beyond all cells
};

}  // namespace whorl
