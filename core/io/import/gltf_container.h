// SPDX-License-Identifier: Apache-2.0
// What is checked in a glTF or GLB file before tinygltf may parse it. Private to the importers.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace whorl::import {

/// The JSON inside the file. Errors are half sentences: the chunks of a GLB do not add up, JSON is nested deeper than
/// 64 or holds more than four million values.
struct GltfContainer {
    std::string_view json;
    bool binary = false;          ///< a GLB
    std::uint64_t usedBytes = 0;  ///< of a GLB, as its header says
};
Result<GltfContainer> openContainer(std::span<const std::uint8_t> bytes);

/// True for extensions that a file may require although this program leaves them out: none moves a triangle.
bool knownExtension(std::string_view name);

}  // namespace whorl::import
