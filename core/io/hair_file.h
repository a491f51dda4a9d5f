// SPDX-License-Identifier: Apache-2.0
// Generated hair in files that other programs read; one source a format.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/hair/generate.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace whorl {

/// Takes hair block by block and writes it. One file, one writer.
class HairWriter {
public:
    virtual ~HairWriter() = default;
    virtual Result<void> add(const Strands& block) = 0;
    /// Completes and commits the file. Without it nothing is left behind.
    virtual Result<void> finish() = 0;
};

struct HairFormat {
    std::string_view suffix;  ///< "ply"
    std::string_view label;   ///< "Stanford PLY, points and edges"
    /// `normals`: the file holds them, if its format has a place for them.
    Result<std::unique_ptr<HairWriter>> (*open)(const std::filesystem::path& file, bool normals);
};
std::span<const HairFormat> hairFormats();
/// By suffix of `file`; null for an unknown one.
const HairFormat* hairFormatFor(const std::filesystem::path& file);

/// Generates and writes in blocks: constant memory for any number of hairs. Normals as
/// wantsNormals has it. `surface`: that of the groom's mesh when it
/// is at hand.
Result<std::uint64_t> writeHair(const Groom& groom, const GenerateOptions& options, const std::filesystem::path& file,
                                Progress& progress, std::shared_ptr<const Surface> surface = nullptr);

/// Curves from a .hair file (Cem Yuksel): points of each strand, metres as stored. Every count of the header is checked
/// against the bytes that are there. Strands of a single point are left out.
Result<std::vector<std::vector<glm::vec3>>> readHairFile(const std::filesystem::path& file);

}  // namespace whorl
