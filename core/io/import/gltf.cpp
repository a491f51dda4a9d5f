// SPDX-License-Identifier: Apache-2.0
// glTF and GLB: tinygltf parses, everything that it hands over is checked before it is read.
#include "core/io/import/gltf_container.h"
#include "core/io/import/gltf_scene.h"
#include "core/io/plain_text.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include <cmath>

namespace whorl::import {
namespace {

// tinygltf asks for every file beside the mesh through these; nothing else reaches the disk.
struct FileAccess {
    const Neighbours* neighbours = nullptr;
    std::uint64_t bytesLeft = maxMeshFileBytes;
    std::string refusal{};  ///< why the last file was not read
};

bool fileExists(const std::string& path, void* user) {
    auto& access = *static_cast<FileAccess*>(user);
    const auto found = access.neighbours->find(path);
    if (!found) access.refusal = "the file " + plainText(path, 60) + " is not read: " + found.error().message;
    return found.ok();
}

std::string sameName(const std::string& path, void*) {
    return path;
}

bool readNeighbour(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* user) {
    auto& access = *static_cast<FileAccess*>(user);
    auto bytes = access.neighbours->read(path, access.bytesLeft);
    if (bytes && bytes->empty()) bytes = Error{"it is empty"};
    if (!bytes) {
        access.refusal = "the file " + plainText(path, 60) + " is not read: " + bytes.error().message;
        if (error != nullptr) *error += access.refusal;
        return false;
    }
    access.bytesLeft -= bytes->size();
    *out = std::move(*bytes);
    return true;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// Keeps images encoded. The pointer for images in buffer views was not checked by tinygltf and is not touched.
bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

// Why tinygltf gave up, in words for the artist.
std::string parseFailure(std::string_view json, const std::string& error, const FileAccess& access) {
    const auto parsed = nlohmann::json::parse(json, nullptr, false);
    if (parsed.is_object() && parsed.contains("extensionsRequired") && parsed["extensionsRequired"].is_array()) {
        for (const auto& extension : parsed["extensionsRequired"]) {
            if (extension.is_string() && !knownExtension(extension.get<std::string>())) {
                return "it needs the extension " + extension.get<std::string>() + ", which is not read";
            }
        }
    }
    if (!access.refusal.empty()) return access.refusal;
    const std::string line = error.substr(0, error.find('\n'));
    return line.empty() ? "it is no valid glTF" : "it is no valid glTF (" + line + ")";
}

}  // namespace

Result<RawImport> readGltf(std::span<const std::uint8_t> bytes, const std::string& name, const Neighbours& neighbours,
                           const ImportOptions& options, Progress& progress) {
    progress.report(0.1f, "Reading the mesh");
    const auto container = openContainer(bytes);
    if (!container) return meshError(name, container.error().message);

    FileAccess access{&neighbours};
    tinygltf::FsCallbacks files{};
    files.FileExists = fileExists;
    files.ExpandFilePath = sameName;
    files.ReadWholeFile = readNeighbour;
    files.WriteWholeFile = writeNothing;
    files.user_data = &access;
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(files);
    loader.SetImageLoader(keepEncoded, nullptr);

    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool loaded =
        container->binary
            ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                          static_cast<unsigned>(container->usedBytes), "", tinygltf::NO_REQUIRE)
            : loader.LoadASCIIFromString(&model, &error, &warning, container->json.data(),
                                         static_cast<unsigned>(container->json.size()), "", tinygltf::NO_REQUIRE);
    if (!loaded || !error.empty()) return meshError(name, parseFailure(container->json, error, access));
    if (progress.cancelled()) return cancelledError();
    for (const std::string& extension : model.extensionsRequired) {
        if (!knownExtension(extension)) {
            return meshError(name, "it needs the extension " + extension + ", which is not read",
                             "export the mesh again without it");
        }
    }
    return readScene(model, name, options, progress);
}

}  // namespace whorl::import
