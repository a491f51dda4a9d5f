// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_colours.h"

#include "core/base/parallel.h"
#include "core/base/polynomials.h"
#include "core/sampling/density.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace whorl {
namespace {

constexpr std::size_t blocksAtOnce = 16;

const std::uint32_t* encodedTable() {
    static const std::vector<std::uint32_t> table = [] {
        std::vector<std::uint32_t> bytes;
        for (int i = 0; i < 4096; ++i)
            bytes.push_back(
                static_cast<std::uint32_t>(srgbFromLinear(static_cast<float>(i) / 4095.0f) * 255.0f + 0.5f));
        return bytes;
    }();
    return table.data();
}

// Goes up and down evenly between -1 and 1, `turns` times from 0 to 1.
float zigzag(float x, float turns, float from) {
    const float at = x * turns + from;
    const float part = at - std::floor(at);
    return 4.0f * std::abs(part - 0.5f) - 1.0f;
}

struct Tint {
    glm::vec3 value{0.0f};
    const Map* map = nullptr;
    glm::vec3 at(glm::vec2 uv) const {
        const glm::vec3 colour = map ? value * map->sampleColour(uv) : value;
        glm::vec3 limited(0.0f);
        for (int i = 0; i < 3; ++i) limited[i] = std::isfinite(colour[i]) ? std::clamp(colour[i], 0.0f, 1e6f) : 0.0f;
        return limited;
    }
};

struct Share {
    float value = 0.0f;
    const Map* map = nullptr;
    float most = 1.0f;
    float at(glm::vec2 uv) const {
        const float number = map ? value * map->sample(uv) : value;
        return std::isfinite(number) ? std::clamp(number, 0.0f, most) : 0.0f;
    }
};

struct Source {
    Tint root, tip;
    Share hue, value, mutants;
};

}  // namespace

// Nobody numbers drawn hairs. Their rank is even along each and independent of the neighbour's: odd hairs are the
// lowest, hue and brightness go up and down over the ranks at different rates.
LicColours::Variation LicColours::variation(float hue, float value, float mutants, float rank) {
    Variation v;
    if (hue > 0.0f || value > 0.0f) {
        // About the grey axis.
        const SinCos turn = sinCos(static_cast<double>(hue * zigzag(rank, 3.0f, 0.1f)));
        const double brightness = 1.0 + static_cast<double>(value * zigzag(rank, 5.0f, 0.4f));
        const double c = turn.cos, s = turn.sin / std::sqrt(3.0), third = (1.0 - c) / 3.0;
        v.turn[0] = static_cast<float>((c + third) * brightness);
        v.turn[1] = static_cast<float>((third - s) * brightness);
        v.turn[2] = static_cast<float>((third + s) * brightness);
    }
    if (mutants > 0.0f) {
        const float inside = (mutants - rank) / std::min(0.5f * mutants, 0.05f);
        v.share = std::clamp(0.5f + inside, 0.0f, 1.0f);
    }
    return v;
}

void LicColours::set(const Groom& groom, std::span<const std::uint8_t> blocks) {
    const auto map = [&](const std::string& name) -> const Map* {
        const Map* found = name.empty() ? nullptr : groom.maps.find(name);
        return found && !found->empty() ? found : nullptr;
    };
    const auto share = [&](const Driven& driven, float most) { return Share{driven.value, map(driven.map), most}; };
    std::vector<Source> sources;
    m_entries.clear();
    m_varies = false;
    bool apart = false;
    for (const Group& group : *groom.groups) {
        const ColourParams& colour = group.params.colour;
        const Source source{{colour.root.value, map(colour.root.map)},
                            {colour.tip.value, map(colour.tip.map)},
                            share(colour.hueVariation, 3.14159265f),
                            share(colour.valueVariation, 1.0f),
                            share(colour.mutants, 1.0f)};
        m_varies = m_varies || source.hue.value > 0.0f || source.value.value > 0.0f || source.mutants.value > 0.0f;
        apart = apart || source.hue.map || source.value.map || source.mutants.map;
        LicVariations entry;
        for (int k = 0; k < 3; ++k) entry.mutant[k] = colour.mutant.value[k];
        for (int i = 0; i < 256; ++i) {
            const Variation v =
                variation(source.hue.value, source.value.value, source.mutants.value, static_cast<float>(i) / 255.0f);
            entry.share[i] = v.share;
            for (int k = 0; k < 3; ++k) entry.turn[k][i] = v.turn[k];
        }
        sources.push_back(source);
        m_entries.push_back(entry);
    }
    const std::size_t count = m_atlas.slots().size();
    for (std::vector<float>& channel : m_places) channel.resize(count);
    m_groups.resize(sources.size() > 1 ? count : 0);
    m_differences.resize(apart ? count : 0);
    const DensityLookup groups(groom);
    const float place = std::clamp(groom.lic->colourPlace, 0.0f, 1.0f);
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks[b]) continue;
            for (std::uint32_t i = m_atlas.firstSlot(b); i < m_atlas.firstSlot(b + 1); ++i) {
                const glm::vec2 uv = uvAt(m_atlas.mesh(), m_atlas.slots()[i].point());
                const int group = groups.groupAt(uv);
                if (!m_groups.empty()) m_groups[i] = static_cast<std::uint8_t>(group);
                const Source& source = sources[static_cast<std::size_t>(group)];
                const glm::vec3 colour = glm::mix(source.root.at(uv), source.tip.at(uv), place);
                for (int k = 0; k < 3; ++k) m_places[k][i] = colour[k];
                if (apart) m_differences[i] = {source.hue.at(uv), source.value.at(uv), source.mutants.at(uv)};
            }
        }
    });
}

void LicColours::pixels(std::size_t b, const std::uint8_t* rank, std::uint32_t* colours) const {
    static const std::array<std::uint8_t, 256> inOrder = [] {
        std::array<std::uint8_t, 256> numbers{};
        for (std::size_t i = 0; i < 256; ++i) numbers[i] = static_cast<std::uint8_t>(i);
        return numbers;
    }();
    const auto kernel = WHORL_PICK(licColourPixels);
    const std::uint32_t begin = m_atlas.firstSlot(b), end = m_atlas.firstSlot(b + 1);
    LicVariations own;
    // Runs of one group.
    for (std::uint32_t first = begin, last = begin; first < end; first = last) {
        const std::uint8_t group = m_groups.empty() ? std::uint8_t{0} : m_groups[first];
        last = m_groups.empty() ? end : first + 1;
        while (last < end && m_groups[last] == group) ++last;
        LicColourPixels p{static_cast<int>(last - first),
                          &m_entries[group],
                          encodedTable(),
                          rank + (first - begin),
                          {m_places[0].data() + first, m_places[1].data() + first, m_places[2].data() + first},
                          colours + (first - begin)};
        if (!m_differences.empty()) {
            std::copy_n(m_entries[group].mutant, 3, own.mutant);
            for (std::uint32_t i = first; i < last; ++i) {
                const glm::vec3& d = m_differences[i];
                const Variation v = variation(d.x, d.y, d.z, static_cast<float>(rank[i - begin]) / 255.0f);
                own.share[i - first] = v.share;
                for (int k = 0; k < 3; ++k) own.turn[k][i - first] = v.turn[k];
            }
            p.variations = &own;
            p.rank = inOrder.data();
        }
        kernel(p);
    }
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
