// SPDX-License-Identifier: Apache-2.0
#include "core/io/package.h"

#include "core/base/hash.h"
#include "core/hair/changes.h"
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

constexpr std::uint32_t blockHairs = 1u << 14;

/// Boxes of a part at each frame.
Result<std::vector<Bounds>> surveyFrames(Generator& generator, const Groom& groom, const PackagePart& part,
                                         const GenerateOptions& still, const PackageFrames& frames,
                                         const std::function<bool(float done)>& report) {
    std::vector<Bounds> boxes(frames.count(), part.bounds);
    Progress share;
    for (std::size_t i = 0; isAnimated(groom) && i < boxes.size(); ++i) {
        GenerateOptions options = still;
        options.time = frames.timeOf(frames.first + static_cast<int>(i));
        boxes[i] = {};
        const float done = static_cast<float>(i) / static_cast<float>(boxes.size());
        const auto made = generator.stream(
            groom, options, blockHairs,
            [&](const Strands& block) {
                boxes[i].add(block.bounds());
                return report(done);
            },
            share);
        if (!made) return made.error();
    }
    return boxes;
}

/// Generates part `number` for its boxes, numbers and digests, without keeping its hair.
Result<PackagePart> surveyPart(Generator& generator, const Groom& groom, std::uint32_t number, std::uint32_t count,
                               const PackageFrames& frames, Hasher& all, Progress& progress) {
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
    // Frames take as long as the part itself, each.
    const float frameShare = isAnimated(groom) ? static_cast<float>(frames.count()) : 0.0f;
    const auto report = [&](float done) {
        const float within = done / (1.0f + frameShare);
        progress.report(0.5f * (static_cast<float>(number) + within) / static_cast<float>(count), text);
        return !progress.cancelled();
    };
    const GenerateOptions options{.part = number, .partCount = count};
    const auto made = generator.stream(
        groom, options, blockHairs,
        [&](const Strands& block) {
            block.addTo(own);
            block.addTo(all);
            part.bounds.add(block.bounds());
            part.hairs += block.count();
            part.vertices += block.vertexCount();
            for (const SurfacePoint& root : block.roots) ++triangles[root.triangle];
            const double expected = static_cast<double>(std::max(groom.counts->hairs, 1)) / static_cast<double>(count);
            return report(std::min(static_cast<float>(static_cast<double>(part.hairs) / expected), 1.0f));
        },
        share);
    if (!made) return made.error();
    part.digest = own.digest();
    auto boxes = surveyFrames(generator, groom, part, options, frames,
                              [&](float done) { return report(1.0f + done * frameShare); });
    if (!boxes) return boxes.error();
    part.frameBounds = std::move(*boxes);
    for (const auto& [triangle, hairs] : triangles) {
        part.triangles.push_back(triangle);
        part.triangleHairs.push_back(hairs);
    }
    return part;
}

/// All files, groom.json last.
Result<std::uint64_t> writeFiles(const Groom& groom, const fs::path& folder, std::uint32_t parts, Progress& progress,
                                 std::shared_ptr<const Surface> surface, const PackageFrames& frames,
                                 const std::string& name) {
    json manifest{{"format", packageFormat},
                  {"version", frames.empty() ? packageVersionWithoutFrames : packageVersion}};
    if (!frames.empty())
        manifest["frames"] = {{"first", frames.first}, {"last", frames.last}, {"per_second", frames.perSecond}};
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
    std::vector<PackagePart> surveyed;
    for (std::uint32_t i = 0; i < parts; ++i) {
        auto part = surveyPart(generator, groom, i, parts, frames, all, progress);
        if (!part) return part.error();
        const auto bytes = partBytes(*part, silent);
        if (!bytes) return bytes.error();
        const auto written = writePackageFile(folder, part->file, *bytes, progress);
        if (!written) return written.error();
        part->bytes = *written;
        list.push_back(partToJson(*part));
        surveyed.push_back(std::move(*part));
    }
    const std::string rib = packageRibText(name, surveyed, frames);
    if (auto done = writePackageFile(folder, packageRib, {rib.begin(), rib.end()}, progress); !done)
        return done.error();
    manifest["parts"] = std::move(list);
    manifest["digest"] = hexDigest(all.digest());
    manifest["checksum"] = packageChecksum(manifest);
    const std::string text = jsonText(manifest, 1) + "\n";
    if (text.size() > maxPackageManifest) return Error{folder.string() + ": there are too many names and parameters."};
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

/// True when nothing that generation asks differs.
bool sameMesh(const SurfaceMesh& a, const SurfaceMesh& b) {
    const auto samePart = [](const MeshPart& x, const MeshPart& y) {
        return x.firstTriangle == y.firstTriangle && x.triangleCount == y.triangleCount && x.name == y.name;
    };
    return a.positions == b.positions && a.normals == b.normals && a.triangles == b.triangles &&
           a.cornerUvs == b.cornerUvs && std::ranges::equal(a.parts, b.parts, samePart);
}

Result<void> writeAndCheck(const Groom& groom, const fs::path& folder, std::uint32_t parts, Progress& progress,
                           std::shared_ptr<const Surface> surface, const PackageFrames& frames) {
    if (!surface) surface = std::make_shared<const Surface>(groom.mesh);
    if (auto free = checkReplaceable(folder); !free) return free;
    auto safe = SafeFolder::create(folder);
    if (!safe) return safe.error();
    const fs::path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
    const auto digest = writeFiles(groom, safe->path(), parts, progress, surface, frames, name.string());
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
                           std::shared_ptr<const Surface> surface, const PackageFrames& frames) {
    const std::string name = folder.string();
    if (parts == 0) parts = static_cast<std::uint32_t>(std::max(groom.counts->parts, 1));
    if (parts > maxPackageParts)
        return Error{name + ": " + std::to_string(parts) + " parts are too many; the most is 4096."};
    if (!frames.empty() && !areFrames(frames))
        return Error{name + ": at most 10,000 frames can be exported, at a speed from 0.001 to 10,000 a second."};
    return guarded(name, [&] { return writeAndCheck(groom, folder, parts, progress, std::move(surface), frames); });
}

}  // namespace whorl
