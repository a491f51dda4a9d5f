// SPDX-License-Identifier: Apache-2.0
#include "core/io/package.h"
#include "editor/cli/cli.h"

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    std::string output;
    std::uint32_t parts = 0;
};

Outcome exportGroom(const Options& options) {
    if (!std::filesystem::path(options.output).filename().string().ends_with(".groom")) {
        return badUsage("-o: the package's name must end in .groom.");
    }
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    if (auto written = exportPackage(*groom, options.output, options.parts, progress()); !written) {
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
}

}  // namespace whorl::cli
