// SPDX-License-Identifier: Apache-2.0
#include "core/io/package_files.h"

#include "core/base/hash.h"
#include "core/io/container.h"
#include "core/io/groom_codec.h"
#include "core/io/json_text.h"
#include "core/io/safe_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace whorl {
namespace {

using nlohmann::json;

constexpr ContainerKind sharedKind{"WHORLSHR", 1, "the shared file of a Whorl package"};
constexpr ContainerKind partKind{"WHORLPRT", 1, "a part of a Whorl package"};

std::uint64_t digestFromText(const std::string& text) {
    return std::strtoull(text.c_str(), nullptr, 16);
}

static_assert(sizeof(Bounds) == 24, "stored as it is");

/// True for the empty box and those with finite corners in order.
bool isBox(const Bounds& bounds) {
    const Bounds none;
    if (bounds.min == none.min && bounds.max == none.max) return true;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = bounds.min[axis], high = bounds.max[axis];
        if (!std::isfinite(low) || !std::isfinite(high) || low > high) return false;
    }
    return true;
}

}  // namespace

std::string packageChecksum(json manifest) {
    manifest.erase("checksum");
    const std::string text = jsonText(manifest);
    return hexDigest(hashBytes(text.data(), text.size()));
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

bool areFrames(const PackageFrames& frames) {
    constexpr int farthest = 1000000;
    return !frames.empty() && frames.first >= -farthest && frames.last <= farthest &&
           frames.count() <= PackageFrames::most && frames.perSecond >= 1e-3 && frames.perSecond <= 1e4;
}

std::string packagePartName(std::uint32_t part) {
    char name[24];
    std::snprintf(name, sizeof name, "part-%04u.bin", part);
    return name;
}

bool isPackageFileName(const std::string& name) {
    const bool digits = name.size() == 13 &&
                        std::all_of(name.begin() + 5, name.begin() + 9, [](char c) { return c >= '0' && c <= '9'; });
    return name == packageManifest || name == packageShared || name == packageRib ||
           (digits && name.starts_with("part-") && name.ends_with(".bin"));
}

Result<std::vector<std::uint8_t>> readPackageFile(const std::filesystem::path& folder, const std::string& name,
                                                  std::uint64_t maxBytes) {
    const std::filesystem::path file = folder / name;
    std::error_code error;
    const auto type = std::filesystem::symlink_status(file, error).type();
    if (type == std::filesystem::file_type::not_found)
        return Error{folder.string() + " is not complete: " + name + " is missing. Export it again."};
    if (type != std::filesystem::file_type::regular)
        return Error{folder.string() + " is broken: " + name + " is a link or no file. Export it again."};
    return readFile(file, maxBytes);
}

Result<std::uint64_t> writePackageFile(const std::filesystem::path& folder, const std::string& name,
                                       const std::vector<std::uint8_t>& bytes, Progress& progress) {
    auto safe = SafeFile::create(folder / name);
    if (!safe) return safe.error();
    constexpr std::size_t step = std::size_t{16} << 20;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
        if (progress.cancelled()) return cancelledError();
        if (auto done = safe->write(bytes.data() + at, std::min(step, bytes.size() - at)); !done) return done.error();
    }
    if (auto done = safe->commit(); !done) return done.error();
    return std::uint64_t{bytes.size()};
}

Result<std::vector<std::uint8_t>> sharedBytes(const Groom& groom, json& parameters, Progress& progress) {
    ContainerWriter writer;
    // A renderer makes hair from guides: what only led to them stays at home.
    Groom shared = groom;
    shared.strokes = {};
    shared.setDefaults();
    json manifest = encodeGroom(shared, writer);
    for (const char* key : {"groups", "counts"}) {
        parameters[key] = std::move(manifest[key]);
        manifest.erase(key);
    }
    return writer.finish(sharedKind, jsonText(manifest), progress);
}

Result<OpenedDocument> groomFromShared(std::span<const std::uint8_t> bytes, const json& parameters,
                                       const std::string& name, Progress& progress) {
    auto container = Container::read(bytes, sharedKind, name);
    if (!container) return container.error();
    const auto text = container->manifest();
    if (!text) return text.error();
    auto manifest = parseJson(*text, name);
    if (!manifest) return manifest.error();
    if (!manifest->is_object()) return Error{name + " is broken: its table of contents is not an object."};
    Problems problems;
    reportUnknownKeys(*manifest, {"mesh", "guides", "maps", "partings"}, packageShared, problems);
    for (const char* key : {"groups", "counts"}) {
        if (parameters.contains(key)) (*manifest)[key] = parameters[key];
    }
    auto opened = decodeGroom(*container, *manifest, name, progress);
    if (opened) opened->problems.insert(opened->problems.begin(), problems.begin(), problems.end());
    return opened;
}

Result<std::vector<std::uint8_t>> partBytes(const PackagePart& part, Progress& progress) {
    ContainerWriter writer;
    json manifest{{"first_unit", part.range.first},
                  {"last_unit", part.range.last},
                  {"asked", part.asked},
                  {"hairs", part.hairs},
                  {"vertices", part.vertices},
                  {"bounds", boundsToJson(part.bounds)},
                  {"digest", hexDigest(part.digest)},
                  {"triangles", blobToJson(writer.addArray(part.triangles))},
                  {"triangle_hairs", blobToJson(writer.addArray(part.triangleHairs))}};
    if (!part.frameBounds.empty()) manifest["frame_bounds"] = blobToJson(writer.addArray(part.frameBounds));
    return writer.finish(partKind, jsonText(manifest), progress);
}

Result<PackagePart> partFromBytes(std::span<const std::uint8_t> bytes, const std::string& name, Progress& progress) {
    auto container = Container::read(bytes, partKind, name);
    if (!container) return container.error();
    const auto text = container->manifest();
    if (!text) return text.error();
    const auto manifest = parseJson(*text, name);
    if (!manifest) return manifest.error();
    std::string fault;
    ManifestReader reader(*manifest, "its table of contents", fault);
    PackagePart part;
    part.range.first = static_cast<std::uint32_t>(reader.number("first_unit", UINT32_MAX));
    part.range.last = static_cast<std::uint32_t>(reader.number("last_unit", UINT32_MAX));
    part.asked = reader.number("asked", UINT32_MAX);
    part.hairs = reader.number("hairs", UINT32_MAX);
    part.vertices = reader.number("vertices", UINT64_MAX);
    part.digest = digestFromText(reader.text("digest"));
    const Blob triangles = reader.blob("triangles");
    const Blob hairs = reader.blob("triangle_hairs");
    if (fault.empty() && (!manifest->contains("bounds") || !boundsFromJson((*manifest)["bounds"], part.bounds)))
        fault = "it has no right bounding box.";
    if (fault.empty() && (triangles.bytes % 4 != 0 || triangles.bytes != hairs.bytes ||
                          !container->claim(triangles, triangles.bytes) || !container->claim(hairs, hairs.bytes)))
        fault = "its triangles are not there.";
    const bool moving = fault.empty() && manifest->contains("frame_bounds");
    const Blob frames = moving ? reader.blob("frame_bounds") : Blob{};
    if (fault.empty() && (frames.bytes % sizeof(Bounds) != 0 || frames.bytes > PackageFrames::most * sizeof(Bounds) ||
                          (moving && !container->claim(frames, frames.bytes))))
        fault = "the boxes of its frames are not there.";
    if (!fault.empty()) return Error{name + " is broken: " + fault + " Export the package again."};
    part.frameBounds.resize(static_cast<std::size_t>(frames.bytes / sizeof(Bounds)));
    part.triangles.resize(static_cast<std::size_t>(triangles.bytes / 4));
    part.triangleHairs.resize(part.triangles.size());
    const Container::Request requests[] = {{triangles, reinterpret_cast<std::uint8_t*>(part.triangles.data())},
                                           {hairs, reinterpret_cast<std::uint8_t*>(part.triangleHairs.data())},
                                           {frames, reinterpret_cast<std::uint8_t*>(part.frameBounds.data())}};
    if (auto done = container->inflate(requests, progress); !done) return done.error();
    if (!std::ranges::all_of(part.frameBounds, isBox))
        return Error{name + " is broken: a frame has no right bounding box. Export the package again."};
    return part;
}

json boundsToJson(const Bounds& bounds) {
    if (bounds.empty()) return nullptr;
    return json::array({json::array({bounds.min.x, bounds.min.y, bounds.min.z}),
                        json::array({bounds.max.x, bounds.max.y, bounds.max.z})});
}

bool boundsFromJson(const json& corners, Bounds& bounds) {
    bounds = Bounds();
    if (corners.is_null()) return true;
    if (!corners.is_array() || corners.size() != 2) return false;
    for (std::size_t corner = 0; corner < 2; ++corner) {
        const json& values = corners[corner];
        if (!values.is_array() || values.size() != 3) return false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!values[axis].is_number()) return false;
            const auto value = values[axis].get<float>();
            if (!std::isfinite(value)) return false;
            (corner == 0 ? bounds.min : bounds.max)[static_cast<glm::length_t>(axis)] = value;
        }
    }
    return bounds.min.x <= bounds.max.x && bounds.min.y <= bounds.max.y && bounds.min.z <= bounds.max.z;
}

}  // namespace whorl
