// SPDX-License-Identifier: Apache-2.0
// Hair in boxes: the light-space volume that shadows hair and skin (seed 004, section 2.3), and the ambient volume.
#pragma once

#include "core/hair/strands.h"
#include "render/passes/hair_order.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <vector>

// Both are made by the processor in fixed point, so that any order of additions gives the same bytes.

namespace whorl {

/// Additive voxelisation of hair in the space of the light, summed along the light's way.
class VoxelShadow {
public:
    static constexpr int size = 128;
    /// Layers of hair that the largest texel means.
    static constexpr float fullLayers = 64.0f;
    /// Layers that the hair of the nearest voxels means at most: which of it lies before a place and which behind, the
    /// grid cannot tell, and the surface of a dense coat must not shadow itself.
    static constexpr float nearLayers = 7.0f;

    /// `towardsLight` is a unit vector. Hairs count by their width as drawn. A layer is a quarter of what would
    /// cover a voxel's side, so that shadows do not depend on the grid.
    void build(const Strands& strands, const HairDetail& detail, const glm::vec3& towardsLight);
    /// The same with one thread and plain loops, additions at the nearest voxel one by one; for tests and the
    /// benchmark.
    void buildReference(const Strands& strands, const HairDetail& detail, const glm::vec3& towardsLight);

    /// size cubed; x fastest, z from the light inwards; 65535 means fullLayers.
    const std::vector<std::uint16_t>& texels() const { return m_texels; }
    /// To 0 to 1 in the volume.
    const glm::mat4& voxelFromGroom() const { return m_matrix; }
    bool empty() const { return m_empty; }

private:
    void place(const Strands& strands, const glm::vec3& towardsLight);

    glm::mat4 m_matrix{1.0f};
    glm::vec3 m_voxel{1.0f};  // metres
    bool m_empty = true;
    std::vector<std::uint32_t> m_counts;
    std::vector<std::uint16_t> m_texels;
};

/// How much of the surroundings every place sees through the hair, and from where on the whole. Independent of light
/// and camera.
class AmbientVolume {
public:
    static constexpr int size = 32;
    /// Covers that the hair of a cell and its neighbour hides at most; see VoxelShadow::nearLayers.
    static constexpr float nearCover = 1.3f;

    void build(const Strands& strands, const HairDetail& detail);
    /// size cubed; xyz: sum of the directions that are open (up to unit length), w: open share, 0 to 1.
    const std::vector<glm::vec4>& texels() const { return m_texels; }
    /// position * scale + offset is 0 to 1 in the volume.
    glm::vec3 scale() const { return m_scale; }
    glm::vec3 offset() const { return m_offset; }

private:
    glm::vec3 m_scale{0.0f};
    glm::vec3 m_offset{-1.0f};
    std::vector<glm::vec4> m_texels;
};

/// Box of all vertices, in parallel. Empty without hair.
Bounds vertexBounds(const Strands& strands);

}  // namespace whorl
