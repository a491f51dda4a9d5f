// SPDX-License-Identifier: Apache-2.0
// What every mesh reader fills, and the steps that all of them share. Private to the importers.
#pragma once

#include "core/io/mesh_import.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace whorl::import {

constexpr std::uint64_t maxTriangles = 20'000'000;
constexpr std::uint64_t maxParts = 100'000;
constexpr std::uint64_t maxMeshFileBytes = (4ull << 30) - 1;
constexpr std::uint64_t maxImageFileBytes = 256ull << 20;
constexpr std::uint64_t maxAllImageBytes = 1ull << 30;
constexpr std::size_t maxTextures = 64;

/// Triangles as the file has them. `corners` are checked against `positions` by the reader.
struct RawMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      ///< one a position, any length, zero where unknown; or empty
    std::vector<std::uint32_t> corners;  ///< three a triangle
    std::vector<glm::vec2> cornerUvs;    ///< three a triangle, v up; or empty
    std::vector<MeshPart> parts;         ///< contiguous, in order, covering all triangles
};

/// A base colour image by the name that parts use.
struct RawTexture {
    std::string name;
    std::vector<std::uint8_t> bytes;  ///< encoded
    std::string source;               ///< for error texts and the suffix
};

struct RawImport {
    RawMesh mesh;
    std::vector<RawTexture> textures;
    Problems problems;
    std::uint64_t sourceTriangles = 0;
};

/// Files beside the mesh: only regular ones, only inside the mesh's own folder after following links.
class Neighbours {
public:
    Neighbours() = default;  ///< a mesh from memory: nothing can be read
    explicit Neighbours(const std::filesystem::path& meshFile);
    /// The reason as half a sentence on failure ("it points outside the folder of the mesh").
    Result<std::filesystem::path> find(std::string_view reference) const;
    Result<std::vector<std::uint8_t>> read(std::string_view reference, std::uint64_t maxBytes) const;

private:
    std::filesystem::path m_folder;
};

/// Readers. Errors are whole sentences that start with `name`.
Result<RawImport> readGltf(std::span<const std::uint8_t> bytes, const std::string& name, const Neighbours& neighbours,
                           const ImportOptions& options, Progress& progress);
Result<RawImport> readObj(std::span<const std::uint8_t> bytes, const std::string& name, const Neighbours& neighbours,
                          const ImportOptions& options, Progress& progress);
Result<RawImport> readPly(std::span<const std::uint8_t> bytes, const std::string& name, Progress& progress);

/// Welds, skips what has no area or is not finite, makes normals and UVs, drops empty parts.
Result<SurfaceMesh> finishMesh(RawMesh raw, const std::string& name, Problems& problems, Progress& progress);

/// Appends the triangles of a polygon as numbers of its corners, three each: corner count - 2 triangles, or none for
/// fewer than three corners. Ears are cut in the polygon's own plane; a fan where that fails. Any number of corners.
void triangulate(std::span<const glm::vec3> polygon, std::vector<std::uint32_t>& out);

/// "name: reason; advice."
Error meshError(const std::string& name, const std::string& reason,
                const std::string& advice = "export the mesh again from its program");

/// "1 triangle", "3 triangles".
std::string counted(std::uint64_t count, const char* thing);

/// `wanted` made fit to show and different from all before.
class UniqueNames {
public:
    std::string make(std::string_view wanted, std::string_view otherwise);

private:
    std::map<std::string, std::uint32_t, std::less<>> m_used;  ///< with the number to try next
};

}  // namespace whorl::import
