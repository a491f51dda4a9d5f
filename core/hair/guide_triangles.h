// SPDX-License-Identifier: Apache-2.0
// Triangles of guides over the skin, for hair that blends the three guides around it (seeds 001 and 003).
#pragma once

#include "core/hair/guide_index.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace whorl {

/// The dual of the guides' Voronoi diagram on the skin (restricted Delaunay triangulation): three guides make a
/// triangle where a place of the growing skin is equally near to all of them and no other is nearer. Only guides whose
/// normal faces the way of the skin there count, so that the two sides of a thin sheet have triangles of their own.
/// Guides are moved by a ten-thousandth of their distances first, so that four on a circle give two triangles and not
/// none. Immutable once made; any thread may ask.
class GuideTriangles {
public:
    /// A place on the triangles. Corners are places in GuideIndex::rootsOf(group); the weights add up to 1.
    struct Place {
        glm::uvec3 corners{0};
        glm::vec3 weights{0.0f};
    };

    GuideTriangles() = default;
    /// Of a group of `index`.
    GuideTriangles(const Groom& groom, const GuideIndex& index, std::size_t group);

    bool empty() const { return m_triangles.empty(); }
    std::span<const glm::uvec3> triangles() const { return m_triangles; }

    /// The place nearest to `position` on the triangles that face the way of `normal`: inside one, on an edge where the
    /// skin bends there or goes on beyond the outermost guides. Continuous over edges; beyond the outermost guides but
    /// for where two places of their border are equally near. Nothing without triangles.
    std::optional<Place> nearest(const glm::vec3& position, const glm::vec3& normal) const;

private:
    struct Corners {
        glm::vec3 a{0.0f}, b{0.0f}, c{0.0f};
        glm::vec3 normal{0.0f};
    };
    struct Node {
        Bounds box{};
        std::uint32_t first = 0, last = 0;
        std::uint32_t second = 0;  // the first child follows its parent; 0: a leaf
    };
    std::uint32_t build(std::uint32_t first, std::uint32_t last);

    std::vector<glm::uvec3> m_triangles;
    std::vector<Corners> m_corners;
    std::vector<Node> m_nodes;
};

}  // namespace whorl
