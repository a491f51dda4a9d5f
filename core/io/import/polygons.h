// SPDX-License-Identifier: Apache-2.0
// Polygons with separate position and UV numbers, as OBJ and PLY have them. Private to the importers.
#pragma once

#include "core/io/import/raw_mesh.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace whorl::import {

/// Faces in file order; runs of faces belong to a part.
struct Polygons {
    static constexpr std::uint32_t noUv = std::numeric_limits<std::uint32_t>::max();

    struct Run {
        std::uint32_t part = 0;
        std::uint32_t firstFace = 0;
    };

    std::vector<std::uint32_t> positions;  ///< one a corner
    std::vector<std::uint32_t> uvs;        ///< one a corner, noUv where missing; or empty
    std::vector<std::uint64_t> faceEnds;   ///< end of each face in the corners
    std::vector<Run> runs;                 ///< in order of faces; empty: one part

    std::uint64_t triangles = 0;  ///< that the faces will give
};

/// Cuts all faces into triangles, part by part. All numbers must be inside `positions` and `uvs`.
void cutPolygons(const Polygons& polygons, const std::vector<glm::vec2>& uvs, RawMesh& mesh);

}  // namespace whorl::import
