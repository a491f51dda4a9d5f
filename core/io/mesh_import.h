// SPDX-License-Identifier: Apache-2.0
// Meshes from glTF, GLB, OBJ and PLY.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/groom.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace whorl {

struct ImportedMesh {
    SurfaceMesh mesh;
    MapSet textures;                    ///< base colour textures that the parts name
    Problems problems;                  ///< what was repaired, skipped or is missing, one sentence each
    std::uint32_t sourceTriangles = 0;  ///< that the file defines, each mesh once, before instances and skipping
};

struct ImportOptions {
    bool textures = true;  ///< decode base colour textures (each in its own process); false: parts name none
};

/// By content and suffix: .gltf, .glb, .obj, .ply. Polygons are triangulated, triangles with non-finite corners or no
/// area are skipped and counted in `problems`, coincident vertices welded, missing normals computed, missing UVs made
/// (atlas). Every accessor is checked in 64 bits before it is read. Only files inside the mesh's own folder are opened.
/// Refused: nothing left to grow on, more than 20 million triangles, anything that points outside the file.
Result<ImportedMesh> importMesh(const std::filesystem::path& file, Progress& progress,
                                const ImportOptions& options = {});

/// The same from memory; external files are not read. `format`: "glb", "gltf", "obj" or "ply". For fuzzing.
Result<ImportedMesh> importMeshBytes(std::span<const std::uint8_t> bytes, const std::string& format, Progress& progress,
                                     const ImportOptions& options = {});

}  // namespace whorl
