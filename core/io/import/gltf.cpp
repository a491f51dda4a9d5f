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
    // tinygltf tries the name as it is and then behind "./"; the first try has the reason that helps.
    if (!found && path.substr(0, 2) != "./")
        access.refusal = "the file " + plainText(path, 60) + " is not read: " + found.error().message;
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

// A GLB with other JSON, padded as the format asks.
std::vector<std::uint8_t> repack(std::string json, std::span<const std::uint8_t> chunksAfterJson) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<std::uint8_t> out;
    out.reserve(20 + json.size() + chunksAfterJson.size());
    const auto word = [&](std::uint64_t value) {
        for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    };
    word(0x46546c67);
    word(2);
    word(20 + json.size() + chunksAfterJson.size());
    word(json.size());
    word(0x4e4f534a);
    out.insert(out.end(), json.begin(), json.end());
    out.insert(out.end(), chunksAfterJson.begin(), chunksAfterJson.end());
    return out;
}

// tinygltf refuses the whole file for one fault in a part that a groom does not need. Tried in this order: everything;
// without movement and cameras; without images too.
class Loader {
public:
    Loader(const GltfContainer& container, std::span<const std::uint8_t> bytes, FileAccess& access)
        : m_container(container), m_bytes(bytes), m_access(access) {}

    bool load(tinygltf::Model& model, Problems& problems, const std::string& name) {
        if (parse(model, m_bytes, m_container.json)) return true;
        const std::string firstError = error;
        auto json = nlohmann::json::parse(m_container.json, nullptr, false);
        if (!json.is_object()) return false;
        for (const char* key : {"animations", "skins", "cameras"}) json.erase(key);
        if (parseReduced(model, json)) return true;
        for (const char* key : {"images", "textures", "samplers"}) json.erase(key);
        if (parseReduced(model, json)) {
            problems.push_back(plainText(name) + ": its images are damaged (" + plainText(firstError, 200) +
                               "), so it has no textures.");
            return true;
        }
        error = firstError;
        return false;
    }

    std::string error;  ///< first line of what tinygltf said

private:
    bool parseReduced(tinygltf::Model& model, const nlohmann::json& json) {
        const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        if (!m_container.binary) return parse(model, {}, text);
        const auto rest = m_bytes.first(m_container.usedBytes).subspan(20 + m_container.json.size());
        return parse(model, repack(text, rest), text);
    }

    bool parse(tinygltf::Model& model, std::span<const std::uint8_t> glb, std::string_view json) {
        if (json.size() > 0xffffffffu || glb.size() > 0xffffffffu) {
            error = "it is larger than 4 GiB";
            return false;
        }
        tinygltf::FsCallbacks files{};
        files.FileExists = fileExists;
        files.ExpandFilePath = sameName;
        files.ReadWholeFile = readNeighbour;
        files.WriteWholeFile = writeNothing;
        files.user_data = &m_access;
        tinygltf::TinyGLTF loader;
        loader.SetFsCallbacks(files);
        loader.SetImageLoader(keepEncoded, nullptr);
        m_access.bytesLeft = maxMeshFileBytes;
        model = {};
        error.clear();
        std::string warning;
        const bool loaded = m_container.binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, glb.data(),
                                                                             glbBytes(glb), "", tinygltf::NO_REQUIRE)
                                               : loader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                                                            static_cast<unsigned>(json.size()), "",
                                                                            tinygltf::NO_REQUIRE);
        const bool good = loaded && error.empty();
        error.resize(std::min(error.find('\n'), error.size()));
        return good;
    }

    // What lies behind the end that the header names is no part of the file.
    static unsigned glbBytes(std::span<const std::uint8_t> glb) {
        return glb[8] | (unsigned{glb[9]} << 8) | (unsigned{glb[10]} << 16) | (unsigned{glb[11]} << 24);
    }

    const GltfContainer& m_container;
    std::span<const std::uint8_t> m_bytes;
    FileAccess& m_access;
};

// Why tinygltf gave up, in words for the artist.
std::string parseFailure(std::string_view json, const std::string& error, const FileAccess& access) {
    const auto parsed = nlohmann::json::parse(json, nullptr, false);
    for (const char* key : {"extensionsRequired", "extensionsUsed"}) {
        if (!parsed.is_object() || !parsed.contains(key) || !parsed[key].is_array()) continue;
        for (const auto& extension : parsed[key]) {
            if (extension.is_string() && !knownExtension(extension.get<std::string>())) {
                return "it needs the extension " + extension.get<std::string>() + ", which is not read";
            }
        }
        if (!access.refusal.empty()) break;
    }
    if (!access.refusal.empty()) return access.refusal;
    return error.empty() ? "it is no valid glTF" : "it is no valid glTF (" + error + ")";
}

}  // namespace

Result<RawImport> readGltf(std::span<const std::uint8_t> bytes, const std::string& name, const Neighbours& neighbours,
                           const ImportOptions& options, Progress& progress) {
    progress.report(0.1f, "Reading the mesh");
    const auto container = openContainer(bytes);
    if (!container) return meshError(name, container.error().message);

    FileAccess access{&neighbours};
    Loader loader(*container, bytes, access);
    tinygltf::Model model;
    Problems problems;
    if (!loader.load(model, problems, name)) {
        return meshError(name, parseFailure(container->json, loader.error, access));
    }
    if (progress.cancelled()) return cancelledError();
    for (const std::string& extension : model.extensionsRequired) {
        if (!knownExtension(extension)) {
            return meshError(name, "it needs the extension " + extension + ", which is not read",
                             "export the mesh again without it");
        }
    }
    auto scene = readScene(model, name, options, progress);
    if (scene) scene->problems.insert(scene->problems.begin(), problems.begin(), problems.end());
    return scene;
}

}  // namespace whorl::import
