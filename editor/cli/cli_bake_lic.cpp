// SPDX-License-Identifier: Apache-2.0
// bake-lic: hair texture in the mesh's UVs.
#include "core/io/bake_files.h"
#include "editor/cli/cli.h"

#include <optional>

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    BakeRequest request;
    std::string output;
    std::vector<std::string> maps;
    std::optional<float> length;
    std::optional<float> grain;
    std::optional<float> white;
};

Outcome bake(Options options) {
    auto maps = bakeMapsNamed(options.maps);
    if (!maps) return badUsage("--maps: " + maps.error().message);
    options.request.maps = std::move(*maps);
    options.request.file = options.output;
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    LicParams& lic = groom->lic.edit();
    if (options.length) lic.length = {*options.length, {}};
    if (options.grain) lic.grain = {*options.grain, {}};
    if (options.white) lic.white = *options.white;
    const auto surface = std::make_shared<const Surface>(groom->mesh);
    const auto files = bakeToFiles(*groom, surface, options.request, progress());
    if (!files) return badInput(files.error());
    endProgress();
    return done();
}

}  // namespace

void addBakeLic(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program =
        addProgram(app, "bake-lic", "Bakes hair texture along the groom's strokes, or its guides, in the mesh's UVs",
                   [options] { return bake(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program
        ->add_option("-o,--output", options->output,
                     "Image to write, opacity in alpha: png, tif, exr or tga; with --maps NAME_colour.png and so on")
        ->required();
    program
        ->add_option("--maps", options->maps,
                     "Images of their own, by commas: colour, opacity, flow (direction in the tangent frame of the "
                     "UVs, red along u, green along v, 0.5 none; green up as in OpenGL), height")
        ->delimiter(',');
    BakeOptions& bake = options->request.options;
    program->add_option("--size", bake.size, "Texels a side; 1024 without it")
        ->check(CLI::Range(1, BakeOptions::maxSize));
    program->add_option("--margin", bake.margin, "Texels around charts; 8 without it")
        ->check(CLI::Range(0, BakeOptions::maxMargin));
    program->add_option("--format", options->request.format, "png or exr; by the suffix of -o without it")
        ->check(CLI::IsMember({"png", "exr"}));
    program
        ->add_option("--bits", options->request.bits,
                     "Bits a channel. png: 8 or 16; without it 8, and 16 for flow and height. exr: 16, half floats, or "
                     "32, which it is without it")
        ->check(CLI::IsMember({8, 16, 32}));
    program->add_flag("--reference", bake.reference, "Convolve place by place with Runge-Kutta steps: slow");
    program->add_option("--length", options->length, "Metres of streamline each way instead of the groom's")
        ->check(CLI::Range(0.0001f, 10.0f));
    program->add_option("--grain", options->grain, "Width of a hair in metres instead of the groom's")
        ->check(CLI::Range(0.00001f, 1.0f));
    program->add_option("--white", options->white, "Share of white in the noise instead of the groom's")
        ->check(CLI::Range(0.0f, 1.0f));
}

}  // namespace whorl::cli
