// SPDX-License-Identifier: Apache-2.0
#include "core/hair/reference.h"

#include "core/base/noise.h"
#include "core/base/polynomials.h"
#include "core/hair/curve.h"
#include "core/hair/evaluator.h"
#include "core/hair/guide_index.h"
#include "core/hair/outside.h"
#include "core/hair/reference_modifiers.h"
#include "core/hair/roots.h"
#include "core/hair/thin.h"
#include "core/hair/traits.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace whorl {
namespace {

// What one hair after another is made with.
struct Reference {
    const Groom& groom;
    const GuideIndex& index;
    const TraitLookup& lookup;
    const ModifierChain& chain;
    const ClumpSet& clumps;
    const SkinGuard* skin;
};

std::vector<float> easeOf(int segments) {
    std::vector<float> ease;
    for (int v = 0; v <= segments; ++v)
        ease.push_back(smoothStep(4.0f * static_cast<float>(v) / static_cast<float>(segments)));
    return ease;
}

// The curve of a hair before strands and cutting. `stages`, when not null, gets it after each step.
std::vector<glm::vec3> referenceCurve(const Reference& r, const HairRoot& root, const HairTraits& traits,
                                      std::vector<HairStage>* stages = nullptr) {
    const GeneralParams& general = (*r.groom.groups)[root.group].params.general;
    const glm::vec3 start = root.position + root.normal * traits.displacement;
    std::vector<glm::vec3> curve = referenceInterpolation(r.groom, r.index, root, start, traits.scale);
    if (curve.empty()) return curve;
    const auto done = [&](const char* stage) {
        if (stages) stages->push_back({stage, curve});
    };
    if (stages) stages->push_back({"interpolation", referenceInterpolation(r.groom, r.index, root, start, 1.0f)});
    done("scale");
    const glm::vec3 frizz(traits.frizz[0], traits.frizz[1], traits.frizz[2]);
    const glm::vec3 frequency(traits.kinkFrequency[0], traits.kinkFrequency[1], traits.kinkFrequency[2]);
    const std::vector<float> ease = easeOf(general.segments);
    // Both pushes start from the curve before either.
    std::vector<glm::vec3> kinks;
    for (std::size_t v = 0; v < curve.size(); ++v) {
        const float along = static_cast<float>(v) / static_cast<float>(general.segments);
        const glm::vec3 place = curve[v] * frequency + r.lookup.kinkOffset();
        glm::vec3 kink(0.0f);
        perlinVector(place.x, place.y, place.z, &kink.x);
        kinks.push_back(ease[v] * glm::mix(traits.kinkRoot, traits.kinkTip, along) * kink);
        curve[v] += ease[v] * glm::mix(traits.frizzRoot, traits.frizzTip, along) * frizz;
    }
    done("frizz");
    for (std::size_t v = 0; v < curve.size(); ++v) curve[v] += kinks[v];
    done("kink");
    modifyReference({r.groom, r.index, r.lookup, r.chain, r.clumps}, root, traits, ease, curve, stages);
    if (general.keepOutside && r.skin) {
        r.skin->keepOutside(curve, ease);
        done("keep outside");
    }
    return curve;
}

// A cut curve with its normals.
struct Cut {
    std::vector<glm::vec3> points;
    std::vector<glm::vec3> normals;
};

Cut cutAt(std::span<const glm::vec3> curve, const CutEnd& end) {
    Cut cut;
    cut.points.assign(curve.begin(), curve.begin() + end.vertices);
    cut.points.back() = strandPoint(curve, end.parameter);
    return cut;
}

void addStrand(const Reference& r, Strands& strands, const Cut& hair, const HairRoot& root, const HairTraits& traits,
               std::uint32_t member) {
    const int segments = (*r.groom.groups)[root.group].params.general.segments;
    const CutEnd end = cutEnd(traits.cut, segments);
    std::vector<float> looks;
    lookNumbers(r.chain, root.group, root.uv, looks);
    for (std::size_t v = 0; v < hair.points.size(); ++v) {
        const float place = v + 1 < hair.points.size() ? static_cast<float>(v) : end.parameter;
        const float along = place / static_cast<float>(segments);
        strands.positions.push_back(hair.points[v]);
        strands.normals.push_back(hair.normals[v]);
        strands.widths.push_back(glm::mix(traits.rootWidth, traits.tipWidth, along) * taperAt(looks, along));
        glm::vec4 colour(0.0f);
        for (int i = 0; i < 4; ++i) colour[i] = glm::mix(traits.rootColour[i], traits.tipColour[i], along);
        strands.colours.push_back(colour);
    }
    strands.firstVertex.push_back(static_cast<std::uint32_t>(strands.positions.size()));
    strands.ids.push_back(root.id);
    strands.members.push_back(static_cast<std::uint8_t>(member));
    strands.roots.push_back(root.point);
    strands.rootUvs.push_back(root.uv);
    strands.groups.push_back(root.group);
}

// The hair, or its strand.
void addHair(const Reference& r, Strands& strands, std::span<const glm::vec3> curve, const HairRoot& root,
             const HairTraits& traits) {
    const HairParams& params = (*r.groom.groups)[root.group].params;
    const CutEnd end = cutEnd(traits.cut, params.general.segments);
    const auto members = static_cast<std::uint32_t>(params.strands.hairs);
    if (members == 0) {
        Cut hair = cutAt(curve, end);
        hair.normals = referenceNormals(hair.points, root.normal);
        addStrand(r, strands, hair, root, traits, 0);
        return;
    }
    const std::vector<glm::vec3> normals = referenceNormals(curve, root.normal);
    const std::vector<glm::vec3> cutNormals = cutAt(normals, end).points;
    const auto seed = static_cast<std::uint32_t>(r.groom.counts->seed);
    for (std::uint32_t member = 0; member < members; ++member) {
        const MemberPlace place =
            memberPlace(seed, root.id, member, members, traits.memberRandomise, traits.memberAspect);
        Cut hair = cutAt(referenceMember(curve, normals, root, traits, easeOf(params.general.segments), place.across,
                                         place.up, place.lift),
                         end);
        hair.normals = referenceMemberNormals(hair.points, cutNormals);
        addStrand(r, strands, hair, root, traits, member);
    }
}

glm::vec3 reflected(const glm::vec3& r, const glm::vec3& across, float least) {
    const float squared = glm::dot(across, across);
    return squared > least ? r - across * (2.0f / squared * glm::dot(across, r)) : r;
}

}  // namespace

glm::vec3 acrossTangent(const glm::vec3& r, const glm::vec3& tangent, float least) {
    const glm::vec3 part = r - tangent * glm::dot(r, tangent);
    if (glm::dot(part, part) > least) return glm::normalize(part);
    const glm::vec3 axis = std::abs(tangent.y) > 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - tangent * glm::dot(axis, tangent));
}

std::vector<glm::vec3> referenceNormals(std::span<const glm::vec3> points, const glm::vec3& surfaceNormal) {
    std::vector<glm::vec3> normals;
    glm::vec3 before = strandTangent(points, 0, surfaceNormal);
    normals.push_back(acrossTangent(surfaceNormal, before, 1e-4f));
    for (std::size_t v = 1; v < points.size(); ++v) {
        const glm::vec3 tangent = strandTangent(points, v, before);
        const glm::vec3 chord = points[v] - points[v - 1];
        const glm::vec3 carried = reflected(normals.back(), chord, 1e-24f);
        const glm::vec3 turned = reflected(before, chord, 1e-24f);
        normals.push_back(acrossTangent(reflected(carried, tangent - turned, 1e-12f), tangent, 1e-6f));
        before = tangent;
    }
    return normals;
}

std::vector<HairStage> referenceStages(const Groom& groom, const GuideIndex& index, const HairRoot& root,
                                       const TraitLookup& lookup, const SkinGuard* skin, Progress& progress) {
    const ModifierChain chain(groom);
    ClumpSet clumps;
    clumps.build(groom, chain, index, GuideShapes(groom), true, progress);
    std::vector<HairStage> stages;
    const HairTraits traits = lookup.at(root);
    const std::vector<glm::vec3> curve =
        referenceCurve({groom, index, lookup, chain, clumps, skin}, root, traits, &stages);
    const CutEnd end = cutEnd(traits.cut, (*groom.groups)[root.group].params.general.segments);
    if (curve.empty() || end.vertices == 0) return stages;
    std::vector<glm::vec3> points(curve.begin(), curve.begin() + end.vertices);
    points.back() = strandPoint(curve, end.parameter);
    stages.push_back({"cut", std::move(points)});
    return stages;
}

Result<Strands> generateReference(const Groom& groom, std::shared_ptr<const Surface> surface,
                                  const GenerateOptions& options, Progress& progress) {
    const DensityLookup density(groom);
    const Result<RootSampler> sampler = RootSampler::build(groom, density, progress);
    if (!sampler) return sampler.error();
    Strands strands;
    if (sampler->empty()) return strands;
    const GuideIndex index(groom);
    const TraitLookup lookup(groom, options.time);
    const ModifierChain chain(groom);
    ClumpSet clumps;
    clumps.build(groom, chain, index, GuideShapes(groom), true, progress);
    const bool outside = std::any_of(groom.groups->begin(), groom.groups->end(),
                                     [](const Group& group) { return group.params.general.keepOutside; });
    const std::optional<SkinGuard> guard = outside ? std::optional<SkinGuard>(surface->sharedSkin()) : std::nullopt;
    const Reference reference{groom, index, lookup, chain, clumps, guard ? &*guard : nullptr};

    const float lod = std::clamp(options.lod, 0.0f, 1.0f);
    const double hairs = options.hairCount ? static_cast<double>(*options.hairCount) : groom.counts->hairs;
    const RootSource source{*groom.mesh, *sampler, density,
                            requestFor(*groom.counts, *sampler, hairs, static_cast<double>(lod))};
    for (const HairRoot& root : makeRoots(source, sampler->part(options.part, options.partCount), progress)) {
        if (progress.cancelled()) return cancelledError();
        HairTraits traits = lookup.at(root);
        if (lod < 1.0f) widen(traits, lod);
        const int segments = (*groom.groups)[root.group].params.general.segments;
        if (cutEnd(traits.cut, segments).vertices == 0 || !(traits.scale > 0.0f)) continue;
        const std::vector<glm::vec3> curve = referenceCurve(reference, root, traits);
        if (!curve.empty()) addHair(reference, strands, curve, root, traits);
    }
    return skipsVertices(groom) ? thinned(strands, groom) : strands;
}

}  // namespace whorl
