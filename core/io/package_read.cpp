// SPDX-License-Identifier: Apache-2.0
// Packages as they are read: apart from their writing, so that what loads them needs no more than that.
#include "core/base/hash.h"
#include "core/io/groom_codec.h"
#include "core/io/guarded.h"
#include "core/io/json_text.h"
#include "core/io/package_files.h"
#include "core/io/safe_file.h"
#include "core/io/safe_folder.h"

#include <algorithm>

namespace whorl {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint64_t maxFile = std::uint64_t{16} << 30;

/// The text of groom.json as far as it can be checked alone.
Result<json> readManifest(const fs::path& folder) {
    const std::string name = (folder / packageManifest).string();
    const auto bytes = readPackageFile(folder, packageManifest, maxPackageManifest);
    if (!bytes) return bytes.error();
    auto manifest = parseJson({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, name);
    if (!manifest) return manifest;
    if (!manifest->is_object() || !manifest->contains("format") || (*manifest)["format"] != packageFormat)
        return Error{name + " is not that of a Whorl package."};
    std::string fault;
    ManifestReader reader(*manifest, name, fault);
    const std::uint64_t version = reader.number("version", UINT32_MAX);
    if (fault.empty() && version > packageVersion)
        return Error{folder.string() + " was exported by a newer Whorl (format " + std::to_string(version) +
                     "; this one reads up to " + std::to_string(packageVersion) + "). Open it with that version."};
    if (fault.empty() && version > 0 && version < packageVersionWithoutFrames)
        return Error{folder.string() +
                     " was exported by an older Whorl, whose hair had other roots. Export the package "
                     "again from its document."};
    const std::string checksum = reader.text("checksum");
    if (fault.empty() && (version == 0 || checksum != packageChecksum(*manifest)))
        fault = name + " was changed or damaged: its checksum is wrong. Export the package again.";
    if (!fault.empty()) return Error{fault};
    return manifest;
}

}  // namespace

namespace {

bool framesFromJson(const json& entry, PackageFrames& frames) {
    const auto whole = [&](const char* key) {
        return entry.contains(key) && entry[key].is_number_integer() && entry[key] >= -1000000 && entry[key] <= 1000000;
    };
    if (!whole("first") || !whole("last") || !entry.contains("per_second") || !entry["per_second"].is_number())
        return false;
    frames = {entry["first"].get<int>(), entry["last"].get<int>(), entry["per_second"].get<double>()};
    return areFrames(frames);
}

}  // namespace

Result<Package> readPackage(const fs::path& folder, Progress& progress) {
    const auto manifest = readManifest(folder);
    if (!manifest) return manifest.error();
    const std::string name = (folder / packageManifest).string();
    Package package;
    reportUnknownKeys(*manifest,
                      {"format", "version", "checksum", "shared", "parts", "digest", "groups", "counts", "frames"},
                      name, package.problems);
    std::string fault;
    ManifestReader reader(*manifest, name, fault);
    package.digest = std::strtoull(reader.text("digest").c_str(), nullptr, 16);
    if (reader.number("version", packageVersion) > packageVersionWithoutFrames) {
        if (const json* frames = reader.object("frames");
            frames && !framesFromJson(*frames, package.frames) && fault.empty())
            fault = name + " has no right frames.";
    }
    const json* shared = reader.object("shared");
    const json* parts = reader.array("parts");
    if (!fault.empty()) return Error{fault};
    ManifestReader sharedReader(*shared, name + ", shared", fault);
    const std::uint64_t sharedSize = sharedReader.number("bytes", maxFile);
    const std::string sharedDigest = sharedReader.text("digest");
    if (fault.empty() && sharedReader.text("file") != packageShared)
        fault = name + " names a shared file that no package has.";
    if (fault.empty() && (parts->empty() || parts->size() > maxPackageParts))
        fault = name + " names " + std::to_string(parts->size()) + " parts; a package has 1 to 4096.";
    if (!fault.empty()) return Error{fault};

    const auto bytes = readPackageFile(folder, packageShared, maxFile);
    if (!bytes) return bytes.error();
    if (bytes->size() != sharedSize || hexDigest(hashBytes(bytes->data(), bytes->size())) != sharedDigest)
        return Error{(folder / packageShared).string() + " is broken or of another package. Export the package again."};
    auto opened = groomFromShared(*bytes, *manifest, (folder / packageShared).string(), progress);
    if (!opened) return opened.error();
    package.groom = std::move(opened->groom);
    package.problems.insert(package.problems.end(), opened->problems.begin(), opened->problems.end());

    const auto count = static_cast<std::uint32_t>(parts->size());
    for (std::uint32_t i = 0; i < count; ++i) {
        if (progress.cancelled()) return cancelledError();
        ManifestReader entry((*parts)[i], name + ", part " + std::to_string(i), fault);
        const std::string file = entry.text("file");
        const std::uint64_t size = entry.number("bytes", maxFile);
        if (!fault.empty()) return Error{fault};
        if (file != packagePartName(i)) return Error{name + " names a part that no package has."};
        const auto stored = readPackageFile(folder, file, maxFile);
        if (!stored) return stored.error();
        auto part = partFromBytes(*stored, (folder / file).string(), progress);
        if (!part) return part.error();
        part->file = file;
        part->bytes = stored->size();
        std::uint64_t hairs = 0;
        for (const std::uint32_t onTriangle : part->triangleHairs) hairs += onTriangle;
        const bool onMesh = std::all_of(part->triangles.begin(), part->triangles.end(), [&](std::uint32_t triangle) {
            return triangle < package.groom.mesh->triangleCount();
        });
        // Parts cover the surface one after another.
        const std::uint32_t first = i > 0 ? package.parts.back().range.last : 0;
        const bool covers = part->range.first == first && part->range.last >= first &&
                            (i + 1 < count || part->range.last == SurfaceCurve::end) &&
                            part->asked == static_cast<std::uint64_t>(std::max(package.groom.counts->hairs, 0));
        if (part->bytes != size || part->frameBounds.size() != package.frames.count() ||
            partToJson(*part) != (*parts)[i] || !covers || hairs != part->hairs || !onMesh)
            return Error{(folder / file).string() + " does not fit " + packageManifest + ". Export the package again."};
        package.parts.push_back(std::move(*part));
    }
    return package;
}

Result<Package> openPackage(const fs::path& folder, Progress& progress) {
    const std::string name = folder.string();
    return guarded(name, [&]() -> Result<Package> {
        restoreFolder(folder);
        std::error_code error;
        if (!fs::is_directory(folder, error))
            return Error{name + " is not a Whorl package: a package is a folder with " + packageManifest + " in it."};
        return readPackage(folder, progress);
    });
}

bool isPackage(const fs::path& folder) {
    std::error_code error;
    restoreFolder(folder);
    if (!fs::is_directory(folder, error)) return false;
    const auto start = readFileStart(folder / packageManifest, std::size_t{64} << 10);
    if (!start) return false;
    const std::string_view text(reinterpret_cast<const char*>(start->data()), start->size());
    return text.starts_with("{") && text.find("\"whorl-package\"") != std::string_view::npos;
}

}  // namespace whorl
