// SPDX-License-Identifier: Apache-2.0
#include "editor/cli/bench_grooms.h"

#include "core/base/simd.h"
#include "core/hair/outside.h"
#include "core/hair/reference.h"
#include "core/io/document.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface_point.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace whorl {
namespace {

constexpr int segments = 15;

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

float farthest(const Strands& a, const Strands& b, std::size_t hair) {
    float most = 0.0f;
    for (std::size_t v = a.firstVertex[hair]; v < a.firstVertex[hair + 1]; ++v)
        most = std::max(most, glm::distance(a.positions[v], b.positions[v]));
    return most;
}

// True when a hair of the reference goes as far as `apart` when its curve is moved by the tolerance before it is kept
// outside.
bool jumpsAtTheSkin(const Groom& groom, const Surface& surface, const GenerateOptions& options, const Strands& hairs,
                    std::size_t hair, float apart, float tolerance) {
    Progress progress;
    const SkinGuard guard(surface.sharedSkin());
    const DensityLookup density(groom);
    const Result<RootSampler> sampler = RootSampler::build(groom, density, progress);
    const RootSource source{*groom.mesh, *sampler, density, {}};
    const HairRoot root = rootAt(source, hairs.ids[hair], hairs.roots[hair]);
    const std::vector<HairStage> stages =
        referenceStages(groom, GuideIndex(groom), root, TraitLookup(groom, options.time), &guard, progress);
    const auto kept =
        std::find_if(stages.begin(), stages.end(), [](const HairStage& stage) { return stage.name == "keep outside"; });
    if (kept == stages.end() || kept == stages.begin()) return false;
    const std::vector<glm::vec3>& free = std::prev(kept)->points;
    std::vector<float> ease;
    for (std::size_t v = 0; v < free.size(); ++v) {
        const float t = std::min(1.0f, 4.0f * static_cast<float>(v) / static_cast<float>(free.size() - 1));
        ease.push_back(t * t * (3.0f - 2.0f * t));
    }
    float most = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float way : {-tolerance, tolerance}) {
            std::vector<glm::vec3> moved = free;
            for (std::size_t v = 1; v < moved.size(); ++v) moved[v][axis] += way;
            guard.keepOutside(moved, ease);
            for (std::size_t v = 0; v < moved.size(); ++v)
                most = std::max(most, glm::distance(moved[v], kept->points[v]));
        }
    }
    return most >= apart - tolerance;
}

}  // namespace

Groom benchGroom(BenchGroomOptions options) {
    Groom groom = makeGroom(ball());
    HairParams& p = groom.groups.edit()[0].params;
    p.general.segments = segments;
    p.general.samples = 4;
    p.general.keepOutside = options.outside;
    p.frizz.tip.value = 0.01f;
    p.kink.tip.value = options.kink ? 0.002f : 0.0f;
    Progress progress;
    const DensityLookup density(groom);
    const Result<SubTriangleSampler> sampler =
        SubTriangleSampler::build(*groom.mesh, density, SubTriangleSampler::Options{}, progress);
    static const SkinGuard guard(std::make_shared<const DistanceField>(DistanceField::build(*groom.mesh)));
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

BenchDocument benchDocument(const std::string& sample) {
    std::error_code failed;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
    const std::filesystem::path file = program.parent_path().parent_path() / "samples" / (sample + ".whorl");
    if (!failed && std::filesystem::exists(file, failed)) {
        Progress progress;
        if (auto opened = openDocument(file, progress)) return {"sample " + sample, std::move(opened->groom)};
    }
    return {"ball, as there is no sample " + sample, benchGroom()};
}

Groom inStrands(Groom groom) {
    for (Group& group : groom.groups.edit()) {
        StrandParams& strands = group.params.strands;
        strands.hairs = 16;
        strands.twist.value = 3.0f;
        strands.offset.value = 0.002f;
    }
    return groom;
}

std::uint64_t digestOf(const Strands& strands) {
    Hasher hasher;
    strands.addTo(hasher);
    return hasher.digest();
}

std::shared_ptr<const Strands> made(Generator& generator, const Groom& groom, const GenerateOptions& options) {
    Progress progress;
    auto strands = generator.generateShared(groom, options, progress);
    return strands ? std::move(*strands) : std::make_shared<const Strands>();
}

std::shared_ptr<const Strands> madeAnew(const Groom& groom, const std::shared_ptr<const Surface>& surface,
                                        const GenerateOptions& options) {
    Generator generator;
    generator.setSurface(surface);
    return made(generator, groom, options);
}

Strands slice(const Strands& strands, std::size_t first, std::size_t count) {
    const std::size_t from = strands.firstVertex[first], to = strands.firstVertex[first + count];
    Strands some;
    for (std::size_t i = first + 1; i <= first + count; ++i)
        some.firstVertex.push_back(strands.firstVertex[i] - static_cast<std::uint32_t>(from));
    const auto copy = [](auto& out, const auto& in, std::size_t begin, std::size_t end) {
        out.assign(in.begin() + static_cast<std::ptrdiff_t>(begin), in.begin() + static_cast<std::ptrdiff_t>(end));
    };
    copy(some.ids, strands.ids, first, first + count);
    copy(some.members, strands.members, first, first + count);
    copy(some.roots, strands.roots, first, first + count);
    copy(some.rootUvs, strands.rootUvs, first, first + count);
    copy(some.groups, strands.groups, first, first + count);
    copy(some.positions, strands.positions, from, to);
    copy(some.normals, strands.normals, from, to);
    copy(some.widths, strands.widths, from, to);
    copy(some.colours, strands.colours, from, to);
    return some;
}

bool closeToReference(const Groom& groom, const Surface& surface, const GenerateOptions& options, const Strands& fast,
                      const Strands& reference) {
    if (fast.count() == 0 || fast.ids != reference.ids || fast.members != reference.members ||
        fast.firstVertex != reference.firstVertex)
        return false;
    for (std::size_t hair = 0; hair < fast.count(); ++hair) {
        const std::size_t modifiers = (*groom.groups)[fast.groups[hair]].params.modifiers.size();
        const float tolerance = 3e-6f + 1e-6f * static_cast<float>(modifiers);
        const float apart = farthest(fast, reference, hair);
        if (!(apart < tolerance) && !jumpsAtTheSkin(groom, surface, options, fast, hair, apart, tolerance))
            return false;
    }
    std::size_t turned = 0;
    for (std::size_t v = 0; v < fast.vertexCount(); ++v) {
        if (!(glm::distance(fast.normals[v], reference.normals[v]) < 1e-2f)) ++turned;
        if (!(std::abs(fast.widths[v] - reference.widths[v]) < 1e-6f)) return false;
        if (!(glm::distance(fast.colours[v], reference.colours[v]) < 1e-6f)) return false;
    }
    return turned * 1000 <= fast.vertexCount();
}

BenchRow hairRow(const std::string& name, double hairs, unsigned threads, Medians seconds, const std::string& baseline,
                 const std::string& more) {
    BenchRow row;
    row.name = name;
    row.seconds = seconds.ours;
    row.baselineSeconds = seconds.baseline;
    row.baseline = baseline;
    row.items = hairs;
    row.unit = "hairs";
    row.note = std::to_string(threads) + (threads == 1 ? " thread, " : " threads, ") + simdLevelName(simdLevel());
    if (!more.empty()) row.note += "; " + more;
    return row;
}

}  // namespace whorl
