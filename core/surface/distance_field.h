// SPDX-License-Identifier: Apache-2.0
// Signed distance to the skin on a grid: what keeps guides and hair outside.
#pragma once

#include "core/base/progress.h"
#include "core/model/surface_mesh.h"
#include "core/surface/field_arrays.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace whorl {

/// Trilinear grid of signed distances, exact at the nodes near the skin (angle-weighted pseudo-normals decide the
/// side; Baerentzen and Aanaes 2005), clamped to the band elsewhere. Immutable; any thread may ask.
/// Open meshes: points are outside unless they are close behind a triangle.
class DistanceField {
public:
    /// The field at one place: ask once for distance and direction. Far from the skin it costs next to nothing.
    class Sample {
    public:
        /// Metres, above zero outside; +band beyond the band outside, -band inside.
        float distance() const { return m_distance; }
        /// Unit vector away from the skin; zero where the field is flat. Worked out at each call.
        glm::vec3 gradient() const;

    private:
        friend class DistanceField;
        explicit Sample(float distance) : m_distance(distance) {}

        float m_distance;
        float m_least = -1.0f;  // length of slope below which the field is flat; below zero: there is no slope
        glm::vec3 m_place;      // in the cell, 0 to 1
        float m_corners[8];     // x fastest, then y, then z
    };

    /// `resolution`: nodes along the longest side of the mesh's box (16 to 256). The band is about 6 nodes wide each
    /// way. Same bytes for any number of threads.
    static DistanceField build(const SurfaceMesh& mesh, int resolution = 128);

    Sample sample(const glm::vec3& p) const;
    float distance(const glm::vec3& p) const { return sample(p).distance(); }
    glm::vec3 gradient(const glm::vec3& p) const { return sample(p).gradient(); }
    float band() const { return m_band; }
    float spacing() const { return m_spacing; }
    FieldArrays arrays() const {
        return {{m_origin.x, m_origin.y, m_origin.z},
                {m_last.x, m_last.y, m_last.z},
                m_perMetre,
                m_band,
                {m_brickCounts[0], m_brickCounts[1]},
                m_bricks.data(),
                m_nodes.data()};
    }

private:
    static constexpr int brickCells = FieldArrays::brickCells;
    static constexpr int brickNodes = FieldArrays::brickNodes;
    static constexpr int nodesOfBrick = brickNodes * brickNodes * brickNodes;
    enum Brick : std::int32_t { FarInside = FieldArrays::farInside, FarOutside = FieldArrays::farOutside };
    static constexpr std::int32_t flips = FieldArrays::flips;

    Sample sampleNear(std::int32_t brick, const glm::ivec3& cell, const glm::vec3& place) const;
    void storeBricks(const std::vector<float>& values, const int (&size)[3]);

    glm::vec3 m_origin{0.0f};
    glm::vec3 m_last{0.0f};  // size of the grid in cells
    float m_spacing = 1.0f;
    float m_perMetre = 1.0f;  // cells
    float m_band = 0.0f;
    int m_brickCounts[2] = {0, 0};  // along x and y
    std::vector<std::int32_t> m_bricks;
    std::vector<float> m_nodes;
};

inline DistanceField::Sample DistanceField::sample(const glm::vec3& p) const {
    const glm::vec3 q = (p - m_origin) * m_perMetre;
    const bool within = static_cast<int>(q.x >= 0.0f) & static_cast<int>(q.x < m_last.x) &
                        static_cast<int>(q.y >= 0.0f) & static_cast<int>(q.y < m_last.y) &
                        static_cast<int>(q.z >= 0.0f) & static_cast<int>(q.z < m_last.z);
    if (!within) return Sample(m_band);
    const int x = static_cast<int>(q.x), y = static_cast<int>(q.y), z = static_cast<int>(q.z);
    const int brickX = x / brickCells, brickY = y / brickCells, brickZ = z / brickCells;
    const std::int32_t brick =
        m_bricks[static_cast<std::size_t>((brickZ * m_brickCounts[1] + brickY) * m_brickCounts[0] + brickX)];
    if (brick < 0) return Sample(brick == FarOutside ? m_band : -m_band);
    return sampleNear(brick, {x - brickX * brickCells, y - brickY * brickCells, z - brickZ * brickCells},
                      {q.x - static_cast<float>(x), q.y - static_cast<float>(y), q.z - static_cast<float>(z)});
}

}  // namespace whorl
