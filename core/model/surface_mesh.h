// SPDX-License-Identifier: Apache-2.0
// The mesh that hair grows from.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace whorl {

/// What a part without a material of its own looks like: clay, darker than most hair's gloss and lighter than its
/// roots.
inline constexpr glm::vec3 clayColour{0.42f, 0.33f, 0.28f};

/// A named, contiguous range of triangles: a glTF primitive, an OBJ group or object.
struct MeshPart {
    std::string name;
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
    glm::vec3 baseColour{clayColour};  ///< linear
    std::string texture{};             ///< name of a colour map of the groom, or empty
};

/// Triangles with welded vertices and UVs at corners, so that a UV seam does not cut the surface.
/// Metres, Y up, counter-clockwise outside. UV v points up (the row v = 0 of an image is its last).
/// Never empty in a groom that was opened from a file: at least one triangle of area above zero, all numbers finite.
/// Non-manifold edges, open borders and unused vertices are normal.
struct SurfaceMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;     ///< one a position, unit length
    std::vector<glm::uvec3> triangles;  ///< indices into `positions`
    std::vector<glm::vec2> cornerUvs;   ///< three a triangle, never empty: meshes without UVs get an atlas on import
    std::vector<MeshPart> parts;        ///< cover all triangles in order
    bool madeAtlas = false;             ///< the UVs were made by Whorl

    std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(triangles.size()); }
};

/// The artist's choice for one MeshPart; same order.
struct PartSettings {
    bool growsHair = true;
    bool visible = true;
    bool operator==(const PartSettings&) const = default;
};

/// A place on the surface: position = (1 - u - v) a + u b + v c of the triangle's corners. u, v >= 0, u + v <= 1.
struct SurfacePoint {
    std::uint32_t triangle = 0;
    float u = 0.0f;
    float v = 0.0f;
    bool operator==(const SurfacePoint&) const = default;
};

}  // namespace whorl
