// SPDX-License-Identifier: Apache-2.0
#include "core/hair/reference_modifiers.h"

#include "core/base/noise.h"
#include "core/base/polynomials.h"
#include "core/hair/curve.h"
#include "core/hair/reference.h"
#include "core/model/modifiers/rows.h"
#include "core/surface/surface_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

using Curve = std::vector<glm::vec3>;

// One modifier on one hair: its numbers at the root, its random numbers, and what is known of the vertices.
struct Work {
    const ReferenceModifiers& with;
    const ModifierStep& step;
    const HairRoot& root;
    const HairTraits& traits;
    std::span<const float> ease;
    std::uint64_t& lock;
    std::vector<float> numbers{};
    float random[ModifierArrays::randomRows] = {};

    float amount() const { return numbers[1]; }
    float along(const Curve& curve, std::size_t v) const {
        return static_cast<float>(v) / static_cast<float>(curve.size() - 1);
    }
};

float bias(float t, float b) {
    return t / ((1.0f / b - 2.0f) * (1.0f - t) + 1.0f);
}

std::vector<float> lengthsOf(const Curve& curve) {
    std::vector<float> lengths{0.0f};
    for (std::size_t v = 1; v < curve.size(); ++v) lengths.push_back(glm::distance(curve[v - 1], curve[v]));
    return lengths;
}

float sumOf(const std::vector<float>& lengths) {
    float sum = 0.0f;
    for (const float length : lengths) sum += length;
    return sum;
}

void giveLengths(Curve& curve, const std::vector<float>& lengths) {
    glm::vec3 direction(0.0f), before = curve[0];
    for (std::size_t v = 1; v < curve.size(); ++v) {
        const glm::vec3 piece = curve[v] - before;
        before = curve[v];
        if (glm::dot(piece, piece) > 1e-24f) direction = glm::normalize(piece);
        curve[v] = curve[v - 1] + direction * lengths[v];
    }
}

// The curve of a centre, as ClumpSet makes it.
Curve centreCurve(const Work& w, const HairRoot& centre) {
    const HairTraits traits = w.with.traits.lockAt(centre);
    Curve curve = referenceInterpolation(w.with.groom, w.with.index, centre,
                                         centre.position + centre.normal * traits.displacement, traits.scale);
    const float amplitude = w.step.numbers[ClumpRows::NoiseAmplitude].at(centre.uv),
                frequency = w.step.numbers[ClumpRows::NoiseFrequency].at(centre.uv);
    float random[ModifierArrays::randomRows], offset[3];
    w.with.chain.random(w.step, ModifierChain::lockKey(centre.id), random);
    w.with.chain.noiseOffset(w.step, offset);
    for (std::size_t v = 1; v < curve.size(); ++v) {
        glm::vec3 noise(0.0f);
        perlinVector(curve[v].x * frequency + offset[0] + 256.0f * random[0],
                     curve[v].y * frequency + offset[1] + 256.0f * random[1],
                     curve[v].z * frequency + offset[2] + 256.0f * random[2], &noise.x);
        curve[v] += amplitude * w.ease[v] * w.along(curve, v) * noise;
    }
    return curve;
}

void clump(Work& w, Curve& curve) {
    const ClumpCentres& centres = w.with.clumps.clumps[w.step.clump];
    std::array<Neighbour, 1> nearest;
    if (centres.empty() || centres.index.nearest(0, w.root.position, w.root.normal, 1, nearest) == 0) return;
    if (w.random[0] < w.numbers[ClumpRows::Flyaways]) return;
    const HairRoot& centre = centres.roots[nearest[0].guide];
    w.lock = ModifierChain::lockKey(centre.id);
    const Curve middle = centreCurve(w, centre);
    const std::vector<float> lengths = lengthsOf(curve);
    for (std::size_t v = 1; v < curve.size(); ++v) {
        const float closed = bias(w.along(curve, v), w.numbers[ClumpRows::Profile]);
        const float tightness = glm::mix(w.numbers[ClumpRows::RootTightness], w.numbers[ClumpRows::Tightness], closed);
        curve[v] = glm::mix(curve[v], middle[v], w.amount() * w.ease[v] * tightness);
    }
    if (w.numbers[ClumpRows::KeepLength] > 0.0f) giveLengths(curve, lengths);
}

void curl(Work& w, Curve& curve) {
    const std::vector<float> lengths = lengthsOf(curve);
    const float variation = w.numbers[CurlRows::Variation];
    const float start = w.numbers[CurlRows::Phase] * w.random[0];
    const float way = w.random[3] < w.numbers[CurlRows::Flips] ? -1.0f : 1.0f;
    const float speed = way * w.numbers[CurlRows::Turns] * (1.0f + variation * (2.0f * w.random[1] - 1.0f));
    const float wide = w.amount() * (1.0f + variation * (2.0f * w.random[2] - 1.0f));
    // Winding begins at x, turned by the smallest rotation from y to the root's direction.
    const glm::vec3 first = strandTangent(curve, 0, glm::vec3(0, 1, 0));
    const float up = 1.0f + first.y;
    const float share = first.x / std::max(up, 1e-3f);
    const Curve normals = referenceNormals(curve, {1.0f - share * first.x, -share * up, -share * first.z});
    Curve wound = curve;
    for (std::size_t v = 1; v < curve.size(); ++v) {
        const float along = w.along(curve, v);
        const double angle = glm::two_pi<double>() * static_cast<double>(start + speed * along);
        const float radius =
            wide * w.ease[v] * glm::mix(w.numbers[CurlRows::RootRadius], w.numbers[CurlRows::TipRadius], along);
        const glm::vec3 across = glm::cross(strandTangent(curve, v, first), normals[v]);
        wound[v] +=
            radius * (static_cast<float>(std::cos(angle)) * normals[v] + static_cast<float>(std::sin(angle)) * across);
    }
    curve = wound;
    if (w.numbers[CurlRows::KeepLength] > 0.0f) giveLengths(curve, lengths);
}

void noise(Work& w, Curve& curve) {
    const std::vector<float> lengths = lengthsOf(curve);
    const glm::vec3 frequency(w.numbers[NoiseRows::Frequency], w.numbers[NoiseRows::Frequency + 1],
                              w.numbers[NoiseRows::Frequency + 2]);
    glm::vec3 offset(0.0f);
    w.with.chain.noiseOffset(w.step, &offset.x);
    const glm::vec3 own(251.0f * w.random[0], 241.0f * w.random[1], 239.0f * w.random[2]);
    const float together = w.numbers[NoiseRows::Correlation];
    const int octaves = static_cast<int>(w.numbers[NoiseRows::Octaves]);
    for (std::size_t v = 1; v < curve.size(); ++v) {
        glm::vec3 push(0.0f);
        float scale = 1.0f, share = 1.0f;
        for (int octave = 0; octave < octaves; ++octave, scale *= 2.0f, share *= 0.5f) {
            const glm::vec3 place = curve[v] * frequency * scale + offset, alone = place + own;
            glm::vec3 a(0.0f), b(0.0f);
            perlinVector(place.x, place.y, place.z, &a.x);
            perlinVector(alone.x, alone.y, alone.z, &b.x);
            push += share * glm::mix(b, a, together);
        }
        const float amplitude =
            glm::mix(w.numbers[NoiseRows::RootAmplitude], w.numbers[NoiseRows::TipAmplitude], w.along(curve, v));
        curve[v] += w.amount() * w.ease[v] * amplitude * push;
    }
    if (w.numbers[NoiseRows::KeepLength] > 0.0f) giveLengths(curve, lengths);
}

void bend(Work& w, Curve& curve) {
    const std::vector<float> lengths = lengthsOf(curve);
    const glm::vec3 direction(w.numbers[BendRows::Direction], w.numbers[BendRows::Direction + 1],
                              w.numbers[BendRows::Direction + 2]);
    if (glm::dot(direction, direction) <= 1e-12f) return;
    const glm::vec3 down = glm::normalize(direction);
    const float usual = w.with.groom.groups->at(w.root.group).params.general.rootThickness.value;
    const float thickness = std::max(usual > 0.0f ? w.traits.thickness / usual : 1.0f, 0.05f);
    const float heavy =
        1.0f + w.numbers[BendRows::ByLength] * (sumOf(lengths) / w.numbers[BendRows::ReferenceLength] - 1.0f);
    const float weak = 1.0f + w.numbers[BendRows::ByThickness] * (1.0f / (thickness * thickness) - 1.0f);
    const float force = w.amount() * w.numbers[BendRows::Strength] * heavy * weak;
    const float late = std::clamp(1.0f - w.numbers[BendRows::Stiffness], 0.02f, 0.98f);
    if (!(force > 0.0f)) return;
    const Curve old = curve;
    for (std::size_t v = 1; v < curve.size(); ++v) {
        const glm::vec3 piece = old[v] - old[v - 1];
        const float middle = 0.5f * (w.along(curve, v - 1) + w.along(curve, v));
        const glm::vec3 turned = piece + down * (lengths[v] * force * bias(middle, late));
        const bool turns = glm::dot(turned, turned) > 1e-24f;
        curve[v] = curve[v - 1] + (turns ? glm::normalize(turned) * lengths[v] : piece);
    }
}

void length(Work& w, Curve& curve) {
    const std::vector<float> lengths = lengthsOf(curve);
    const float whole = sumOf(lengths);
    const bool absolute = w.numbers[LengthRows::Mode] > 0.5f;
    const float wanted = !absolute       ? w.numbers[LengthRows::Factor]
                         : whole > 1e-6f ? w.numbers[LengthRows::Length] / whole
                                         : 1.0f;
    const float shortened = wanted * (1.0f - w.numbers[LengthRows::Random] * w.random[0]);
    const float share = 1.0f + w.amount() * (shortened - 1.0f);
    const Curve old = curve;
    float reached = static_cast<float>(curve.size() - 1);
    const bool cut = w.numbers[LengthRows::Method] > 0.5f;
    if (cut && share < 1.0f) {
        float way = 0.0f;
        reached = 0.0f;
        for (const float piece : std::span(lengths).subspan(1)) {
            const float left = share * whole - way;
            reached += piece > 0.0f ? std::clamp(left / piece, 0.0f, 1.0f) : left > 0.0f ? 1.0f : 0.0f;
            way += piece;
        }
    }
    for (std::size_t v = 1; v < curve.size(); ++v) {
        curve[v] = cut ? strandPoint(old, reached * w.along(curve, v)) : old[0] + share * (old[v] - old[0]);
    }
}

void smooth(Work& w, Curve& curve) {
    const std::vector<float> lengths = lengthsOf(curve);
    const float share = 0.5f * w.amount() * w.numbers[SmoothRows::Strength];
    for (int step = 0; step < static_cast<int>(w.numbers[SmoothRows::Iterations]); ++step) {
        const Curve old = curve;
        for (std::size_t v = 1; v + 1 < curve.size(); ++v)
            curve[v] = glm::mix(old[v], 0.5f * (old[v - 1] + old[v + 1]), share);
    }
    if (w.numbers[SmoothRows::KeepLength] > 0.0f) giveLengths(curve, lengths);
}

void straighten(Work& w, Curve& curve) {
    const std::vector<float> lengths = lengthsOf(curve);
    const float whole = sumOf(lengths), chord = glm::distance(curve.front(), curve.back());
    if (!(chord > 1e-3f * whole && chord > 1e-12f)) return;
    const glm::vec3 start = curve.front(), direction = (curve.back() - start) / chord;
    const bool keep = w.numbers[StraightenRows::KeepLength] > 0.0f;
    float way = 0.0f;
    for (std::size_t v = 1; v < curve.size(); ++v) {
        way += lengths[v];
        const float weight =
            w.amount() * glm::mix(w.numbers[StraightenRows::Root], w.numbers[StraightenRows::Tip], w.along(curve, v));
        curve[v] = glm::mix(curve[v], start + direction * (keep ? way : way * chord / whole), weight);
    }
    if (keep) giveLengths(curve, lengths);
}

}  // namespace

std::vector<glm::vec3> referenceInterpolation(const Groom& groom, const GuideIndex& index, const HairRoot& root,
                                              const glm::vec3& start, float scale) {
    const GeneralParams& general = (*groom.groups)[root.group].params.general;
    std::array<Neighbour, GuideIndex::maxNeighbours> neighbours;
    const std::size_t count = index.guidesOf(root.group, general, root.position, root.normal, neighbours);
    if (count == 0) return {};
    const auto segments = static_cast<std::size_t>(general.segments);
    Curve curve(segments + 1, start);
    for (std::size_t j = 0; j < count; ++j) {
        const std::span<const glm::vec3> given = groom.guides.points(neighbours[j].guide);
        const Curve guide =
            given.size() == segments + 1 ? Curve(given.begin(), given.end()) : resampled(given, general.segments);
        const glm::mat3 turn = general.interpolation.index == 0
                                   ? minimalRotation(neighbours[j].root->normal, root.normal)
                                   : glm::mat3(1.0f);
        for (std::size_t v = 0; v <= segments; ++v)
            curve[v] += scale * neighbours[j].weight * (turn * (guide[v] - guide[0]));
    }
    return curve;
}

void modifyReference(const ReferenceModifiers& with, const HairRoot& root, const HairTraits& traits,
                     std::span<const float> ease, std::vector<glm::vec3>& curve, std::vector<HairStage>* stages) {
    std::uint64_t lock = ModifierChain::hairKey(root.id);
    for (const ModifierStep& step : with.chain.shapes(root.group)) {
        Work work{with, step, root, traits, ease, lock};
        for (const ModifierNumber& number : step.numbers) work.numbers.push_back(number.at(root.uv));
        if (!(work.amount() > 0.0f)) continue;
        with.chain.random(step, step.shared ? lock : ModifierChain::hairKey(root.id), work.random);
        using Run = void (*)(Work&, Curve&);
        constexpr Run runs[modifierKindCount] = {clump, curl, noise, bend, length, smooth, straighten, nullptr};
        if (!runs[step.kind]) continue;
        runs[step.kind](work, curve);
        if (stages) stages->push_back({std::string(modifierKinds()[step.kind].id), curve});
    }
}

std::vector<glm::vec3> referenceMember(std::span<const glm::vec3> base, std::span<const glm::vec3> normals,
                                       const HairRoot& root, const HairTraits& traits, std::span<const float> ease,
                                       float across, float up, float lift) {
    Curve points;
    for (std::size_t v = 0; v < base.size(); ++v) {
        const float along = static_cast<float>(v) / static_cast<float>(base.size() - 1);
        const float splay = traits.splay[0] + (traits.splay[1] - traits.splay[0]) * smoothStep(2.0f * along) +
                            (traits.splay[2] - traits.splay[1]) * smoothStep(2.0f * along - 1.0f);
        const double angle = glm::two_pi<double>() * static_cast<double>(traits.twistTurns * along);
        const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
        const glm::vec3 sideways = glm::cross(strandTangent(base, v, root.normal), normals[v]);
        glm::vec3 away = splay * (across * (c * sideways + s * normals[v]) + up * (c * normals[v] - s * sideways));
        // Roots stay on the skin.
        away -= root.normal * ((1.0f - ease[v]) * glm::dot(away, root.normal));
        points.push_back(base[v] + away + lift * traits.memberOffset * along * along * normals[v]);
    }
    return points;
}

std::vector<glm::vec3> referenceMemberNormals(std::span<const glm::vec3> points, std::span<const glm::vec3> normals) {
    Curve turned;
    glm::vec3 tangent(0.0f);
    for (std::size_t v = 0; v < points.size(); ++v) {
        tangent = strandTangent(points, v, tangent);
        turned.push_back(acrossTangent(normals[v], tangent, 1e-6f));
    }
    return turned;
}

}  // namespace whorl
