// SPDX-License-Identifier: Apache-2.0
// The guides: the curves that the artist combs.
#pragma once

#include "core/base/cow.h"
#include "core/model/surface_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Up to `capacity` guides in one shared piece of memory. Read freely; write through GuideSet.
struct GuideBlock {
    static constexpr std::size_t capacity = 64;

    std::vector<SurfacePoint> roots;
    std::vector<std::uint32_t> ids;
    std::vector<std::uint8_t> groups;
    std::vector<std::uint32_t> firstPoint{0};  ///< n+1 entries; points of guide i are [firstPoint[i], firstPoint[i+1])
    std::vector<glm::vec3> points;             ///< metres, space of the mesh; the first point of a guide is its root

    std::size_t count() const { return roots.size(); }
};

/// Guides in blocks that copies share until edited, so that a stroke costs undo memory only for what it touched.
/// Guides have an index (0 to count() - 1, changes when others are erased) and an id (for ever).
/// All guides of a group have the same number of points (segments + 1).
class GuideSet {
public:
    std::size_t count() const { return m_firstIndex.back(); }
    bool empty() const { return count() == 0; }

    std::size_t blockCount() const { return m_blocks.size(); }
    const GuideBlock& block(std::size_t block) const { return *m_blocks[block]; }
    /// Index of the block's first guide.
    std::size_t firstOfBlock(std::size_t block) const { return m_firstIndex[block]; }
    /// True when block `block` of both is one and the same memory.
    bool blockSameAs(std::size_t block, const GuideSet& other) const {
        return block < other.m_blocks.size() && m_blocks[block].sameAs(other.m_blocks[block]);
    }
    bool sameAs(const GuideSet& other) const;

    SurfacePoint root(std::size_t index) const;
    std::uint32_t id(std::size_t index) const;
    std::uint8_t group(std::size_t index) const;
    std::span<const glm::vec3> points(std::size_t index) const;

    /// Points for writing; unshares the block. Keep the first point on the root. The span is good until the next
    /// non-const call.
    std::span<glm::vec3> editPoints(std::size_t index);
    /// Moves the root; the caller moves the points with it.
    void setRoot(std::size_t index, SurfacePoint root);
    void setGroup(std::size_t index, std::uint8_t group);
    /// Replaces the points of a guide, also by another number of them.
    void setPoints(std::size_t index, std::span<const glm::vec3> points);

    /// Adds a guide; at least two points. Returns its id.
    std::uint32_t append(SurfacePoint root, std::uint8_t group, std::span<const glm::vec3> points);
    /// The same with a known id (files). Ids must be unique.
    void appendWithId(std::uint32_t id, SurfacePoint root, std::uint8_t group, std::span<const glm::vec3> points);
    /// Erases guides by index; `indices` ascending and unique.
    void erase(std::span<const std::size_t> indices);
    void clear();

    /// The next id that `append` will give.
    std::uint32_t nextId() const { return m_nextId; }
    void setNextId(std::uint32_t id) { m_nextId = id; }

    /// Bytes of blocks that `before` does not share: what keeping both costs.
    std::size_t bytesNotSharedWith(const GuideSet& before) const;

private:
    struct Place {
        std::size_t block;
        std::size_t slot;
    };
    Place locate(std::size_t index) const;

    std::vector<Cow<GuideBlock>> m_blocks;
    std::vector<std::size_t> m_firstIndex{0};  // blockCount() + 1 entries
    std::uint32_t m_nextId = 1;
};

/// The same curve with `segments` pieces of equal length along it; roots and tips stay.
std::vector<glm::vec3> resampled(std::span<const glm::vec3> points, int segments);

}  // namespace whorl
