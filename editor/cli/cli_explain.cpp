// SPDX-License-Identifier: Apache-2.0
// explain: why one hair is as it is.
#include "core/hair/explain.h"
#include "editor/cli/cli.h"

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    std::uint32_t hair = 0;
    std::uint32_t count = 0;
};

Outcome explain(const Options& options) {
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    const auto surface = std::make_shared<const Surface>(groom->mesh);
    const auto explanation = explainHair(*groom, surface, options.hair, options.count, progress());
    if (!explanation) return badInput({options.file + ": " + explanation.error().message});
    endProgress();
    return printed(explanationText(*explanation));
}

}  // namespace

void addExplain(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "explain", "Says why a hair is as it is: its guides, maps and every step",
                                   [options] { return explain(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program->add_option("HAIR", options->hair, "Number of the hair, from 0")->required();
    program->add_option("--count", options->count, "Hairs instead of the groom's number")
        ->check(CLI::Range(1u, 10000000u));
}

}  // namespace whorl::cli
