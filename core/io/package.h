// SPDX-License-Identifier: Apache-2.0
// NAME.groom: the package that the render-time library turns into hair (seed 000, section 4.2.1).
#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/hair/strands.h"
#include "core/model/groom.h"

namespace whorl {

/// A folder with groom.json (what all calls share) and part-NNNN.bin (one call's piece with its exact bounding box).
/// Nothing outside the folder is read.
struct PackagePart {
    std::string file;
    std::uint32_t firstHair = 0;
    std::uint32_t lastHair = 0;
    Bounds bounds;  ///< of the rendered hair
    std::uint64_t bytes = 0;
};

struct Package {
    Groom groom;  ///< generates the very same hair
    std::vector<PackagePart> parts;
    std::uint64_t digest = 0;  ///< of all hair, as exported
    Problems problems;
};

/// Writes to a temporary folder beside, reads it back, checks the digest, renames. The old package or the new one.
/// Every part is generated once for its box. `parts` 0: counts.parts.
Result<void> exportPackage(const Groom& groom, const std::filesystem::path& folder, std::uint32_t parts,
                           Progress& progress);
Result<Package> openPackage(const std::filesystem::path& folder, Progress& progress);
bool isPackage(const std::filesystem::path& folder);

}  // namespace whorl
