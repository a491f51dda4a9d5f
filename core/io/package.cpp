// SPDX-License-Identifier: Apache-2.0
#include "core/io/package.h"

#include "core/base/hash.h"
#include "core/hair/generate.h"
#include "core/io/groom_codec.h"
#include "core/io/guarded.h"
#include "core/io/json_text.h"
#include "core/io/package_files.h"
#include "core/io/safe_file.h"
#include "core/io/safe_folder.h"

#include <algorithm>
#include <map>
#include <memory>

namespace whorl {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* formatName = "whorl-package";
// 1 had ranges of hairs instead of the surface.
constexpr std::uint64_t formatVersion = 2;
constexpr std::uint64_t maxManifest = std::uint64_t{16} << 20;
constexpr std::uint64_t maxFile = std::uint64_t{16} << 30;
constexpr std::uint32_t blockHairs = 1u << 14;

std::string checksumOf(json manifest) {
    manifest.erase("checksum");
    const std::string text = jsonText(manifest);
    return hexDigest(hashBytes(text.data(), text.size()));
}

/// Generates part `number` for its box, numbers and digests, without keeping its hair.
Result<PackagePart> surveyPart(Generator& generator, const Groom& groom, std::uint32_t number, std::uint32_t count,
                               Hasher& all, Progress& progress) {
    // The share of this part in the whole; reports pass on the wish to stop as well.
    Progress share;
    const std::string text = "Writing part " + std::to_string(number + 1) + " of " + std::to_string(count);
    Hasher own;
    PackagePart part;
    std::map<std::uint32_t, std::uint32_t> triangles;
    const auto range = generator.rangeOfPart(groom, number, count, share);
    if (!range) return range.error();
    part.file = packagePartName(number);
    part.range = *range;
    part.asked = static_cast<std::uint64_t>(std::max(groom.counts->hairs, 0));
    const auto made = generator.stream(
        groom, {.part = number, .partCount = count}, blockHairs,
        [&](const Strands& block) {
            block.addTo(own);
            block.addTo(all);
            part.bounds.add(block.bounds());
            part.hairs += block.count();
            part.vertices += block.vertexCount();
            for (const SurfacePoint& root : block.roots) ++triangles[root.triangle];
            const double expected = static_cast<double>(std::max(groom.counts->hairs, 1)) / static_cast<double>(count);
            const float within = std::min(static_cast<float>(static_cast<double>(part.hairs) / expected), 1.0f);
            progress.report(0.5f * (static_cast<float>(number) + within) / static_cast<float>(count), text);
            return !progress.cancelled();
        },
        share);
    if (!made) return made.error();
    part.digest = own.digest();
    for (const auto& [triangle, hairs] : triangles) {
        part.triangles.push_back(triangle);
        part.triangleHairs.push_back(hairs);
    }
    return part;
}

json partToJson(const PackagePart& part) {
    return {{"file", part.file},
            {"first_unit", part.range.first},
            {"last_unit", part.range.last},
            {"asked", part.asked},
            {"hairs", part.hairs},
            {"vertices", part.vertices},
            {"bounds", boundsToJson(part.bounds)},
            {"bytes", part.bytes},
            {"digest", hexDigest(part.digest)}};
}

/// All files, groom.json last.
Result<std::uint64_t> writeFiles(const Groom& groom, const fs::path& folder, std::uint32_t parts, Progress& progress,
                                 std::shared_ptr<const Surface> surface) {
    json manifest{{"format", formatName}, {"version", formatVersion}};
    Progress silent;
    auto shared = sharedBytes(groom, manifest, progress);
    if (!shared) return shared.error();
    if (auto done = writePackageFile(folder, packageShared, *shared, progress); !done) return done.error();
    manifest["shared"] = {{"file", packageShared},
                          {"bytes", shared->size()},
                          {"digest", hexDigest(hashBytes(shared->data(), shared->size()))}};
    *shared = {};

    Generator generator;
    generator.setSurface(std::move(surface));
    Hasher all;
    json list = json::array();
    for (std::uint32_t i = 0; i < parts; ++i) {
        auto part = surveyPart(generator, groom, i, parts, all, progress);
        if (!part) return part.error();
        const auto bytes = partBytes(*part, silent);
        if (!bytes) return bytes.error();
        const auto written = writePackageFile(folder, part->file, *bytes, progress);
        if (!written) return written.error();
        part->bytes = *written;
        list.push_back(partToJson(*part));
    }
    manifest["parts"] = std::move(list);
    manifest["digest"] = hexDigest(all.digest());
    manifest["checksum"] = checksumOf(manifest);
    const std::string text = jsonText(manifest, 1) + "\n";
    if (text.size() > maxManifest) return Error{folder.string() + ": there are too many names and parameters."};
    const auto written = writePackageFile(folder, packageManifest, {text.begin(), text.end()}, progress);
    if (!written) return written.error();
    return all.digest();
}

/// A sentence when `folder` holds anything that is not of a package: replacing it would lose that.
Result<void> checkReplaceable(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) return {};
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!isPackageFileName(name) || !entry->is_regular_file(error))
            return Error{folder.string() + " holds " + name +
                         ", which is not of a package and would be lost. Move it away or choose another name."};
    }
    return {};
}

/// The text of groom.json as far as it can be checked alone.
Result<json> readManifest(const fs::path& folder) {
    const std::string name = (folder / packageManifest).string();
    const auto bytes = readPackageFile(folder, packageManifest, maxManifest);
    if (!bytes) return bytes.error();
    auto manifest = parseJson({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, name);
    if (!manifest) return manifest;
    if (!manifest->is_object() || !manifest->contains("format") || (*manifest)["format"] != formatName)
        return Error{name + " is not that of a Whorl package."};
    std::string fault;
    ManifestReader reader(*manifest, name, fault);
    const std::uint64_t version = reader.number("version", UINT32_MAX);
    if (fault.empty() && version > formatVersion)
        return Error{folder.string() + " was exported by a newer Whorl (format " + std::to_string(version) +
                     "; this one reads up to " + std::to_string(formatVersion) + "). Open it with that version."};
    if (fault.empty() && version > 0 && version < formatVersion)
        return Error{folder.string() +
                     " was exported by an older Whorl, whose hair had other roots. Export the package "
                     "again from its document."};
    const std::string checksum = reader.text("checksum");
    if (fault.empty() && (version == 0 || checksum != checksumOf(*manifest)))
        fault = name + " was changed or damaged: its checksum is wrong. Export the package again.";
    if (!fault.empty()) return Error{fault};
    return manifest;
}

Result<Package> readPackage(const fs::path& folder, Progress& progress) {
    const auto manifest = readManifest(folder);
    if (!manifest) return manifest.error();
    const std::string name = (folder / packageManifest).string();
    Package package;
    reportUnknownKeys(*manifest, {"format", "version", "checksum", "shared", "parts", "digest", "groups", "counts"},
                      name, package.problems);
    std::string fault;
    ManifestReader reader(*manifest, name, fault);
    package.digest = std::strtoull(reader.text("digest").c_str(), nullptr, 16);
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
        if (part->bytes != size || partToJson(*part) != (*parts)[i] || !covers || hairs != part->hairs || !onMesh)
            return Error{(folder / file).string() + " does not fit " + packageManifest + ". Export the package again."};
        package.parts.push_back(std::move(*part));
    }
    return package;
}

/// True when nothing that generation asks differs.
bool sameMesh(const SurfaceMesh& a, const SurfaceMesh& b) {
    const auto samePart = [](const MeshPart& x, const MeshPart& y) {
        return x.firstTriangle == y.firstTriangle && x.triangleCount == y.triangleCount && x.name == y.name;
    };
    return a.positions == b.positions && a.normals == b.normals && a.triangles == b.triangles &&
           a.cornerUvs == b.cornerUvs && std::ranges::equal(a.parts, b.parts, samePart);
}

Result<void> writeAndCheck(const Groom& groom, const fs::path& folder, std::uint32_t parts, Progress& progress,
                           std::shared_ptr<const Surface> surface) {
    if (!surface) surface = std::make_shared<const Surface>(groom.mesh);
    if (auto free = checkReplaceable(folder); !free) return free;
    auto safe = SafeFolder::create(folder);
    if (!safe) return safe.error();
    const auto digest = writeFiles(groom, safe->path(), parts, progress, surface);
    if (!digest) return digest.error();

    progress.report(0.5f, "Checking the package");
    auto back = readPackage(safe->path(), progress);
    if (!back) return back.error();
    // The same mesh has the same distance field, which takes long to make.
    const bool kept = sameMesh(*groom.mesh, *back->groom.mesh);
    if (kept) back->groom.mesh = groom.mesh;
    const auto again = hairDigest(back->groom, parts, std::nullopt, progress, kept ? surface : nullptr);
    if (!again) return again.error();
    if (*again != *digest || back->digest != *digest) {
        std::string why = back->problems.empty() ? std::string() : " " + back->problems.front();
        return Error{folder.string() + " was not exported: the package would give other hair than the groom." + why};
    }
    if (progress.cancelled()) return cancelledError();
    if (auto done = safe->commit(); !done) return done;
    progress.report(1.0f, "Exported");
    return {};
}

}  // namespace

Result<void> exportPackage(const Groom& groom, const fs::path& folder, std::uint32_t parts, Progress& progress,
                           std::shared_ptr<const Surface> surface) {
    const std::string name = folder.string();
    if (parts == 0) parts = static_cast<std::uint32_t>(std::max(groom.counts->parts, 1));
    if (parts > maxPackageParts)
        return Error{name + ": " + std::to_string(parts) + " parts are too many; the most is 4096."};
    return guarded(name, [&] { return writeAndCheck(groom, folder, parts, progress, std::move(surface)); });
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
