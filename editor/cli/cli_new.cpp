// SPDX-License-Identifier: Apache-2.0
#include "core/commands/command.h"
#include "core/io/image.h"
#include "core/io/open.h"
#include "editor/cli/cli.h"

namespace whorl::cli {
namespace {

struct Options {
    std::string mesh;
    std::string document;
    std::string density;
    std::optional<std::uint32_t> guides;
    std::optional<std::uint32_t> seed;
};

Outcome makeNew(const Options& options) {
    if (!options.document.ends_with(".whorl")) return badUsage("-o: the document's name must end in .whorl.");
    const FileKind kind = fileKind(options.mesh);
    if (kind == FileKind::Document || kind == FileKind::Package) {
        return badInput({options.mesh + ": a new groom begins with a mesh, and this is one already."});
    }
    auto groom = open(options.mesh);
    if (!groom) return badInput(groom.error());
    if (options.seed) groom->counts.edit().seed = static_cast<int>(*options.seed);
    if (auto read = addDensity(*groom, options.density); !read) return badInput(read.error());
    const auto guides = options.guides.value_or(static_cast<std::uint32_t>(groom->counts->guides));
    if (guides > 0) {
        if (guides >= 3) groom->counts.edit().guides = static_cast<int>(guides);
        const Surface surface(groom->mesh);
        if (auto placed = placeGuides(*groom, surface, guides, 0.0f, false, progress()); !placed) {
            return badInput(placed.error());
        }
    }
    if (auto saved = saveDocument(*groom, options.document, progress()); !saved) return badInput(saved.error());
    return done();
}

}  // namespace

void addNew(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "new", "A new document on a mesh, with evenly placed guides",
                                   [options] { return makeNew(*options); });
    program->add_option("MESH", options->mesh, "glTF, GLB, OBJ or PLY")->required();
    program->add_option("-o,--output", options->document, "Document to write, NAME.whorl")->required();
    program->add_option("--guides", options->guides, "Number of guides; 0 places none")
        ->check(CLI::Range(0u, 1000000u));
    program->add_option("--density", options->density, "Image that says where hair grows (white: full)");
    program->add_option("--seed", options->seed, "Another seed gives other random places")
        ->check(CLI::Range(0u, 2147483647u));
}

}  // namespace whorl::cli
