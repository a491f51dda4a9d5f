// SPDX-License-Identifier: Apache-2.0
// bake-lic: hair texture in the mesh's UVs.
#include "core/field/groom_field.h"
#include "core/io/image.h"
#include "core/lic/bake.h"
#include "core/sampling/density.h"
#include "core/surface/surface_point.h"
#include "editor/cli/cli.h"

#include <algorithm>
#include <cmath>

namespace whorl::cli {
namespace {

struct Options {
    std::string file;
    std::string output;
    int size = 1024;
    int margin = 8;
    float length = 0.015f;
    float grain = 0.0006f;
    float white = 0.5f;
};

Outcome bake(const Options& options) {
    auto groom = openWithGuides(options.file);
    if (!groom) return badInput(groom.error());
    const auto surface = std::make_shared<const Surface>(groom->mesh);
    const auto field = groomField(*groom, surface, progress());
    if (!field) return badInput(field.error());
    LicOptions lic;
    lic.length = options.length;
    lic.grain = options.grain;
    lic.white = options.white;
    const DensityLookup density(*groom);
    const float most = density.upperBound();
    const auto cover = [&](const SurfacePoint& point) {
        return most > 0.0f ? density.at(point.triangle, uvAt(surface->mesh(), point)) / most : 0.0f;
    };
    const auto baked = bakeLic(LicReference(surface, *field), lic, options.size, options.margin, cover, progress());
    if (!baked) return badInput(baked.error());
    // The colour half way along the hair of the groom's first group, from dark to full.
    const ColourParams& colour = groom->groups->front().params.colour;
    const glm::vec3 mean = (colour.root.value + colour.tip.value) * 0.5f;
    // Averages over many cells of the noise differ little: three quarters of them shall spread over the range of light.
    const float cells = std::max(2.0f * lic.length / lic.grain, 1.0f);
    const float spread = std::sqrt(1.5f * std::max(lic.white * (1.0f - lic.white), 1e-4f) / cells);
    const float contrast = 0.6f / (1.15f * spread);
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < options.size; ++y) {
        for (int x = 0; x < options.size; ++x) {
            const float light = std::clamp(1.0f + contrast * (baked->brightness.texel(x, y) - lic.white), 0.1f, 1.9f);
            const float covered = baked->coverage.texel(x, y);
            for (int c = 0; c < 3; ++c) {
                const float value = std::min(srgbFromLinear(std::min(mean[c] * light, 1.0f)), 1.0f);
                pixels.push_back(static_cast<std::uint8_t>(value * 255.0f + 0.5f));
            }
            pixels.push_back(static_cast<std::uint8_t>(covered * 255.0f + 0.5f));
        }
    }
    if (auto written = writePixels(pixels, options.size, options.size, 4, options.output); !written)
        return badInput(written.error());
    endProgress();
    return done();
}

}  // namespace

void addBakeLic(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program = addProgram(app, "bake-lic", "Bakes hair texture that lies as the guides do, in the mesh's UVs",
                                   [options] { return bake(*options); });
    program->add_option("FILE", options->file, "Mesh, .whorl or .groom")->required();
    program->add_option("-o,--output", options->output, "Image to write, opacity in alpha: png, tif, exr or tga")
        ->required();
    program->add_option("--size", options->size, "Texels a side; 1024 without it")->check(CLI::Range(1, 8192));
    program->add_option("--margin", options->margin, "Texels around charts; 8 without it")->check(CLI::Range(0, 256));
    program->add_option("--length", options->length, "Metres of streamline each way; 0.015 without it")
        ->check(CLI::Range(0.0001f, 10.0f));
    program->add_option("--grain", options->grain, "Width of a hair in metres; 0.0006 without it")
        ->check(CLI::Range(0.00001f, 1.0f));
    program->add_option("--white", options->white, "Share of white in the noise; 0.5 without it")
        ->check(CLI::Range(0.0f, 1.0f));
}

}  // namespace whorl::cli
