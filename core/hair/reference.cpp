// SPDX-License-Identifier: Apache-2.0
#include "core/hair/reference.h"

#include "core/base/noise.h"
#include "core/base/polynomials.h"
#include "core/hair/curve.h"
#include "core/hair/guide_index.h"
#include "core/hair/outside.h"
#include "core/hair/roots.h"
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

// The curve of a hair before cutting.
std::vector<glm::vec3> referenceCurve(const Groom& groom, const GuideIndex& index, const HairRoot& root,
                                      const HairTraits& traits, const glm::vec3& kinkOffset, const SkinGuard* skin) {
    const GeneralParams& general = (*groom.groups)[root.group].params.general;
    std::array<Neighbour, GuideIndex::maxNeighbours> neighbours;
    const std::size_t count = index.nearest(root.group, root.position, root.normal, general.samples, neighbours);
    if (count == 0) return {};

    const auto segments = static_cast<std::size_t>(general.segments);
    const glm::vec3 start = root.position + root.normal * traits.displacement;
    std::vector<glm::vec3> curve(segments + 1, start);
    for (std::size_t j = 0; j < count; ++j) {
        const std::span<const glm::vec3> given = groom.guides.points(neighbours[j].guide);
        const std::vector<glm::vec3> guide = given.size() == segments + 1
                                                 ? std::vector<glm::vec3>(given.begin(), given.end())
                                                 : resampled(given, general.segments);
        const glm::mat3 turn = general.interpolation.index == 0
                                   ? minimalRotation(neighbours[j].root->normal, root.normal)
                                   : glm::mat3(1.0f);
        for (std::size_t v = 0; v <= segments; ++v)
            curve[v] += traits.scale * neighbours[j].weight * (turn * (guide[v] - guide[0]));
    }

    const glm::vec3 frizz(traits.frizz[0], traits.frizz[1], traits.frizz[2]);
    const glm::vec3 frequency(traits.kinkFrequency[0], traits.kinkFrequency[1], traits.kinkFrequency[2]);
    std::vector<float> ease;
    for (std::size_t v = 0; v <= segments; ++v) {
        const float along = static_cast<float>(v) / static_cast<float>(segments);
        ease.push_back(smoothStep(4.0f * along));
        const glm::vec3 place = curve[v] * frequency + kinkOffset;
        glm::vec3 kink(0.0f);
        perlinVector(place.x, place.y, place.z, &kink.x);
        curve[v] += ease[v] * (glm::mix(traits.frizzRoot, traits.frizzTip, along) * frizz +
                               glm::mix(traits.kinkRoot, traits.kinkTip, along) * kink);
    }
    if (general.keepOutside && skin) skin->keepOutside(curve, ease);
    return curve;
}

void addVertices(Strands& strands, std::span<const glm::vec3> curve, const HairRoot& root, const HairTraits& traits,
                 int segments) {
    const CutEnd end = cutEnd(traits.cut, segments);
    std::vector<glm::vec3> points(curve.begin(), curve.begin() + end.vertices);
    points.back() = strandPoint(curve, end.parameter);
    const std::vector<glm::vec3> normals = referenceNormals(points, root.normal);
    for (std::size_t v = 0; v < points.size(); ++v) {
        const float place = v + 1 < points.size() ? static_cast<float>(v) : end.parameter;
        const float along = place / static_cast<float>(segments);
        strands.positions.push_back(points[v]);
        strands.normals.push_back(normals[v]);
        strands.widths.push_back(glm::mix(traits.rootWidth, traits.tipWidth, along));
        glm::vec4 colour(0.0f);
        for (int i = 0; i < 4; ++i) colour[i] = glm::mix(traits.rootColour[i], traits.tipColour[i], along);
        strands.colours.push_back(colour);
    }
    strands.firstVertex.push_back(static_cast<std::uint32_t>(strands.positions.size()));
    strands.ids.push_back(root.id);
    strands.roots.push_back(root.point);
    strands.rootUvs.push_back(root.uv);
    strands.groups.push_back(root.group);
}

// The part of `r` across `tangent`, unit length.
glm::vec3 across(const glm::vec3& r, const glm::vec3& tangent, float least) {
    const glm::vec3 part = r - tangent * glm::dot(r, tangent);
    if (glm::dot(part, part) > least) return glm::normalize(part);
    const glm::vec3 axis = std::abs(tangent.y) > 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - tangent * glm::dot(axis, tangent));
}

glm::vec3 reflected(const glm::vec3& r, const glm::vec3& across, float least) {
    const float squared = glm::dot(across, across);
    return squared > least ? r - across * (2.0f / squared * glm::dot(across, r)) : r;
}

}  // namespace

std::vector<glm::vec3> referenceNormals(std::span<const glm::vec3> points, const glm::vec3& surfaceNormal) {
    std::vector<glm::vec3> normals;
    glm::vec3 before = strandTangent(points, 0, surfaceNormal);
    normals.push_back(across(surfaceNormal, before, 1e-4f));
    for (std::size_t v = 1; v < points.size(); ++v) {
        const glm::vec3 tangent = strandTangent(points, v, before);
        const glm::vec3 chord = points[v] - points[v - 1];
        const glm::vec3 carried = reflected(normals.back(), chord, 1e-24f);
        const glm::vec3 turned = reflected(before, chord, 1e-24f);
        normals.push_back(across(reflected(carried, tangent - turned, 1e-12f), tangent, 1e-6f));
        before = tangent;
    }
    return normals;
}

Result<Strands> generateReference(const Groom& groom, std::shared_ptr<const Surface> surface,
                                  const GenerateOptions& options, Progress& progress) {
    const DensityLookup density(groom);
    const Result<RootSampler> sampler = RootSampler::build(groom, density, progress);
    if (!sampler) return sampler.error();
    Strands strands;
    if (sampler->empty()) return strands;
    const GuideIndex index(groom);
    const TraitLookup lookup(groom);
    const bool outside = std::any_of(groom.groups->begin(), groom.groups->end(),
                                     [](const Group& group) { return group.params.general.keepOutside; });
    const std::optional<SkinGuard> guard = outside ? std::optional<SkinGuard>(surface->sharedSkin()) : std::nullopt;
    const SkinGuard* skin = guard ? &*guard : nullptr;

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
        const std::vector<glm::vec3> curve = referenceCurve(groom, index, root, traits, lookup.kinkOffset(), skin);
        if (!curve.empty()) addVertices(strands, curve, root, traits, segments);
    }
    return strands;
}

}  // namespace whorl
