// SPDX-License-Identifier: Apache-2.0
#include "core/hair/changes.h"
#include "core/hair/lod.h"
#include "core/io/package.h"
#include "editor/cli/cli.h"

#include <charconv>

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    std::string output;
    float lod = 1.0f;
    std::uint32_t parts = 0;
    std::string frames;
    double perSecond = 24.0;
};

/// "12", "1-48", "-10-20".
std::optional<PackageFrames> framesFrom(const std::string& text, double perSecond) {
    PackageFrames frames{.perSecond = perSecond};
    const char* end = text.data() + text.size();
    const auto [middle, fault] = std::from_chars(text.data(), end, frames.first);
    if (fault != std::errc()) return std::nullopt;
    frames.last = frames.first;
    if (middle == end) return frames;
    if (*middle != '-') return std::nullopt;
    const auto [last, bad] = std::from_chars(middle + 1, end, frames.last);
    if (bad != std::errc() || last != end || frames.empty()) return std::nullopt;
    return frames;
}

Outcome exportGroom(const Options& options) {
    if (!std::filesystem::path(options.output).filename().string().ends_with(".groom")) {
        return badUsage("-o: the package's name must end in .groom.");
    }
    PackageFrames frames;
    if (!options.frames.empty()) {
        const auto asked = framesFrom(options.frames, options.perSecond);
        if (!asked || asked->count() > PackageFrames::most)
            return badUsage("--frames: write A-B, the first and the last frame, at most 10,000, not \"" +
                            options.frames + "\".");
        frames = *asked;
    }
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    if (!frames.empty() && !isAnimated(*groom))
        note(options.output + ": no hair moves with time (animated frizz), so the boxes of all frames are the same.");
    *groom = atDetail(std::move(*groom), options.lod);
    if (auto written = exportPackage(*groom, options.output, options.parts, progress(), nullptr, frames); !written) {
        return badInput(written.error());
    }
    return done();
}

}  // namespace

void addExport(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "export", "Exports the package that renderers load",
                                   [options] { return exportGroom(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program->add_option("-o,--output", options->output, "Package to write, NAME.groom")->required();
    program->add_option("--parts", options->parts, "Pieces; without it the groom's number")
        ->check(CLI::Range(1u, 4096u));
    addLod(*program, options->lod);
    program->add_option("--frames", options->frames, "Keeps the boxes of frames A-B, in which animated frizz moves");
    program->add_option("--fps", options->perSecond, "Frames a second of --frames")->check(CLI::Range(0.001, 10000.0));
}

}  // namespace whorl::cli
