// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_colours.h"

#include "core/hair/traits.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

std::uint8_t encoded(float linear) {
    static const std::vector<std::uint8_t> table = [] {
        std::vector<std::uint8_t> bytes;
        for (int i = 0; i < 65536; ++i)
            bytes.push_back(
                static_cast<std::uint8_t>(srgbFromLinear(static_cast<float>(i) / 65535.0f) * 255.0f + 0.5f));
        return bytes;
    }();
    const float limited = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
    return table[static_cast<std::size_t>(limited * 65535.0f + 0.5f)];
}

// Goes up and down evenly between -1 and 1, `turns` times from 0 to 1.
float zigzag(float x, float turns, float from) {
    const float at = x * turns + from;
    const float part = at - std::floor(at);
    return 4.0f * std::abs(part - 0.5f) - 1.0f;
}

}  // namespace

LicColours::LicColours(const Groom& groom) : m_groups(groom), m_place(std::clamp(groom.lic->colourPlace, 0.0f, 1.0f)) {
    const auto map = [&](const std::string& name) -> const Map* {
        const Map* found = name.empty() ? nullptr : groom.maps.find(name);
        return found && !found->empty() ? found : nullptr;
    };
    const auto share = [&](const Driven& driven) { return Share{driven.value, map(driven.map)}; };
    for (const Group& group : *groom.groups) {
        const ColourParams& colour = group.params.colour;
        Entry entry;
        entry.root = {colour.root.value, map(colour.root.map)};
        entry.tip = {colour.tip.value, map(colour.tip.map)};
        entry.hue = share(colour.hueVariation);
        entry.value = share(colour.valueVariation);
        entry.mutants = share(colour.mutants);
        entry.mutant = colour.mutant.value;
        entry.mapped = entry.root.map || entry.tip.map || entry.hue.map || entry.value.map || entry.mutants.map;
        m_varies = m_varies || entry.hue.value > 0.0f || entry.value.value > 0.0f || entry.mutants.value > 0.0f;
        if (!entry.mapped) {
            for (int i = 0; i < 256; ++i)
                entry.ranks.push_back(evaluate(entry, glm::vec2(0.0f), static_cast<float>(i) / 255.0f));
        }
        m_entries.push_back(std::move(entry));
    }
}

glm::vec3 LicColours::Tint::at(glm::vec2 uv) const {
    const glm::vec3 colour = map ? value * map->sampleColour(uv) : value;
    glm::vec3 limited(0.0f);
    for (int i = 0; i < 3; ++i) limited[i] = std::isfinite(colour[i]) ? std::clamp(colour[i], 0.0f, 1e6f) : 0.0f;
    return limited;
}

float LicColours::Share::at(glm::vec2 uv) const {
    const float number = map ? value * map->sample(uv) : value;
    return std::isfinite(number) ? std::clamp(number, 0.0f, 3.14159265f) : 0.0f;
}

// Nobody numbers drawn hairs. Their rank is even along each and independent of the neighbour's: odd hairs are those
// around the middle, hue and brightness go up and down over the ranks at different rates.
LicColour LicColours::evaluate(const Entry& entry, glm::vec2 uv, float rank) const {
    const glm::vec3 root = entry.root.at(uv), tip = entry.tip.at(uv);
    glm::vec3 colour = root + (tip - root) * m_place;
    if (const float mutants = std::min(entry.mutants.at(uv), 1.0f); mutants > 0.0f) {
        const float inside = (0.5f * mutants - std::abs(rank - 0.5f)) / std::min(0.25f * mutants, 0.05f);
        colour = glm::mix(colour, entry.mutant, std::clamp(0.5f + inside, 0.0f, 1.0f));
    }
    const float hue = entry.hue.at(uv), value = std::min(entry.value.at(uv), 1.0f);
    if (hue > 0.0f || value > 0.0f)
        colour = variedColour(colour, hue * zigzag(rank, 3.0f, 0.1f), 1.0f + value * zigzag(rank, 5.0f, 0.4f));
    return {encoded(colour.x), encoded(colour.y), encoded(colour.z)};
}

LicColour LicColours::at(glm::vec2 uv, float rank) const {
    const Entry& entry = m_entries[static_cast<std::size_t>(m_groups.groupAt(uv))];
    if (!entry.mapped) return entry.ranks[static_cast<std::size_t>(std::clamp(rank, 0.0f, 1.0f) * 255.0f + 0.5f)];
    return evaluate(entry, uv, rank);
}

std::vector<std::string> LicColours::mapNames(const Groom& groom) {
    std::vector<std::string> names;
    for (const Group& group : *groom.groups) {
        const ColourParams& colour = group.params.colour;
        for (const std::string* name : {&colour.root.map, &colour.tip.map, &colour.hueVariation.map,
                                        &colour.valueVariation.map, &colour.mutants.map})
            names.push_back(*name);
    }
    names.push_back(groom.counts->groupMap.name);
    return names;
}

}  // namespace whorl
