// SPDX-License-Identifier: Apache-2.0
// Generated hair, as it is drawn, hashed, exported and handed to renderers.
#pragma once

#include "core/base/hash.h"
#include "core/base/plain_vector.h"
#include "core/surface/surface_point.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace whorl {

/// Catmull-Rom curves through their vertices (the curve passes through all of them, ends included). Immutable once
/// shared. Arrays of one kind have equal length: a hair, or a vertex.
struct Strands {
    std::vector<std::uint32_t> firstVertex{0};  ///< n+1 entries; hair i has vertices [firstVertex[i], firstVertex[i+1])

    // One a hair.
    std::vector<std::uint32_t> ids;     ///< index of the hair in the whole groom, however it was split
    std::vector<std::uint8_t> members;  ///< number of the hair in its strand: hairs of one strand share their id
    std::vector<SurfacePoint> roots;
    std::vector<glm::vec2> rootUvs;
    std::vector<std::uint8_t> groups;

    // One a vertex. resize() leaves what it adds unset.
    PlainVector<glm::vec3> positions;  ///< metres, space of the mesh
    PlainVector<glm::vec3> normals;    ///< unit, perpendicular to the curve, rotation minimising (Wang et al. 2008)
    PlainVector<float> widths;         ///< diameter, metres
    PlainVector<glm::vec4> colours;    ///< linear RGB and opacity

    std::size_t count() const { return ids.size(); }
    std::size_t vertexCount() const { return positions.size(); }
    std::size_t bytes() const;
    void append(const Strands& more);
    void clear();
    /// Room for so many; what is new is unset, all but firstVertex[0] is to be filled in.
    void resize(std::size_t hairs, std::size_t vertices);

    /// Memory for so many and a sixteenth more, so that a few more need no other memory. False when it had to be taken
    /// anew: then what was in the arrays is lost.
    bool makeRoom(std::size_t hairs, std::size_t vertices);

    /// Exact box of the rendered curve with its width, not only of the vertices.
    Bounds bounds() const;
    /// Adds every hair in order: equal for the same hair however it was cut into parts or blocks.
    void addTo(Hasher& hasher) const;
};

}  // namespace whorl
