// SPDX-License-Identifier: Apache-2.0
// The files in a package, one at a time. Include in sources only.
#pragma once

#include "core/io/document.h"
#include "core/io/package.h"

#include <nlohmann/json.hpp>

namespace whorl {

inline constexpr std::uint32_t maxPackageParts = 4096;
inline constexpr const char* packageManifest = "groom.json";
inline constexpr const char* packageRib = "groom.rib";
inline constexpr const char* packageShared = "shared.bin";

inline constexpr const char* packageFormat = "whorl-package";
// 1 had ranges of hairs instead of the surface; 3 has frames, and is written only with frames.
inline constexpr std::uint64_t packageVersion = 3;
inline constexpr std::uint64_t packageVersionWithoutFrames = 2;
inline constexpr std::uint64_t maxPackageManifest = std::uint64_t{16} << 20;

/// True for 1 to PackageFrames::most frames in order, at a speed above zero.
bool areFrames(const PackageFrames& frames);
/// Checksum of groom.json without the one that it holds.
std::string packageChecksum(nlohmann::json manifest);
/// Entry of a part in groom.json.
nlohmann::json partToJson(const PackagePart& part);
/// See openPackage; the folder is there.
Result<Package> readPackage(const std::filesystem::path& folder, Progress& progress);

/// "part-0007.bin"
std::string packagePartName(std::uint32_t part);
/// True for the names that packages use.
bool isPackageFileName(const std::string& name);

/// A file right inside the folder; links are refused.
Result<std::vector<std::uint8_t>> readPackageFile(const std::filesystem::path& folder, const std::string& name,
                                                  std::uint64_t maxBytes);
/// Bytes written.
Result<std::uint64_t> writePackageFile(const std::filesystem::path& folder, const std::string& name,
                                       const std::vector<std::uint8_t>& bytes, Progress& progress);

/// shared.bin: mesh, guides and maps of `groom`. The rest of the manifest (groups, counts) goes to `parameters`.
Result<std::vector<std::uint8_t>> sharedBytes(const Groom& groom, nlohmann::json& parameters, Progress& progress);
Result<OpenedDocument> groomFromShared(std::span<const std::uint8_t> bytes, const nlohmann::json& parameters,
                                       const std::string& name, Progress& progress);

Result<std::vector<std::uint8_t>> partBytes(const PackagePart& part, Progress& progress);
/// Sets all but `file` and `bytes`. Part files do not tell how many frames the package has.
Result<PackagePart> partFromBytes(std::span<const std::uint8_t> bytes, const std::string& name, Progress& progress);

/// Text of groom.rib: one primitive a part, with its box. `name`: the folder as the renderer will find it.
std::string packageRibText(const std::string& name, const std::vector<PackagePart>& parts, const PackageFrames& frames);

/// Null for an empty box, else its two corners.
nlohmann::json boundsToJson(const Bounds& bounds);
/// False when it is neither.
bool boundsFromJson(const nlohmann::json& json, Bounds& bounds);

}  // namespace whorl
