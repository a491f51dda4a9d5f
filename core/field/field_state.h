// SPDX-License-Identifier: Apache-2.0
// What a direction field and its solver keep.
#pragma once

#include "core/field/direction_field.h"
#include "core/surface/parting_index.h"

#include <array>
#include <cstdint>

namespace whorl {

/// The growing area as the solver sees it. Directions are complex numbers in a frame at each vertex: the first axis is
/// 1, the second, a quarter turn to the left seen from outside, is i.
struct FieldDomain {
    std::shared_ptr<const Surface> surface;
    std::vector<std::uint8_t> grows;  ///< one a triangle
    PartingIndex partings;
    std::vector<Parting> lines;
    std::vector<std::uint8_t> nearParting;  ///< one a triangle: a parting may pass through it or along it
    std::vector<glm::vec3> normals;         ///< one a vertex
    std::vector<glm::vec3> axes;            ///< the first axis at each vertex
    std::vector<glm::vec3> besides;         ///< one a vertex: where partings have it, clear of them; empty: no partings

    const SurfaceMesh& mesh() const { return surface->mesh(); }
    bool apart(const PartingIndex::Root& a, const PartingIndex::Root& b) const;
    /// A vertex, as partings have it.
    PartingIndex::Root root(std::uint32_t vertex) const {
        return {besides.empty() ? mesh().positions[vertex] : besides[vertex], normals[vertex]};
    }
    /// The same as `apart` for two vertices.
    bool separated(std::uint32_t a, std::uint32_t b) const;
    std::complex<double> inFrame(std::uint32_t vertex, const glm::vec3& direction) const;
    glm::vec3 fromFrame(std::uint32_t vertex, std::complex<double> value) const;
    /// What a vector's number at `from` is multiplied by when it is turned along with the skin to `to`.
    std::complex<double> turn(std::uint32_t from, std::uint32_t to) const;
    /// Part of `direction` along the skin at a vertex.
    glm::vec3 tangent(std::uint32_t vertex, const glm::vec3& direction) const;
};

struct DirectionField::State {
    std::shared_ptr<const FieldDomain> domain;
    std::vector<glm::vec3> directions;
};

}  // namespace whorl
