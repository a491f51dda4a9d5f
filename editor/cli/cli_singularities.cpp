// SPDX-License-Identifier: Apache-2.0
// singularities: around which places the hair turns.
#include "core/commands/facts.h"
#include "core/field/groom_field.h"
#include "editor/cli/cli.h"

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    bool json = false;
};

Outcome singularities(const Options& options) {
    const auto groom = open(options.file);
    if (!groom) return badInput(groom.error());
    const auto surface = std::make_shared<const Surface>(groom->mesh);
    const auto field = groomField(*groom, surface, progress());
    if (!field) return badInput(field.error());
    endProgress();
    return printed(
        (options.json ? singularitiesJson(*field, surface->mesh()) : singularitiesText(*field, surface->mesh())) +
        "\n");
}

}  // namespace

void addSingularities(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "singularities",
                                   "Lists the places around which the hair's directions turn: index (+1 whorl or star, "
                                   "-1 saddle), position in metres, triangle; and the sum of the indices",
                                   [options] { return singularities(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program->add_flag("--json", options->json, "As a JSON object");
}

}  // namespace whorl::cli
