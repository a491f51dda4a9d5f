// SPDX-License-Identifier: Apache-2.0
// From a parsed glTF to triangles, parts and textures. Private to the importers.
#pragma once

#include "core/io/import/raw_mesh.h"

#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace whorl::import {

/// A mesh as one node of the scene shows it.
struct GltfInstance {
    int mesh = -1;
    int node = -1;  ///< or -1 when the file has no scene
    glm::dmat4 worldFromMesh{1.0};
};

/// Every mesh of the default scene, else of all root nodes, else every mesh once. Errors are half sentences.
Result<std::vector<GltfInstance>> findInstances(const tinygltf::Model& model);

/// The whole scene. Errors are whole sentences.
Result<RawImport> readScene(const tinygltf::Model& model, const std::string& name, const ImportOptions& options,
                            Progress& progress);

/// Colour and texture of a material.
struct GltfMaterial {
    glm::vec3 colour{clayColour};
    std::string texture{};
    int uvSet = 0;
};

/// Reads materials on first use and gathers the textures that they name.
class GltfMaterials {
public:
    GltfMaterials(const tinygltf::Model& model, const std::string& name, const ImportOptions& options, RawImport& out);
    const GltfMaterial& get(int number);

private:
    std::string texture(int number, const std::string& materialName);

    const tinygltf::Model& m_model;
    const std::string& m_name;
    const ImportOptions& m_options;
    RawImport& m_out;
    std::map<int, GltfMaterial> m_known;
    std::map<int, std::string> m_textureOfImage;
    UniqueNames m_names;
    std::uint64_t m_bytes = 0;
    bool m_transformNoted = false;
};

}  // namespace whorl::import
