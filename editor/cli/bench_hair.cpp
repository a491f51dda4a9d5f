// SPDX-License-Identifier: Apache-2.0
// Generation against the scalar reference: from nothing, cached, and after a stroke.
#include "core/base/parallel.h"
#include "core/base/simd.h"
#include "core/hair/bindings.h"
#include "core/hair/generate.h"
#include "core/hair/outside.h"
#include "core/hair/reference.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface_point.h"
#include "editor/cli/bench.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

constexpr int segments = 15;

// A ball of 9 cm with 69,120 triangles, about a head.
SurfaceMesh ball() {
    constexpr int rings = 144, sectors = 240;
    SurfaceMesh mesh;
    for (int r = 0; r <= rings; ++r) {
        const float polar = glm::pi<float>() * static_cast<float>(r) / rings;
        for (int s = 0; s <= sectors; ++s) {
            const float turn = 2.0f * glm::pi<float>() * static_cast<float>(s) / sectors;
            const glm::vec3 n(std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn));
            mesh.positions.push_back(n * 0.09f);
            mesh.normals.push_back(n);
        }
    }
    const auto uv = [](std::uint32_t v) {
        return glm::vec2(static_cast<float>(v % (sectors + 1)) / sectors,
                         1.0f - static_cast<float>(v / (sectors + 1)) / rings);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.emplace_back(a, b, c);
        for (const std::uint32_t v : {a, b, c}) mesh.cornerUvs.push_back(uv(v));
    };
    for (std::uint32_t r = 0; r < rings; ++r) {
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const std::uint32_t a = r * (sectors + 1) + s, b = a + sectors + 1;
            if (r > 0) add(a, b, a + 1);
            if (r + 1 < rings) add(a + 1, b, b + 1);
        }
    }
    mesh.parts = {{"ball", 0, mesh.triangleCount()}};
    return mesh;
}

// 2,000 guides of 16 vertices that fall and wave, four of them to a hair.
Groom benchGroom(bool outside, bool kink) {
    Groom groom = makeGroom(ball());
    HairParams& p = groom.groups.edit()[0].params;
    p.general.segments = segments;
    p.general.samples = 4;
    p.general.keepOutside = outside;
    p.frizz.tip.value = 0.01f;
    p.kink.tip.value = kink ? 0.002f : 0.0f;
    Progress progress;
    const DensityLookup density(groom);
    const Result<SubTriangleSampler> sampler =
        SubTriangleSampler::build(*groom.mesh, density, SubTriangleSampler::Options{}, progress);
    const SkinGuard guard(std::make_shared<const DistanceField>(DistanceField::build(*groom.mesh)));
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const SurfacePoint root = sampler->stratifiedRoot(i, 2000, 7);
        const glm::vec3 start = positionAt(*groom.mesh, root), normal = normalAt(*groom.mesh, root);
        std::vector<glm::vec3> points;
        std::vector<float> ease;
        for (int v = 0; v <= segments; ++v) {
            const float t = static_cast<float>(v) / segments;
            points.push_back(start + normal * (0.04f * t) + glm::vec3(0.004f * std::sin(9.0f * t), -0.12f * t * t, 0));
            ease.push_back(std::min(1.0f, 4.0f * t));
        }
        // As the comb leaves them.
        guard.keepOutside(points, ease);
        groom.guides.append(root, 0, points);
    }
    return groom;
}

std::uint64_t digestOf(const Strands& strands) {
    Hasher hasher;
    strands.addTo(hasher);
    return hasher.digest();
}

// Same hairs, each vertex within 1e-5 of a hair's length (0.15 m) and what kink makes of rounding.
bool close(const Strands& a, const Strands& b) {
    if (a.ids != b.ids || a.firstVertex != b.firstVertex) return false;
    for (std::size_t v = 0; v < a.vertexCount(); ++v)
        if (!(glm::distance(a.positions[v], b.positions[v]) < 3e-6f)) return false;
    return true;
}

Strands made(Generator& generator, const Groom& groom, std::uint32_t hairs) {
    Progress progress;
    Result<Strands> strands = generator.generate(groom, {hairs}, progress);
    return strands ? std::move(*strands) : Strands{};
}

// A stroke sample: the points of some neighbouring guides move.
void comb(Groom& groom, std::size_t first, std::size_t guides) {
    for (std::size_t g = first; g < first + guides; ++g)
        for (glm::vec3& p : groom.guides.editPoints(g).subspan(1)) p.x += 0.0005f;
}

BenchRow rowOf(const std::string& name, const Strands& strands, unsigned threads, double seconds, double baseline) {
    BenchRow row;
    row.name = "hair/" + name;
    row.seconds = seconds;
    row.baselineSeconds = baseline;
    row.items = static_cast<double>(strands.count());
    row.unit = "hairs";
    row.note = std::to_string(threads) + (threads == 1 ? " thread, " : " threads, ") + simdLevelName(simdLevel());
    return row;
}

// All of `hairs` and all that leads to them, against the reference.
BenchRow fromNothing(const std::string& name, const Groom& groom, std::uint32_t hairs, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    Progress progress;
    Strands fast, slow;
    const Medians seconds = interleaved(
        [&] {
            Generator generator;
            generator.setSurface(surface);
            fast = made(generator, groom, hairs);
        },
        [&] { slow = *generateReference(groom, surface, {hairs}, progress); });
    BenchRow row = rowOf(name, fast, threads, seconds.ours, seconds.baseline);
    row.baseline = "scalar reference, one thread";
    row.correct = close(fast, slow) && fast.count() > 0;
    return row;
}

// After a stroke sample on `guides` guides, against everything made again by a fresh generator. Like the viewport, it
// holds the newest hair while the next is made.
BenchRow afterStroke(const std::string& name, Groom groom, std::uint32_t hairs, std::size_t guides, unsigned threads) {
    const ThreadLimit limit(threads);
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    surface->skin();
    Generator kept;
    kept.setSurface(surface);
    Progress progress;
    std::shared_ptr<const Strands> cached = std::make_shared<const Strands>();
    const auto renew = [&] {
        if (auto strands = kept.generateShared(groom, {hairs}, progress)) cached = std::move(*strands);
    };
    renew();
    Strands fresh;
    const Medians seconds = interleaved(
        [&] {
            comb(groom, guides < groom.guides.count() ? 640 : 0, guides);
            renew();
        },
        [&] {
            Generator generator;
            generator.setSurface(surface);
            fresh = made(generator, groom, hairs);
        });
    BenchRow row = rowOf(name, *cached, threads, seconds.ours, seconds.baseline);
    row.baseline = "a fresh generator";
    row.correct = digestOf(*cached) == digestOf(fresh) && cached->count() > 0;
    return row;
}

// Hairs to guides, together against one query after another.
BenchRow binding(const std::string& name, const Groom& groom, std::uint32_t hairs, unsigned threads) {
    const ThreadLimit limit(threads);
    Progress progress;
    const DensityLookup density(groom);
    const auto sampler = RootSampler::build(groom, density, progress);
    const RootRequest request = requestFor(*groom.counts, *sampler, static_cast<double>(hairs));
    const std::vector<HairRoot> roots = makeRoots({*groom.mesh, *sampler, density, request}, {}, progress);
    const GuideIndex index(groom);
    const int samples = (*groom.groups)[0].params.general.samples;
    Bindings bindings;
    std::vector<Neighbour> plain(roots.size() * static_cast<std::size_t>(samples));
    std::vector<glm::mat3> turns(plain.size());
    const Medians seconds = interleaved(
        [&] { bindings = bindHairs(groom, index, roots, progress, std::move(bindings)); },
        [&] {
            parallelFor(roots.size(), 1024, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const std::size_t first = i * static_cast<std::size_t>(samples);
                    const std::size_t count =
                        index.nearest(0, roots[i].position, roots[i].normal, samples,
                                      std::span(plain).subspan(first, static_cast<std::size_t>(samples)));
                    for (std::size_t j = first; j < first + count; ++j)
                        turns[j] = plain[j].weight * minimalRotation(plain[j].root->normal, roots[i].normal);
                }
            });
        });
    BenchRow row;
    row.name = "hair/" + name;
    row.seconds = seconds.ours;
    row.baselineSeconds = seconds.baseline;
    row.baseline = "a query of the KD-tree a hair";
    row.items = static_cast<double>(roots.size());
    row.unit = "hairs";
    row.note = std::to_string(threads) + (threads == 1 ? " thread, " : " threads, ") + simdLevelName(simdLevel());
    for (std::size_t j = 0; j < plain.size(); ++j) {
        row.correct = row.correct && bindings.guides[j] == plain[j].guide &&
                      std::abs(bindings.matrices[j * 9] - turns[j][0][0]) < 3e-6f;
    }
    return row;
}

}  // namespace

std::vector<BenchRow> benchHair() {
    const Groom plain = benchGroom(false, false), outside = benchGroom(true, false), kinked = benchGroom(true, true);
    return {
        binding("binding 100k", plain, 100000, 1),
        binding("binding 1600k", plain, 1600000, 1),
        fromNothing("100k x 16 from nothing", plain, 100000, 1),
        fromNothing("100k x 16 from nothing, outside the skin", outside, 100000, 1),
        fromNothing("100k x 16 from nothing, outside the skin and kinked", kinked, 100000, 1),
        fromNothing("100k x 16 from nothing, outside the skin and kinked", kinked, 100000, 2),
        afterStroke("10k x 16, all guides combed", plain, 10000, 2000, 1),
        afterStroke("10k x 16, all guides combed, outside the skin", outside, 10000, 2000, 1),
        afterStroke("10k x 16, all guides combed, outside the skin and kinked", kinked, 10000, 2000, 1),
        afterStroke("10k x 16, 64 guides combed, outside the skin", outside, 10000, 64, 1),
        afterStroke("100k x 16, all guides combed, outside the skin", outside, 100000, 2000, 1),
        afterStroke("100k x 16, 64 guides combed, outside the skin", outside, 100000, 64, 1),
        afterStroke("100k x 16, 64 guides combed, outside the skin", outside, 100000, 64, 2),
    };
}

}  // namespace whorl
