// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/gltf_scene.h"

#include "core/io/import/gltf_accessor.h"
#include "core/io/plain_text.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace whorl::import {
namespace {

constexpr std::uint64_t maxSparseReads = 100'000'000;
constexpr std::size_t maxProblems = 100;

bool triangular(int mode) {
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

// Triangles that `count` corners make.
std::uint64_t triangleCount(int mode, std::uint64_t count) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return count / 3;
    return count < 3 ? 0 : count - 2;
}

// Corner k of triangle t; strips turn every second triangle round.
std::uint64_t cornerOf(int mode, std::uint64_t t, std::uint64_t k) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return t * 3 + k;
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return k == 0 ? 0 : t + k;
    return t % 2 == 0 || k == 0 ? t + k : t + 3 - k;
}

// The opened accessors of a primitive that makes triangles.
struct Primitive {
    GltfAccessor positions;
    std::optional<GltfAccessor> indices, normals, uvs;
    int mode = TINYGLTF_MODE_TRIANGLES;
    std::uint64_t triangles = 0;

    std::uint64_t vertex(std::uint64_t corner) const { return indices ? indices->index(corner) : corner; }
};

class SceneReader {
public:
    SceneReader(const tinygltf::Model& model, const std::string& name, const ImportOptions& options, Progress& progress)
        : m_model(model), m_name(name), m_progress(progress), m_materials(model, name, options, m_out) {}

    Result<RawImport> read() {
        if (auto counted = countSource(); !counted) return counted.error();
        const auto instances = findInstances(m_model);
        if (!instances) return meshError(m_name, instances.error().message);
        if (auto fits = checkTotals(*instances); !fits) return fits.error();
        for (const GltfInstance& instance : *instances) {
            if (m_progress.cancelled()) return cancelledError();
            if (auto added = addInstance(instance); !added) return added.error();
        }
        if (!m_anyUv) m_out.mesh.cornerUvs.clear();
        note(m_notTriangles, "points or lines");
        note(m_withoutPositions, "no positions");
        if (m_anyUv && m_withoutUvs > 0) {
            m_out.problems.push_back(plainText(m_name) + ": " + counted(m_withoutUvs, "part") +
                                     " without UVs; maps show one texel there.");
        }
        return std::move(m_out);
    }

private:
    void note(std::uint64_t count, const char* what) {
        if (count == 0) return;
        m_out.problems.push_back(plainText(m_name) + ": " + counted(count, "primitive") + " with " + what +
                                 " skipped; hair grows on triangles only.");
    }

    Error wrong(std::size_t mesh, std::size_t primitive, const std::string& reason) const {
        return meshError(m_name,
                         "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(primitive) + ": " + reason);
    }

    static int attribute(const tinygltf::Primitive& primitive, const std::string& semantic) {
        const auto found = primitive.attributes.find(semantic);
        return found == primitive.attributes.end() ? -1 : found->second;
    }

    // Opens what every use needs; nothing for primitives that make no triangles.
    Result<std::optional<Primitive>> open(const tinygltf::Primitive& source) {
        const int mode = source.mode < 0 ? TINYGLTF_MODE_TRIANGLES : source.mode;
        const int position = attribute(source, "POSITION");
        if (!triangular(mode) || position < 0) return std::optional<Primitive>{};
        auto positions = GltfAccessor::open(m_model, position, 3);
        if (!positions) {
            if (source.extensions.count("KHR_draco_mesh_compression") != 0) {
                return Error{"it is compressed with KHR_draco_mesh_compression, which is not read"};
            }
            return positions.error();
        }
        // Opening reads all sparse indices, so a file could make it arbitrarily slow by naming one accessor often.
        m_sparse += positions->sparseCount();
        if (m_sparse > maxSparseReads) return Error{"it uses sparse accessors too often"};
        Primitive out;
        out.positions = std::move(*positions);
        out.mode = mode;
        std::uint64_t corners = out.positions.count();
        if (source.indices >= 0) {
            auto indices = GltfAccessor::open(m_model, source.indices, 1);
            if (!indices) return indices.error();
            m_sparse += indices->sparseCount();
            const int type = indices->componentType();
            if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
                return Error{"its indices are no whole numbers"};
            }
            corners = indices->count();
            out.indices = std::move(*indices);
        }
        out.triangles = triangleCount(mode, corners);
        return std::optional<Primitive>(std::move(out));
    }

    // Every mesh of the file once, shown or not.
    Result<void> countSource() {
        m_trianglesOf.assign(m_model.meshes.size(), 0);
        for (std::size_t m = 0; m < m_model.meshes.size(); ++m) {
            for (std::size_t p = 0; p < m_model.meshes[m].primitives.size(); ++p) {
                const auto& source = m_model.meshes[m].primitives[p];
                const auto primitive = open(source);
                if (!primitive) return wrong(m, p, primitive.error().message);
                if (*primitive) {
                    m_trianglesOf[m] += (*primitive)->triangles;
                } else {
                    ++(attribute(source, "POSITION") < 0 ? m_withoutPositions : m_notTriangles);
                }
            }
            m_out.sourceTriangles += m_trianglesOf[m];
        }
        return {};
    }

    // A small file can show one mesh a million times; that must come out before any memory is taken.
    Result<void> checkTotals(const std::vector<GltfInstance>& instances) const {
        std::uint64_t triangles = 0;
        std::uint64_t parts = 0;
        for (const GltfInstance& instance : instances) {
            triangles += m_trianglesOf[static_cast<std::size_t>(instance.mesh)];
            parts += m_model.meshes[static_cast<std::size_t>(instance.mesh)].primitives.size();
            if (triangles > maxTriangles) {
                return meshError(m_name, "it has more than 20 million triangles",
                                 "reduce the mesh and export it again");
            }
            if (parts > maxParts) return meshError(m_name, "its scene shows more than 100,000 parts");
        }
        return {};
    }

    // An attribute that may be missing or, when it does not fit, is left out.
    std::optional<GltfAccessor> optional(const tinygltf::Primitive& source, const std::string& semantic, int components,
                                         std::uint64_t count) {
        const int number = attribute(source, semantic);
        if (number < 0) return std::nullopt;
        auto accessor = GltfAccessor::open(m_model, number, components);
        if (accessor && accessor->count() >= count) {
            m_sparse += accessor->sparseCount();
            return std::move(*accessor);
        }
        if (m_out.problems.size() >= maxProblems) return std::nullopt;
        m_out.problems.push_back(plainText(m_name) + ": " + semantic + " is left out: " +
                                 (accessor ? "it has too few elements" : plainText(accessor.error().message)) + ".");
        return std::nullopt;
    }

    Result<void> addInstance(const GltfInstance& instance) {
        const auto meshNumber = static_cast<std::size_t>(instance.mesh);
        const tinygltf::Mesh& mesh = m_model.meshes[meshNumber];
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const tinygltf::Primitive& source = mesh.primitives[p];
            auto opened = open(source);
            if (!opened) return wrong(meshNumber, p, opened.error().message);
            if (!*opened || (*opened)->triangles == 0) continue;
            Primitive& primitive = **opened;
            const GltfMaterial& material = m_materials.get(source.material);
            const std::uint64_t vertices = primitive.positions.count();
            primitive.normals = optional(source, "NORMAL", 3, vertices);
            primitive.uvs = optional(source, "TEXCOORD_" + std::to_string(material.uvSet), 2, vertices);
            if (!primitive.uvs && material.uvSet != 0) primitive.uvs = optional(source, "TEXCOORD_0", 2, vertices);

            MeshPart part;
            part.name = m_names.make(partName(instance, mesh, source), "mesh");
            part.baseColour = material.colour;
            part.texture = primitive.uvs ? material.texture : std::string();
            part.firstTriangle = static_cast<std::uint32_t>(m_out.mesh.corners.size() / 3);
            part.triangleCount = static_cast<std::uint32_t>(primitive.triangles);
            if (auto added = addTriangles(primitive, instance.worldFromMesh); !added) {
                return wrong(meshNumber, p, added.error().message);
            }
            m_out.mesh.parts.push_back(std::move(part));
        }
        return {};
    }

    std::string partName(const GltfInstance& instance, const tinygltf::Mesh& mesh,
                         const tinygltf::Primitive& source) const {
        std::string name = instance.node >= 0 ? m_model.nodes[static_cast<std::size_t>(instance.node)].name : "";
        if (name.empty()) name = mesh.name;
        const bool known = source.material >= 0 && static_cast<std::size_t>(source.material) < m_model.materials.size();
        const std::string material = known ? m_model.materials[static_cast<std::size_t>(source.material)].name : "";
        if (name.empty()) return material;
        name = plainText(name, 80);
        return mesh.primitives.size() > 1 && !material.empty() ? name + " / " + material : name;
    }

    Result<void> addTriangles(const Primitive& primitive, const glm::dmat4& world) {
        RawMesh& out = m_out.mesh;
        const std::uint64_t corners = primitive.triangles * 3;
        std::vector<std::uint32_t> used(corners);
        for (std::uint64_t t = 0; t < primitive.triangles; ++t) {
            for (std::uint64_t k = 0; k < 3; ++k) {
                const std::uint64_t vertex = primitive.vertex(cornerOf(primitive.mode, t, k));
                if (vertex >= primitive.positions.count()) {
                    return Error{"an index names vertex " + std::to_string(vertex) + " of " +
                                 std::to_string(primitive.positions.count())};
                }
                used[t * 3 + k] = static_cast<std::uint32_t>(vertex);
            }
        }
        // A primitive may use a few vertices of a vast shared buffer: only these are copied.
        std::vector<std::uint32_t> vertices(used);
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        const auto base = static_cast<std::uint32_t>(out.positions.size());
        addVertices(primitive, vertices, world);

        const glm::dmat3 linear(world);
        const bool mirrored = glm::determinant(linear) < 0.0;
        if (primitive.uvs) {
            m_anyUv = true;
        } else {
            ++m_withoutUvs;
        }
        for (std::uint64_t t = 0; t < primitive.triangles; ++t) {
            for (std::uint64_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = used[t * 3 + (mirrored && k > 0 ? 3 - k : k)];
                const auto found = std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin();
                out.corners.push_back(base + static_cast<std::uint32_t>(found));
                glm::vec2 uv(0.0f);
                if (primitive.uvs) {
                    // glTF counts v down from the image's first row, Whorl up from its last.
                    uv = {static_cast<float>(primitive.uvs->value(vertex, 0)),
                          1.0f - static_cast<float>(primitive.uvs->value(vertex, 1))};
                }
                out.cornerUvs.push_back(uv);
            }
        }
        return {};
    }

    void addVertices(const Primitive& primitive, const std::vector<std::uint32_t>& vertices, const glm::dmat4& world) {
        RawMesh& out = m_out.mesh;
        const auto triple = [](const GltfAccessor& accessor, std::uint32_t i) {
            return glm::dvec3(accessor.value(i, 0), accessor.value(i, 1), accessor.value(i, 2));
        };
        // Normals turn with the cofactors, which also do for mirrored and flattened transforms.
        const glm::dmat3 linear(world);
        const double sign = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
        const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]) * sign, glm::cross(linear[2], linear[0]) * sign,
                                  glm::cross(linear[0], linear[1]) * sign);
        const double most = static_cast<double>(std::numeric_limits<float>::max());
        for (const std::uint32_t vertex : vertices) {
            const glm::dvec4 moved = world * glm::dvec4(triple(primitive.positions, vertex), 1.0);
            glm::vec3 position(std::numeric_limits<float>::quiet_NaN());
            if (std::abs(moved.x) <= most && std::abs(moved.y) <= most && std::abs(moved.z) <= most) {
                position = glm::vec3(glm::dvec3(moved));
            }
            out.positions.push_back(position);
            glm::vec3 normal(0.0f);
            if (primitive.normals) {
                const glm::dvec3 turned = cofactor * triple(*primitive.normals, vertex);
                const double length = glm::length(turned);
                if (length > 0.0 && std::isfinite(length)) normal = glm::vec3(turned / length);
            }
            out.normals.push_back(normal);
        }
    }

    const tinygltf::Model& m_model;
    const std::string& m_name;
    Progress& m_progress;
    RawImport m_out;
    GltfMaterials m_materials;
    UniqueNames m_names;
    std::vector<std::uint64_t> m_trianglesOf;  ///< by mesh
    std::uint64_t m_sparse = 0;
    std::uint64_t m_notTriangles = 0;
    std::uint64_t m_withoutPositions = 0;
    std::uint64_t m_withoutUvs = 0;
    bool m_anyUv = false;
};

}  // namespace

Result<RawImport> readScene(const tinygltf::Model& model, const std::string& name, const ImportOptions& options,
                            Progress& progress) {
    return SceneReader(model, name, options, progress).read();
}

}  // namespace whorl::import
