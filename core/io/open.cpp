// SPDX-License-Identifier: Apache-2.0
#include "core/io/open.h"

#include "core/io/guarded.h"
#include "core/io/mesh_import.h"
#include "core/io/package.h"
#include "core/io/safe_file.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace whorl {
namespace {

std::string suffixOf(const std::filesystem::path& file) {
    std::string suffix = file.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

/// OBJ has no mark of its own: a line that starts as a vertex does, in text.
bool looksLikeObj(std::string_view text) {
    if (text.find('\0') != std::string_view::npos) return false;
    for (std::size_t line = 0; line < text.size();) {
        const std::string_view rest = text.substr(line);
        if (rest.starts_with("v ") || rest.starts_with("v\t")) return true;
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) break;
        line += end + 1;
    }
    return false;
}

bool looksLikeGltf(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{' && text.find("\"asset\"") != std::string_view::npos;
}

FileKind kindOf(const std::filesystem::path& file) {
    std::error_code error;
    if (isPackage(file)) return FileKind::Package;
    if (std::filesystem::is_directory(file, error)) return FileKind::Unknown;
    const auto start = readFileStart(file, std::size_t{64} << 10);
    if (!start) return FileKind::Unknown;
    const std::string_view text(reinterpret_cast<const char*>(start->data()), start->size());
    if (text.starts_with("WHORLDOC")) return FileKind::Document;
    if (text.starts_with("glTF") || text.starts_with("ply\n") || text.starts_with("ply\r")) return FileKind::Mesh;
    if (text.starts_with("HAIR")) return FileKind::HairCurves;
    if (looksLikeGltf(text) || looksLikeObj(text)) return FileKind::Mesh;
    // Nothing to go by in the first bytes (long comments, large glTF buffers first): believe the name.
    const std::string suffix = suffixOf(file);
    if (suffix == ".gltf" && text.find('{') != std::string_view::npos) return FileKind::Mesh;
    if (suffix == ".obj" && !text.empty() && text.find('\0') == std::string_view::npos) return FileKind::Mesh;
    return FileKind::Unknown;
}

Result<OpenedDocument> openMesh(const std::filesystem::path& file, Progress& progress) {
    auto imported = importMesh(file, progress);
    if (!imported) return imported.error();
    OpenedDocument opened;
    opened.groom = makeGroom(std::move(imported->mesh));
    opened.groom.maps = std::move(imported->textures);
    opened.problems = std::move(imported->problems);
    return opened;
}

}  // namespace

FileKind fileKind(const std::filesystem::path& file) {
    try {
        return kindOf(file);
    } catch (const std::exception&) {
        return FileKind::Unknown;
    }
}

Result<OpenedDocument> openGroom(const std::filesystem::path& file, Progress& progress) {
    const std::string name = file.string();
    return guarded(name, [&]() -> Result<OpenedDocument> {
        switch (fileKind(file)) {
            case FileKind::Document:
                return openDocument(file, progress);
            case FileKind::Mesh:
                return openMesh(file, progress);
            case FileKind::Package: {
                auto package = openPackage(file, progress);
                if (!package) return package.error();
                return OpenedDocument{std::move(package->groom), std::move(package->problems)};
            }
            case FileKind::HairCurves:
                return Error{name + " holds only hair curves. Open the head that they grow on, then import them."};
            case FileKind::Unknown:
                break;
        }
        std::error_code error;
        if (std::filesystem::is_directory(file, error))
            return Error{name + " is a folder without a Whorl package in it. Open a .groom folder or a file."};
        if (auto start = readFileStart(file, 1); !start) return start.error();
        return Error{name +
                     " is none of the files that start a groom. Open a .whorl document, a .groom package, or a "
                     "mesh (.gltf, .glb, .obj, .ply)."};
    });
}

}  // namespace whorl
