// SPDX-License-Identifier: Apache-2.0
// Baked hair texture as image files.
#pragma once

#include "core/lic/bake.h"

#include <filesystem>
#include <string>
#include <vector>

namespace whorl {

struct BakeRequest {
    /// With `maps`: NAME or NAME.png gives NAME_colour.png and so on. Without: this very file, colour with the opacity
    /// in alpha.
    std::filesystem::path file;
    std::vector<BakeMap> maps;
    BakeOptions options;
    /// "png" or "exr"; empty: that of `file`, or png.
    std::string format;
    /// A channel. Of PNG 8 or 16; 0: 8 for colour and opacity, 16 for flow and height. Of EXR, which holds floats and
    /// linear colour, 16 (half floats) or 32; 0: 32.
    int bits = 0;
};

/// The maps called "colour", "opacity", "flow" and "height", each once; fails for other names.
Result<std::vector<BakeMap>> bakeMapsNamed(std::span<const std::string> names);

/// Files that `request` writes.
std::vector<std::filesystem::path> bakedFiles(const BakeRequest& request);

/// Solves the groom's field, bakes and writes. Returns the files. Fails when one can not be written, when the
/// format has no such bits, or when cancelled.
Result<std::vector<std::filesystem::path>> bakeToFiles(const Groom& groom, std::shared_ptr<const Surface> surface,
                                                       const BakeRequest& request, Progress& progress);

}  // namespace whorl
