// SPDX-License-Identifier: Apache-2.0
#include "core/io/mesh_import.h"

#include "core/io/image.h"
#include "core/io/import/raw_mesh.h"
#include "core/io/plain_text.h"
#include "core/io/safe_file.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>

namespace whorl {
namespace {

using namespace import;

// The format by the first bytes, by the suffix where those say nothing.
std::string formatOf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    const auto starts = [&](const char* magic) {
        const std::size_t length = std::strlen(magic);
        return bytes.size() >= length && std::memcmp(bytes.data(), magic, length) == 0;
    };
    if (starts("glTF")) return "glb";
    if (starts("ply\n") || starts("ply\r")) return "ply";
    std::string suffix = file.extension().string();
    for (char& c : suffix) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return suffix.empty() ? suffix : suffix.substr(1);
}

void decodeTextures(RawImport& raw, ImportedMesh& out, Progress& progress) {
    std::vector<std::string> failed;
    for (RawTexture& texture : raw.textures) {
        const bool used = std::any_of(out.mesh.parts.begin(), out.mesh.parts.end(),
                                      [&](const MeshPart& part) { return part.texture == texture.name; });
        if (!used || progress.cancelled()) continue;
        progress.report(0.9f, "Reading textures");
        auto map = readImage(texture.bytes, texture.source, ImageUse::Colour, &out.problems);
        texture.bytes = {};
        if (map) {
            out.textures.set(texture.name, std::move(*map));
        } else {
            out.problems.push_back(map.error().message);
            failed.push_back(texture.name);
        }
    }
    for (MeshPart& part : out.mesh.parts) {
        if (std::find(failed.begin(), failed.end(), part.texture) != failed.end()) part.texture.clear();
    }
}

Result<ImportedMesh> importAs(std::span<const std::uint8_t> bytes, const std::string& format, const std::string& name,
                              const Neighbours& neighbours, const ImportOptions& options, Progress& progress) {
    if (bytes.empty()) return meshError(name, "the file is empty");
    // Libraries may throw; what they throw stops here.
    try {
        Result<RawImport> raw = Error{};
        if (format == "glb" || format == "gltf" || format == "vrm") {
            raw = readGltf(bytes, name, neighbours, options, progress);
        } else if (format == "obj") {
            raw = readObj(bytes, name, neighbours, options, progress);
        } else if (format == "ply") {
            raw = readPly(bytes, name, progress);
        } else {
            return meshError(name, "meshes come as .gltf, .glb, .obj or .ply", "export the mesh as one of these");
        }
        if (!raw) return raw.error();
        ImportedMesh out;
        out.problems = std::move(raw->problems);
        out.sourceTriangles = static_cast<std::uint32_t>(std::min<std::uint64_t>(raw->sourceTriangles, 0xffffffffu));
        auto mesh = finishMesh(std::move(raw->mesh), name, out.problems, progress);
        if (!mesh) return mesh.error();
        out.mesh = std::move(*mesh);
        decodeTextures(*raw, out, progress);
        if (progress.cancelled()) return cancelledError();
        constexpr std::size_t most = 100;
        if (out.problems.size() > most) {
            const std::size_t more = out.problems.size() - most;
            out.problems.resize(most);
            out.problems.push_back(plainText(name) + ": " + counted(more, "more problem") + " of the same kinds.");
        }
        return out;
    } catch (const std::bad_alloc&) {
        return meshError(name, "there is not enough memory for it", "close other programs or reduce the mesh");
    } catch (const std::exception& exception) {
        return meshError(name, std::string("it is damaged (") + exception.what() + ")");
    }
}

}  // namespace

Result<ImportedMesh> importMesh(const std::filesystem::path& file, Progress& progress, const ImportOptions& options) {
    auto bytes = readFile(file, maxMeshFileBytes);
    if (!bytes) return bytes.error();
    return importAs(*bytes, formatOf(*bytes, file), file.filename().string(), Neighbours(file), options, progress);
}

Result<ImportedMesh> importMeshBytes(std::span<const std::uint8_t> bytes, const std::string& format, Progress& progress,
                                     const ImportOptions& options) {
    return importAs(bytes, format, "mesh." + format, Neighbours(), options, progress);
}

}  // namespace whorl
