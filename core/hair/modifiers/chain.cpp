// SPDX-License-Identifier: Apache-2.0
#include "core/hair/modifiers/chain.h"

#include "core/base/random.h"
#include "core/hair/modifiers/lanes.h"
#include "core/model/modifiers/rows.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

// Channels of randomBits; four a modifier, then three for the noise's start.
constexpr std::uint32_t firstChannel = 128;

struct MadeNumbers {
    const Groom& groom;
    std::vector<ModifierNumber>& numbers;
    const ParamInfo& info;

    const Map* map(const std::string& name) const {
        const Map* found = name.empty() ? nullptr : groom.maps.find(name);
        return found && !found->empty() ? found : nullptr;
    }
    void add(float value, const Map* map = nullptr) const {
        numbers.push_back({value, map, static_cast<float>(info.min), static_cast<float>(info.max)});
    }
    void operator()(const bool* v) const { add(*v ? 1.0f : 0.0f); }
    void operator()(const int* v) const { add(static_cast<float>(*v)); }
    void operator()(const float* v) const { add(*v); }
    void operator()(const Driven* v) const { add(v->value, map(v->map)); }
    void operator()(const DrivenVector* v) const {
        for (int axis = 0; axis < 3; ++axis) add(v->value[axis], map(v->map));
    }
    void operator()(const Vector* v) const {
        for (int axis = 0; axis < 3; ++axis) add(v->value[axis]);
    }
    void operator()(const Choice* v) const {
        numbers.push_back({static_cast<float>(v->index), nullptr, 0.0f, static_cast<float>(info.choices.size())});
    }
    // No modifier has these.
    void operator()(const DrivenColour*) const { add(0.0f); }
    void operator()(const Colour*) const { add(0.0f); }
    void operator()(const MapName*) const { add(0.0f); }
};

std::size_t rowOfSeed(std::size_t kind) {
    constexpr std::size_t none = 0;
    const std::size_t rows[modifierKindCount] = {
        ClumpRows::Seed, CurlRows::Seed, NoiseRows::Seed, none, LengthRows::Seed, none, none, none};
    return rows[kind];
}

std::size_t rowOfShared(std::size_t kind) {
    if (kind == modifierKindOf<CurlParams>) return CurlRows::Shared;
    if (kind == modifierKindOf<NoiseParams>) return NoiseRows::Shared;
    return 0;
}

std::uint32_t randomRowsOf(std::size_t kind) {
    const std::uint32_t rows[modifierKindCount] = {1, ModifierArrays::randomRows, 3, 0, 1, 0, 0, 0};
    return rows[kind];
}

ModifierStep stepFor(const Groom& groom, Modifier modifier) {
    ModifierStep step;
    step.kind = modifier.kind();
    for (const ParamRef& ref : paramsOf(modifier)) {
        std::visit([&](auto* target) { MadeNumbers{groom, step.numbers, ref.info}(target); }, ref.target);
    }
    step.randomRows = randomRowsOf(step.kind);
    const std::size_t seed = rowOfSeed(step.kind), shared = rowOfShared(step.kind);
    const std::uint32_t own = seed > 0 ? static_cast<std::uint32_t>(step.numbers[seed].value) : 0;
    step.seed = static_cast<std::uint32_t>(step.kind) + static_cast<std::uint32_t>(modifierKindCount) * own;
    step.shared = shared > 0 && step.numbers[shared].value > 0.0f;
    for (ModifierNumber& number : step.numbers)
        if (!number.map) number.value = number.at({});
    return step;
}

}  // namespace

float ModifierNumber::at(glm::vec2 uv) const {
    const float product = map ? value * map->sample(uv) : value;
    return std::clamp(std::isfinite(product) ? product : 0.0f, least, most);
}

ModifierChain::ModifierChain(const Groom& groom) : m_seed(static_cast<std::uint32_t>(groom.counts->seed)) {
    for (std::size_t group = 0; group < groom.groups->size(); ++group) {
        Steps steps;
        for (const Modifier& modifier : (*groom.groups)[group].params.modifiers) {
            if (!modifier.on || modifier.amount.value <= 0.0f) continue;
            ModifierStep step = stepFor(groom, modifier);
            if (step.kind == modifierKindOf<TaperParams>) {
                steps.looks.push_back(std::move(step));
                continue;
            }
            if (step.kind == modifierKindOf<ClumpParams>) {
                step.clump = m_clumps.size();
                m_clumps.push_back({group, steps.shapes.size()});
            }
            steps.shapes.push_back(std::move(step));
        }
        m_groups.push_back(std::move(steps));
    }
}

void ModifierChain::noiseOffset(const ModifierStep& step, float* offset) const {
    for (std::uint32_t axis = 0; axis < 3; ++axis)
        offset[axis] = 256.0f * randomFloat(m_seed, step.seed, firstChannel + ModifierArrays::randomRows + axis);
}

void ModifierChain::random(const ModifierStep& step, std::uint64_t key, float* out) const {
    for (std::uint32_t row = 0; row < ModifierArrays::randomRows; ++row)
        out[row] = randomFloat(randomSeed(step), key, channelOf(row));
}

std::uint32_t ModifierChain::randomSeed(const ModifierStep& step) const {
    return m_seed ^ static_cast<std::uint32_t>(mix64(step.seed + 1));
}

std::uint32_t ModifierChain::channelOf(std::uint32_t row) {
    return firstChannel + row;
}

ModifierKernel modifierKernel(std::size_t kind) {
    const ModifierKernel kernels[modifierKindCount] = {
        WHORL_PICK(clumpHairs),  WHORL_PICK(curlHairs),   WHORL_PICK(noiseHairs),      WHORL_PICK(bendHairs),
        WHORL_PICK(lengthHairs), WHORL_PICK(smoothHairs), WHORL_PICK(straightenHairs), nullptr};
    return kernels[kind];
}

bool looksAreEven(const ModifierChain& chain, std::size_t group) {
    const std::span<const ModifierStep> looks = chain.looks(group);
    return !looks.empty() && std::all_of(looks.begin(), looks.end(), [](const ModifierStep& step) {
        return std::all_of(step.numbers.begin(), step.numbers.end(),
                           [](const ModifierNumber& number) { return number.map == nullptr; });
    });
}

void lookNumbers(const ModifierChain& chain, std::size_t group, glm::vec2 uv, std::vector<float>& out) {
    out.clear();
    for (const ModifierStep& step : chain.looks(group))
        for (const ModifierNumber& number : step.numbers) out.push_back(number.at(uv));
}

float taperAt(std::span<const float> numbers, float along) {
    float factor = 1.0f;
    for (std::size_t i = 0; i + TaperRows::count <= numbers.size(); i += TaperRows::count) {
        const float* n = &numbers[i];
        const float root = n[TaperRows::Root], tip = n[TaperRows::Tip];
        const float wanted = root + (tip - root) * modifier_lanes::bias(along, n[TaperRows::Profile]);
        factor *= 1.0f + n[1] * (wanted - 1.0f);
    }
    return factor;
}

}  // namespace whorl
