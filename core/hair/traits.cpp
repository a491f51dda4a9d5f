// SPDX-License-Identifier: Apache-2.0
#include "core/hair/traits.h"

#include "core/base/noise.h"
#include "core/base/polynomials.h"
#include "core/base/random.h"
#include "core/hair/numbers.kernel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

float finiteOr(float value, float otherwise) {
    return std::isfinite(value) ? value : otherwise;
}

glm::vec3 limitedTo(float most, const glm::vec3& numbers) {
    glm::vec3 limited(0.0f);
    for (int axis = 0; axis < 3; ++axis) limited[axis] = std::clamp(finiteOr(numbers[axis], 0.0f), 0.0f, most);
    return limited;
}

float random(std::uint32_t seed, std::uint64_t index, HairChannel channel) {
    return randomFloat(seed, index, static_cast<std::uint32_t>(channel));
}

// Uniform in -1 to 1.
float spread(std::uint32_t seed, std::uint64_t index, HairChannel channel) {
    return 2.0f * random(seed, index, channel) - 1.0f;
}

glm::vec3 noiseOffset(std::uint32_t seed, std::uint64_t which) {
    glm::vec3 offset(0.0f);
    for (int axis = 0; axis < 3; ++axis)
        offset[axis] = 256.0f * random(seed, which * 3 + static_cast<std::uint64_t>(axis), HairChannel::NoiseOffset);
    return offset;
}

// Turns the hue by `angle` about the grey axis and scales by `brightness`; nothing goes below black.
glm::vec3 varied(const glm::vec3& colour, const SinCos& turn, float brightness) {
    const double third = 1.0 / 3, root = 0.57735026918962576;
    const double a = turn.cos + (1 - turn.cos) * third, b = (1 - turn.cos) * third - root * turn.sin,
                 c = (1 - turn.cos) * third + root * turn.sin;
    const double x = double{colour.x}, y = double{colour.y}, z = double{colour.z};
    const glm::vec3 turned(static_cast<float>(a * x + b * y + c * z), static_cast<float>(c * x + a * y + b * z),
                           static_cast<float>(b * x + c * y + a * z));
    return glm::max(turned * brightness, glm::vec3(0.0f));
}

}  // namespace

float TraitLookup::Number::limited(float number) const {
    return std::clamp(finiteOr(number, 0.0f), most < 0.0f ? most : 0.0f, std::abs(most));
}

float TraitLookup::Number::mapped(glm::vec2 uv) const {
    return limited(value * map->sample(uv));
}

glm::vec3 TraitLookup::Vector::mapped(glm::vec2 uv) const {
    return limitedTo(1e5f, value * map->sample(uv));
}

glm::vec3 TraitLookup::Tint::mapped(glm::vec2 uv) const {
    return limitedTo(1e6f, value * map->sampleColour(uv));
}

TraitLookup::TraitLookup(const Groom& groom, float time)
    : m_seed(static_cast<std::uint32_t>(groom.counts->seed)),
      m_time(time),
      m_frizzOffset(noiseOffset(m_seed, 0)),
      m_kinkOffset(noiseOffset(m_seed, 1)) {
    const auto map = [&](const std::string& name) -> const Map* {
        const Map* found = name.empty() ? nullptr : groom.maps.find(name);
        return found && !found->empty() ? found : nullptr;
    };
    // A limit below zero stands for a range on both sides of zero.
    const auto number = [&](const Driven& d, float most) {
        Number n{d.value, map(d.map), most};
        n.even = n.limited(n.value);
        return n;
    };
    const auto vector = [&](const DrivenVector& d) { return Vector{d.value, map(d.map), limitedTo(1e5f, d.value)}; };
    const auto tint = [&](const DrivenColour& d) { return Tint{d.value, map(d.map), limitedTo(1e6f, d.value)}; };
    for (const Group& group : *groom.groups) {
        const HairParams& p = group.params;
        Entry e;
        e.cut = number(p.general.cut, 1.0f);
        e.scale = number(p.general.scale, 100.0f);
        e.randomScale = number(p.general.randomScale, 1.0f);
        e.rootThickness = number(p.general.rootThickness, 0.1f);
        e.tipThickness = number(p.general.tipThickness, 0.1f);
        e.displacement = number(p.general.displacement, -1.0f);
        e.rootColour = tint(p.colour.root);
        e.tipColour = tint(p.colour.tip);
        e.mutant = p.colour.mutant.value;
        e.rootOpacity = number(p.colour.rootOpacity, 1.0f);
        e.tipOpacity = number(p.colour.tipOpacity, 1.0f);
        e.hueVariation = number(p.colour.hueVariation, 3.14159265f);
        e.valueVariation = number(p.colour.valueVariation, 1.0f);
        e.mutants = number(p.colour.mutants, 1.0f);
        e.frizzRoot = number(p.frizz.root, 1.0f);
        e.frizzTip = number(p.frizz.tip, 1.0f);
        e.frizzFrequency = vector(p.frizz.frequency);
        e.kinkRoot = number(p.kink.root, 1.0f);
        e.kinkTip = number(p.kink.tip, 1.0f);
        e.kinkFrequency = vector(p.kink.frequency);
        e.animation = number(p.frizz.animation, 10.0f);
        e.speed = number(p.frizz.speed, 1000.0f);
        const float reach = glm::length(p.frizz.direction.value);
        if (reach > 1e-6f) e.direction = p.frizz.direction.value / reach;
        e.strands = p.strands.hairs > 0;
        e.splay[0] = number(p.strands.rootSplay, 1.0f);
        e.splay[1] = number(p.strands.centreSplay, 1.0f);
        e.splay[2] = number(p.strands.tipSplay, 1.0f);
        e.twist = number(p.strands.twist, -125.66371f);
        e.offset = number(p.strands.offset, -1.0f);
        e.aspect = number(p.strands.aspect, 100.0f);
        e.randomise = number(p.strands.randomise, 1.0f);
        m_groups.push_back(e);
    }
}

HairTraits TraitLookup::at(const HairRoot& root) const {
    HairTraits traits{};
    FrizzPlace place = begin(root, traits, false);
    if (place.wanted) {
        perlinVector(place.at.x, place.at.y, place.at.z, traits.frizz);
        endFrizz(root, place, traits);
    }
    return traits;
}

void TraitLookup::at(std::span<const HairRoot> roots, std::span<HairTraits> traits, bool coloursKnown) const {
    constexpr std::size_t most = 64;
    std::array<FrizzPlace, most> frizz;
    std::array<std::uint8_t, most> which;
    float places[3][most], noise[3][most];
    for (std::size_t first = 0; first < roots.size(); first += most) {
        const std::size_t end = std::min(first + most, roots.size());
        std::size_t count = 0;
        for (std::size_t i = first; i < end; ++i) {
            const FrizzPlace place = begin(roots[i], traits[i], coloursKnown);
            if (!place.wanted) continue;
            frizz[count] = place;
            which[count] = static_cast<std::uint8_t>(i - first);
            for (int axis = 0; axis < 3; ++axis) places[axis][count] = place.at[axis];
            ++count;
        }
        const float* const in[3] = {places[0], places[1], places[2]};
        float* const out[3] = {noise[0], noise[1], noise[2]};
        WHORL_PICK(noiseVectors)(in, count, out);
        for (std::size_t n = 0; n < count; ++n) {
            HairTraits& t = traits[first + which[n]];
            for (int axis = 0; axis < 3; ++axis) t.frizz[axis] = noise[axis][n];
            endFrizz(roots[first + which[n]], frizz[n], t);
        }
    }
}

// All but what frizz takes from noise.
TraitLookup::FrizzPlace TraitLookup::begin(const HairRoot& root, HairTraits& t, bool coloursKnown) const {
    const Entry& e = m_groups[root.group];
    HairTraits empty{};
    if (coloursKnown) {
        std::copy_n(t.rootColour, 4, empty.rootColour);
        std::copy_n(t.tipColour, 4, empty.tipColour);
    }
    t = empty;
    t.cut = e.cut.at(root.uv);
    t.scale = e.scale.at(root.uv);
    if (const float spoilt = e.randomScale.at(root.uv); spoilt > 0.0f)
        t.scale *= 1.0f - spoilt * random(m_seed, root.id, HairChannel::Scale);
    t.displacement = e.displacement.at(root.uv);
    t.rootWidth = e.rootThickness.at(root.uv);
    t.thickness = t.rootWidth;
    t.tipWidth = e.tipThickness.at(root.uv);
    if (!coloursKnown) setColours(e, root, t);
    t.kinkRoot = e.kinkRoot.at(root.uv);
    t.kinkTip = e.kinkTip.at(root.uv);
    if (t.kinkRoot > 0.0f || t.kinkTip > 0.0f) {
        const glm::vec3 frequency = e.kinkFrequency.at(root.uv);
        for (int axis = 0; axis < 3; ++axis) t.kinkFrequency[axis] = frequency[axis];
    }
    if (e.strands) setStrand(e, root, t);
    return frizzPlace(e, root, t);
}

HairTraits TraitLookup::lockAt(const HairRoot& root) const {
    const Entry& e = m_groups[root.group];
    HairTraits t{};
    t.scale = e.scale.at(root.uv);
    t.displacement = e.displacement.at(root.uv);
    return t;
}

void TraitLookup::setStrand(const Entry& entry, const HairRoot& root, HairTraits& traits) const {
    for (int i = 0; i < 3; ++i) traits.splay[i] = entry.splay[i].at(root.uv);
    traits.twistTurns = entry.twist.at(root.uv) * 0.15915494f;
    traits.memberOffset = entry.offset.at(root.uv);
    traits.memberAspect = entry.aspect.at(root.uv);
    traits.memberRandomise = entry.randomise.at(root.uv);
}

void TraitLookup::setColours(const Entry& entry, const HairRoot& root, HairTraits& traits) const {
    glm::vec3 first = entry.rootColour.at(root.uv), last = entry.tipColour.at(root.uv);
    const float mutants = entry.mutants.at(root.uv);
    if (mutants > 0.0f && random(m_seed, root.id, HairChannel::Mutant) < mutants) first = last = entry.mutant;
    const float hue = entry.hueVariation.at(root.uv), value = entry.valueVariation.at(root.uv);
    if (hue > 0.0f || value > 0.0f) {
        const SinCos turn = sinCos(double{hue * spread(m_seed, root.id, HairChannel::Hue)});
        const float brightness = 1.0f + value * spread(m_seed, root.id, HairChannel::Value);
        first = varied(first, turn, brightness);
        last = varied(last, turn, brightness);
    }
    for (int i = 0; i < 3; ++i) {
        traits.rootColour[i] = first[i];
        traits.tipColour[i] = last[i];
    }
    traits.rootColour[3] = entry.rootOpacity.at(root.uv);
    traits.tipColour[3] = entry.tipOpacity.at(root.uv);
}

TraitLookup::FrizzPlace TraitLookup::frizzPlace(const Entry& entry, const HairRoot& root, HairTraits& traits) const {
    FrizzPlace place;
    traits.frizzRoot = entry.frizzRoot.at(root.uv);
    traits.frizzTip = entry.frizzTip.at(root.uv);
    if (traits.frizzRoot <= 0.0f && traits.frizzTip <= 0.0f) return place;
    const glm::vec3 frequency = entry.frizzFrequency.at(root.uv);
    place.wanted = true;
    place.at = root.position * frequency + m_frizzOffset;
    // Waves of a millimetre and less are shorter than the distance between roots. There the noise only picks a number
    // at random for each hair, and a poorly spread one; the hair's own random vector takes over.
    const float highest = std::max({frequency.x, frequency.y, frequency.z});
    place.own = smoothStep((highest - 500.0f) / 1500.0f);
    return place;
}

// What becomes of the noise.
void TraitLookup::endFrizz(const HairRoot& root, const FrizzPlace& place, HairTraits& traits) const {
    if (place.own > 0.0f) {
        const HairChannel channels[3] = {HairChannel::FrizzX, HairChannel::FrizzY, HairChannel::FrizzZ};
        for (int i = 0; i < 3; ++i)
            traits.frizz[i] += place.own * (0.57735f * spread(m_seed, root.id, channels[i]) - traits.frizz[i]);
    }
    if (m_time != 0.0f) animateFrizz(m_groups[root.group], root, place.at, place.own, traits);
}

// Adds what the noise has changed by since time 0, as seen by a place that moves through it.
void TraitLookup::animateFrizz(const Entry& entry, const HairRoot& root, const glm::vec3& place, float own,
                               HairTraits& traits) const {
    const float amount = entry.animation.at(root.uv);
    const glm::vec3 way = entry.direction * (entry.speed.at(root.uv) * m_time);
    if (!(amount > 0.0f) || !std::isfinite(way.x + way.y + way.z)) return;
    glm::vec3 from = place;
    // Where each hair's frizz is its own, so is the noise that it passes through.
    for (int axis = 0; own > 0.0f && axis < 3; ++axis)
        from[axis] +=
            own * 256.0f *
            random(m_seed, std::uint64_t{root.id} * 3 + static_cast<std::uint64_t>(axis), HairChannel::FrizzPlace);
    const glm::vec3 to = from + way;
    float before[3], after[3];
    perlinVector(from.x, from.y, from.z, before);
    perlinVector(to.x, to.y, to.z, after);
    for (int i = 0; i < 3; ++i) traits.frizz[i] += amount * (after[i] - before[i]);
}

void widen(HairTraits& traits, float lod) {
    traits.rootWidth /= lod;
    traits.tipWidth /= lod;
}

CutEnd cutEnd(float cut, int segments) {
    if (!(cut > 0.0f) || segments < 1) return {};
    if (cut >= 1.0f) return {static_cast<std::uint32_t>(segments) + 1, static_cast<float>(segments)};
    const float parameter = cut * static_cast<float>(segments);
    const float whole = std::floor(parameter);
    const auto kept = static_cast<std::uint32_t>(whole) + 1;
    // A last piece shorter than this share of a segment would only make a lump.
    if (parameter - whole > 1e-3f) return {kept + 1, parameter};
    return kept >= 2 ? CutEnd{kept, whole} : CutEnd{};
}

}  // namespace whorl
