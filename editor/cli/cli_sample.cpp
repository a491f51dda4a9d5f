// SPDX-License-Identifier: Apache-2.0
#include "core/hair/roots.h"
#include "core/io/safe_file.h"
#include "core/surface/surface_point.h"
#include "editor/cli/cli.h"

#include <array>
#include <bit>
#include <cstring>

namespace whorl::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "points are written as they lie in memory");

struct Options {
    std::string mesh;
    std::string output;
    std::string density;
    std::uint32_t count = 0;
    std::uint32_t seed = 1;
    bool even = false;
};

/// Position, normal and UV of a root.
using Row = std::array<float, 8>;

Row rowOf(const SurfaceMesh& mesh, const SurfacePoint& root) {
    const glm::vec3 p = positionAt(mesh, root), n = normalAt(mesh, root);
    const glm::vec2 uv = uvAt(mesh, root);
    return {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
}

// As hair grows.
Result<std::vector<SurfacePoint>> hairPlaces(const Groom& groom, const DensityLookup& density, const Options& options) {
    const auto sampler = RootSampler::build(groom, density, progress());
    if (!sampler) return sampler.error();
    std::vector<SurfacePoint> places;
    if (sampler->empty()) return places;
    CountParams counts;
    counts.seed = static_cast<int>(options.seed);
    counts.hairs = static_cast<int>(options.count);
    RootList roots;
    sampler->sample(requestFor(counts, *sampler, static_cast<double>(options.count)), {}, roots);
    places.reserve(roots.count());
    for (std::size_t i = 0; i < roots.count(); ++i)
        if (density.growsAt(*groom.mesh, roots.point(i))) places.push_back(roots.point(i));
    return places;
}

Outcome sample(const Options& options) {
    if (!options.output.ends_with(".ply")) return badUsage("-o: points are written as PLY; the name must end in .ply.");
    auto groom = open(options.mesh);
    if (!groom) return badInput(groom.error());
    if (auto read = addDensity(*groom, options.density); !read) return badInput(read.error());
    const SurfaceMesh& mesh = *groom->mesh;
    for (Group& group : groom->groups.edit()) group.params.general.even = options.even;
    const DensityLookup density(*groom);
    auto places = hairPlaces(*groom, density, options);
    if (!places) return badInput(places.error());
    const std::uint64_t count = places->size();
    if (count == 0) {
        return badInput(
            {options.mesh + ": no root has a place; the density is zero everywhere or no part grows hair."});
    }

    auto file = SafeFile::create(options.output);
    if (!file) return badInput(file.error());
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) + "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
        header += "property float " + std::string(name) + "\n";
    header += "end_header\n";
    if (auto written = file->write(header.data(), header.size()); !written) return badInput(written.error());
    std::vector<Row> rows;
    constexpr std::uint64_t blockRows = 65536;
    for (std::uint64_t first = 0; first < count; first += blockRows) {
        if (progress().cancelled()) return badInput(cancelledError());
        progress().report(static_cast<float>(first) / static_cast<float>(count), "Writing points");
        rows.clear();
        for (std::uint64_t i = first; i < std::min(count, first + blockRows); ++i) {
            rows.push_back(rowOf(mesh, (*places)[i]));
        }
        if (auto written = file->write(rows.data(), rows.size() * sizeof(Row)); !written)
            return badInput(written.error());
    }
    if (auto committed = file->commit(); !committed) return badInput(committed.error());
    return done();
}

}  // namespace

void addSample(CLI::App& app) {
    auto options = std::make_shared<Options>();
    CLI::App* program =
        addProgram(app, "sample", "Hair roots on a mesh as points", [options] { return sample(*options); });
    program->add_option("MESH", options->mesh, "Mesh, .whorl or .groom")->required();
    program->add_option("--count", options->count, "Number of points")->required()->check(CLI::Range(1u, 100000000u));
    program->add_option("--density", options->density, "Image that says where hair grows (white: full)");
    program->add_option("--seed", options->seed, "Another seed gives other random places")
        ->check(CLI::Range(0u, 2147483647u));
    program->add_flag("--even", options->even, "Keeps points apart, as hair with even spacing");
    program->add_option("-o,--output", options->output, "Points to write, NAME.ply")->required();
}

}  // namespace whorl::cli
