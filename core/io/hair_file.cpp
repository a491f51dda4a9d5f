// SPDX-License-Identifier: Apache-2.0
#include "core/io/hair_file.h"

#include "core/hair/thin.h"
#include "core/io/hair_formats.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace whorl {
namespace {

constexpr std::array<HairFormat, 4> formats{{
    {"ply", "Stanford PLY, points and edges", openHairPly},
    {"obj", "Wavefront OBJ, lines", openHairObj},
    {"hair", "HAIR by Cem Yuksel", openHairYuksel},
    {"rib", "RenderMan RIB, Catmull-Rom curves", openHairRib},
}};

constexpr std::uint32_t blockHairs = 1u << 14;

}  // namespace

std::span<const HairFormat> hairFormats() {
    return formats;
}

const HairFormat* hairFormatFor(const std::filesystem::path& file) {
    std::string suffix = file.extension().string();
    if (!suffix.empty()) suffix.erase(0, 1);
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    for (const HairFormat& format : formats)
        if (format.suffix == suffix) return &format;
    return nullptr;
}

Result<std::uint64_t> writeHair(const Groom& groom, const GenerateOptions& options, const std::filesystem::path& file,
                                Progress& progress, std::shared_ptr<const Surface> surface) {
    const HairFormat* format = hairFormatFor(file);
    if (!format) {
        std::string known;
        for (const HairFormat& f : formats) known += (known.empty() ? "." : ", .") + std::string(f.suffix);
        return Error{file.string() + ": hair can not be written in this format; use one of " + known + "."};
    }
    Result<std::unique_ptr<HairWriter>> writer = format->open(file, wantsNormals(groom));
    if (!writer) return writer.error();
    std::uint64_t hairs = 0;
    std::optional<Error> fault;
    Generator generator;
    generator.setSurface(std::move(surface));
    const Result<void> made = generator.stream(
        groom, options, blockHairs,
        [&](const Strands& block) {
            const Result<void> added = (*writer)->add(block);
            if (!added) fault = added.error();
            hairs += block.count();
            return !fault;
        },
        progress);
    if (fault) return *fault;
    if (!made) return made.error();
    if (const Result<void> finished = (*writer)->finish(); !finished) return finished.error();
    return hairs;
}

}  // namespace whorl
