// SPDX-License-Identifier: Apache-2.0
#include "core/commands/facts.h"
#include "core/io/hair_file.h"
#include "core/io/open.h"
#include "core/io/package.h"
#include "core/param/param.h"
#include "editor/cli/cli.h"

#include <nlohmann/json.hpp>

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    bool json = false;
};

Outcome hairFacts(const Options& options) {
    const auto curves = readHairFile(options.file);
    if (!curves) return badInput(curves.error());
    std::size_t points = 0;
    for (const auto& curve : *curves) points += curve.size();
    if (options.json) {
        const nlohmann::ordered_json json{{"kind", "hair"}, {"curves", curves->size()}, {"points", points}};
        return printed(json.dump(2) + "\n");
    }
    return printed("kind: hair\ncurves: " + std::to_string(curves->size()) + "\npoints: " + std::to_string(points) +
                   "\n");
}

Outcome info(const Options& options) {
    const FileKind kind = fileKind(options.file);
    if (kind == FileKind::HairCurves) return hairFacts(options);
    PackageFrames frames;
    Result<OpenedDocument> opened = Error{};
    if (kind == FileKind::Package) {
        auto package = openPackage(options.file, progress());
        if (!package) return badInput(package.error());
        frames = package->frames;
        opened = OpenedDocument{std::move(package->groom), std::move(package->problems)};
    } else {
        opened = openGroom(options.file, progress());
    }
    if (!opened) return badInput(opened.error());
    const std::string name = kind == FileKind::Document ? "document" : kind == FileKind::Package ? "package" : "mesh";
    Problems problems = opened->problems;
    const Problems faults = checkGroom(opened->groom);
    problems.insert(problems.end(), faults.begin(), faults.end());
    endProgress();
    if (options.json) return printed(groomFactsJson(opened->groom, problems, name) + "\n");
    std::string text = "kind: " + name + "\n" + groomFactsText(opened->groom);
    if (!frames.empty()) {
        text += "frames: " + std::to_string(frames.first) + " to " + std::to_string(frames.last) + ", " +
                paramText(frames.perSecond) + " a second\n";
    }
    for (const std::string& problem : problems) text += "problem: " + problem + "\n";
    return printed(text);
}

}  // namespace

void addInfo(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "info", "Facts of a mesh, document, package or hair file",
                                   [options] { return info(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl, .groom or .hair")->required();
    program->add_flag("--json", options->json, "As a JSON object");
}

}  // namespace whorl::cli
