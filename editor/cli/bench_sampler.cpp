// SPDX-License-Identifier: Apache-2.0
// The tables of seed 000 (Sik, section 3.4) on meshes of the same sizes, made here: a bench needs no files.
#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/root_sampler.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface_point.h"
#include "editor/cli/bench.h"

#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace whorl {
namespace {

constexpr std::uint64_t sampleCount = 500000;

// A lumpy ball of 4 * rings * rings triangles, so that triangles differ in size as those of a scan do.
SurfaceMesh lumpyBall(std::uint32_t rings) {
    SurfaceMesh mesh;
    const std::uint32_t sectors = 2 * rings;
    const auto uvOf = [&](std::uint32_t ring, std::uint32_t sector) {
        return glm::vec2(static_cast<float>(sector) / static_cast<float>(sectors),
                         static_cast<float>(ring) / static_cast<float>(rings));
    };
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        for (std::uint32_t sector = 0; sector <= sectors; ++sector) {
            const glm::vec2 uv = uvOf(ring, sector);
            const float polar = glm::pi<float>() * (0.02f + 0.96f * uv.y);
            const float azimuth = glm::two_pi<float>() * uv.x;
            const glm::vec3 out(std::sin(polar) * std::cos(azimuth), -std::cos(polar),
                                std::sin(polar) * std::sin(azimuth));
            mesh.positions.push_back(out * (0.1f + 0.02f * std::sin(7.0f * azimuth) * std::sin(5.0f * polar)));
            mesh.normals.push_back(out);
        }
    }
    const auto add = [&](std::pair<std::uint32_t, std::uint32_t> a, std::pair<std::uint32_t, std::uint32_t> b,
                         std::pair<std::uint32_t, std::uint32_t> c) {
        const auto vertex = [&](std::pair<std::uint32_t, std::uint32_t> at) {
            return at.first * (sectors + 1) + at.second;
        };
        mesh.triangles.emplace_back(vertex(a), vertex(b), vertex(c));
        for (const auto& corner : {a, b, c}) mesh.cornerUvs.push_back(uvOf(corner.first, corner.second));
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            add({ring, sector}, {ring + 1, sector}, {ring, sector + 1});
            add({ring, sector + 1}, {ring + 1, sector}, {ring + 1, sector + 1});
        }
    }
    mesh.parts.push_back({.name = "ball", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

constexpr std::uint32_t bunnyRings = 132;   // 69,696 triangles; the seed's bunny has 69k
constexpr std::uint32_t dragonRings = 225;  // 202,500; the seed's dragon 202k
constexpr std::uint32_t buddhaRings = 521;  // 1,085,764; the seed's Buddha 1,087k

// Noise of the given mean: each texel its own number, dark ones more often when the mean is low.
Map noise(int size, double mean) {
    Map map(size, size, 1, TexelFormat::U8, 0.0f);
    const double power = 1.0 / mean - 1.0;  // the mean of x^power is 1 / (power + 1)
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const std::uint64_t texel = static_cast<std::uint64_t>(y) * 65536 + static_cast<std::uint64_t>(x);
            map.setTexel(x, y, 0, static_cast<float>(std::pow(unitDouble(randomBits(5, texel, 0)), power)));
        }
    }
    return map;
}

Groom groomOf(std::uint32_t rings, Map density) {
    Groom groom = makeGroom(lumpyBall(rings));
    if (!density.empty()) {
        groom.maps.set("density", std::move(density));
        groom.groups.edit()[0].params.general.density = {1.0f, "density"};
    }
    return groom;
}

SubTriangleSampler build(const Groom& groom, const DensityLookup& density, float gridPercent) {
    Progress progress;
    return std::move(*SubTriangleSampler::build(*groom.mesh, density, {.gridPercent = gridPercent}, progress));
}

// Digest of many random roots; `pick` is one of the sampler's two ways.
std::uint64_t digestOf(const SubTriangleSampler& sampler,
                       SurfacePoint (SubTriangleSampler::*pick)(double, float, float) const) {
    std::uint64_t digest = 0;
    for (std::uint64_t i = 0; i < sampleCount; ++i) {
        const std::uint64_t inside = randomBits(1, i, 1);
        const SurfacePoint p =
            (sampler.*pick)(unitDouble(randomBits(1, i, 0)), unitFloat(inside), unitFloat(inside << 24));
        digest += hashBytes(&p, sizeof(p));
    }
    return digest;
}

std::string noteOf(const SubTriangleSampler& sampler) {
    char text[96];
    std::snprintf(text, sizeof(text), "%zu sub-triangles, %.2f MB", sampler.subTriangles().size(),
                  static_cast<double>(sampler.memoryBytes()) / 1e6);
    return text;
}

std::string rounded(double number, const char* format) {
    char text[32];
    std::snprintf(text, sizeof(text), format, number);
    return text;
}

// Sampling through the grid against bisection over the whole distribution; equal roots, one by one.
BenchRow samplingRow(const std::string& name, const Groom& groom, float gridPercent) {
    const DensityLookup density(groom);
    const SubTriangleSampler sampler = build(groom, density, gridPercent);
    std::uint64_t ours = 0;
    std::uint64_t theirs = 0;
    const Medians medians = interleaved([&] { ours = digestOf(sampler, &SubTriangleSampler::sample); },
                                        [&] { theirs = digestOf(sampler, &SubTriangleSampler::sampleByBisection); });
    return {name,    medians.ours,   medians.baseline, "bisection without a grid", static_cast<double>(sampleCount),
            "roots", ours == theirs, noteOf(sampler)};
}

BenchRow preprocessRow(const std::string& name, const Groom& groom) {
    const DensityLookup density(groom);
    std::string note;
    bool correct = false;
    const Medians medians = interleaved(
        [&] {
            const SubTriangleSampler sampler = build(groom, density, 100.0f);
            note = noteOf(sampler);
            correct = !sampler.empty();
        },
        {});
    return {name, medians.ours, 0.0, "", static_cast<double>(groom.mesh->triangleCount()), "triangles", correct, note};
}

// Share of roots in each of 32 strips of the UV square.
std::vector<double> strips(const SurfaceMesh& mesh, const std::vector<SurfacePoint>& roots) {
    std::vector<double> counts(32, 0.0);
    for (const SurfacePoint& root : roots)
        counts[static_cast<std::size_t>(std::clamp(uvAt(mesh, root).y * 32.0f, 0.0f, 31.0f))] += 1.0;
    for (double& count : counts) count /= static_cast<double>(std::max<std::size_t>(roots.size(), 1));
    return counts;
}

// Building and sampling together against rejection, which needs no preparation but the triangles' areas.
BenchRow rejectionRow(const std::string& name, const Groom& groom) {
    const DensityLookup density(groom);
    const SubTriangleSampler sampler = build(groom, density, 100.0f);
    std::vector<SurfacePoint> ours;
    std::vector<SurfacePoint> theirs;
    const Medians medians = interleaved(
        [&] {
            ours.clear();
            ours.reserve(sampleCount);
            for (std::uint64_t i = 0; i < sampleCount; ++i) {
                const std::uint64_t inside = randomBits(1, i, 1);
                ours.push_back(
                    sampler.sample(unitDouble(randomBits(1, i, 0)), unitFloat(inside), unitFloat(inside << 24)));
            }
        },
        [&] { theirs = rejectionSample(*groom.mesh, density, sampleCount, 1); });
    // Both follow the same density: strips differ by chance only, five standard deviations at most.
    const std::vector<double> a = strips(*groom.mesh, ours);
    const std::vector<double> b = strips(*groom.mesh, theirs);
    bool correct = theirs.size() == ours.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double chance = std::sqrt((a[i] + b[i]) / static_cast<double>(sampleCount));
        correct = correct && std::abs(a[i] - b[i]) < 5.0 * chance + 0.002 * a[i];
    }
    return {name,    medians.ours, medians.baseline, "rejection sampling", static_cast<double>(sampleCount),
            "roots", correct,      noteOf(sampler)};
}

std::string noteOf(const RootSampler& sampler) {
    char text[96];
    std::snprintf(text, sizeof(text), "%zu pieces, %.2f MB with the curve", sampler.pieceCount(),
                  static_cast<double>(sampler.memoryBytes()) / 1e6);
    return text;
}

// What hair grows from against random roots of the seed's distribution with its grid, both written to memory, on one
// thread.
BenchRow productionRow(const std::string& name, const Groom& groom, std::size_t count) {
    const ThreadLimit limit(1);
    const DensityLookup density(groom);
    Progress progress;
    const RootSampler sampler = std::move(*RootSampler::build(groom, density, progress));
    const SubTriangleSampler reference = build(groom, density, 100.0f);
    const RootRequest request{static_cast<double>(count) / sampler.weight(), 1};
    RootList ours;
    ours.reserve(count + count / 16);
    std::vector<SurfacePoint> theirs(count);
    const Medians medians = interleaved(
        [&] {
            ours.clear();
            sampler.sample(request, {}, ours);
        },
        [&] {
            for (std::uint64_t i = 0; i < count; ++i) {
                const std::uint64_t inside = randomBits(1, i, 1);
                theirs[i] =
                    reference.sample(unitDouble(randomBits(1, i, 0)), unitFloat(inside), unitFloat(inside << 24));
            }
        });
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < ours.count(); ++i) points.push_back(ours.point(i));
    const std::vector<double> a = strips(*groom.mesh, points), b = strips(*groom.mesh, theirs);
    const double asked = static_cast<double>(count), made = static_cast<double>(points.size());
    bool correct = std::abs(made - asked) < 0.01 * asked;
    // Chance of the random ones, and the rounding of densities to a byte.
    for (std::size_t i = 0; i < a.size(); ++i)
        correct = correct && std::abs(a[i] - b[i]) < 5.0 * std::sqrt(b[i] / asked) + 0.005 * b[i];
    return {name,  medians.ours, medians.baseline, "the seed's distribution and grid",
            asked, "roots",      correct,          noteOf(sampler)};
}

BenchRow productionPreprocessRow(const std::string& name, const Groom& groom) {
    const ThreadLimit limit(1);
    const DensityLookup density(groom);
    std::string note;
    bool correct = false;
    const Medians medians = interleaved(
        [&] {
            Progress progress;
            const RootSampler sampler = std::move(*RootSampler::build(groom, density, progress));
            note = noteOf(sampler);
            correct = !sampler.empty();
        },
        [&] { build(groom, density, 100.0f); });
    return {name,
            medians.ours,
            medians.baseline,
            "the seed's, with its grid",
            static_cast<double>(groom.mesh->triangleCount()),
            "triangles",
            correct,
            note};
}

// Places that keep apart, made for the first time: what "even spacing" costs once for a mesh and seed.
BenchRow evenRow(const Groom& groom, std::uint32_t count) {
    const ThreadLimit limit(1);
    const DensityLookup density(groom);
    Progress progress;
    const RootSampler sampler = std::move(*RootSampler::build(groom, density, progress));
    std::uint32_t made = 0;
    std::size_t eliminated = 0;
    const SubTriangleSampler reference = build(groom, density, 100.0f);
    const Medians medians =
        interleaved([&] { made = EvenSequence(*groom.mesh, sampler.curve(), 1, count, false, progress).count(); },
                    [&] { eliminated = evenRoots(*groom.mesh, reference, count, 1, progress)->size(); });
    return {"sampler/even spacing, " + rounded(count, "%.0f") + " roots",
            medians.ours,
            medians.baseline,
            "sample elimination (Yuksel), as for guides; spreads one number better and no smaller one",
            static_cast<double>(count),
            "roots",
            made == count && eliminated == count,
            ""};
}

BenchRow guidesRow() {
    const Groom groom = groomOf(bunnyRings, noise(1024, 0.5));
    const DensityLookup density(groom);
    const SubTriangleSampler sampler = build(groom, density, 100.0f);
    std::size_t made = 0;
    const Medians medians = interleaved(
        [&] {
            Progress progress;
            made = evenRoots(*groom.mesh, sampler, 5000, 1, progress)->size();
        },
        {});
    return {"sampler/5,000 even guide roots", medians.ours, 0.0, "", 5000.0, "roots", made == 5000, ""};
}

}  // namespace

std::vector<BenchRow> benchSampler() {
    std::vector<BenchRow> rows;
    const Groom plain = groomOf(bunnyRings, {});
    for (const float percent : {0.0f, 13.0f, 25.0f, 50.0f, 100.0f, 200.0f, 400.0f}) {
        rows.push_back(
            samplingRow("sampler/grid " + rounded(static_cast<double>(percent), "%.0f") + " %, 69k triangles, no map",
                        plain, percent));
    }
    rows.push_back(preprocessRow("sampler/preprocess 69k triangles", plain));
    rows.push_back(preprocessRow("sampler/preprocess 202k triangles", groomOf(dragonRings, {})));
    rows.push_back(preprocessRow("sampler/preprocess 1,087k triangles", groomOf(buddhaRings, {})));
    rows.push_back(productionPreprocessRow("sampler/hair roots, preprocess, 69k triangles, no map", plain));
    for (const int size : {512, 1024, 2048}) {
        const Groom groom = groomOf(bunnyRings, noise(size, 0.5));
        const std::string name = rounded(size, "%.0f") + "^2 noise map, 69k triangles";
        rows.push_back(samplingRow("sampler/" + name, groom, 100.0f));
        rows.push_back(preprocessRow("sampler/preprocess " + name, groom));
    }
    const Groom dragon = groomOf(dragonRings, {}), buddha = groomOf(buddhaRings, {});
    rows.push_back(rejectionRow("sampler/69k triangles, no map, against rejection", plain));
    rows.push_back(rejectionRow("sampler/202k triangles, no map, against rejection", dragon));
    rows.push_back(rejectionRow("sampler/1,087k triangles, no map, against rejection", buddha));
    for (const double mean : {0.75, 0.5, 0.25, 0.1})
        rows.push_back(
            rejectionRow("sampler/noise map of mean " + rounded(mean, "%.2f"), groomOf(bunnyRings, noise(1024, mean))));
    rows.push_back(guidesRow());
    rows.push_back(evenRow(plain, 20000));
    for (const int size : {512, 1024, 2048}) {
        const Groom groom = groomOf(bunnyRings, noise(size, 0.5));
        const std::string map = rounded(size, "%.0f") + "^2 noise map";
        rows.push_back(productionRow("sampler/hair roots, 4M, " + map, groom, 4000000));
        rows.push_back(productionRow("sampler/hair roots, 100k, " + map, groom, 100000));
        rows.push_back(productionPreprocessRow("sampler/hair roots, preprocess, " + map, groom));
    }
    return rows;
}

}  // namespace whorl
