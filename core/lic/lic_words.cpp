// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_words.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/lic/cell_noise.kernel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

using lic_word::Special;

constexpr std::size_t blocksAtOnce = 16;

std::uint32_t bitsOf(int number) {
    return static_cast<std::uint32_t>(number) & 0xfffu;
}

// Its larger side at most `longest`.
glm::ivec2 fixedStep(glm::vec2 step, float longest) {
    const float most = longest * static_cast<float>(lic_word::one);
    step *= static_cast<float>(lic_word::one);
    const float large = std::max(std::abs(step.x), std::abs(step.y));
    if (large > most) step *= most / large;
    return {static_cast<int>(std::lrint(step.x)), static_cast<int>(std::lrint(step.y))};
}

// Directions at the corners of a triangle, turned into its plane.
struct TriangleSteps {
    TexelAtlas::Gradients texels;
    glm::vec3 corners[3];
};

TriangleSteps stepsOf(const SurfaceMesh& mesh, std::span<const glm::vec3> directions, const TexelAtlas& atlas,
                      std::uint32_t triangle) {
    TriangleSteps steps{atlas.gradients(triangle), {}};
    const glm::vec3 normal = triangleNormal(mesh, triangle);
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.triangles[triangle][k];
        const glm::vec3 from = mesh.normals[vertex], d = directions[vertex];
        const float cosine = 1.0f + glm::dot(from, normal);
        // The smallest rotation from normal to normal, for vectors across the first.
        steps.corners[k] =
            cosine > 1e-3f ? d - (from + normal) * (glm::dot(d, normal) / cosine) : minimalRotation(from, normal) * d;
    }
    return steps;
}

}  // namespace

LicWords::LicWords(const TexelAtlas& atlas) : m_atlas(atlas) {
    m_words.assign(static_cast<std::size_t>(atlas.side()) * static_cast<std::size_t>(atlas.side()), lic_word::end);
    m_words[0] = 0;
    m_longest.assign(atlas.blockCount(), 0);
    setPartings({});
}

ConvolveArrays LicWords::arrays(const LicPlan& plan) const {
    return {m_words.data(), m_atlas.side(),      m_firstSpecial.data(), m_specials.data(),
            plan.steps,     plan.weights.data(), plan.totals.data()};
}

void LicWords::setPartings(std::span<const Parting> partings) {
    const SurfaceMesh& mesh = m_atlas.mesh();
    m_partings = PartingIndex(mesh, partings);
    m_nearParting.clear();
    if (!m_partings.empty()) {
        m_nearParting.resize(mesh.triangleCount());
        parallelFor(mesh.triangleCount(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t t = first; t < last; ++t) {
                Bounds box;
                for (int k = 0; k < 3; ++k) box.add(mesh.positions[mesh.triangles[t][k]]);
                const float radius = 0.5f * glm::length(box.size());
                m_nearParting[t] = m_partings.near(box.centre(), radius + 4.0f * m_atlas.usualTexel()) ? 1 : 0;
            }
        });
    }
    m_special.assign(m_atlas.slots().size(), 0);
    for (const TexelAtlas::Jump& jump : m_atlas.jumps()) m_special[jump.slot] = 1;
    std::vector<std::pair<std::uint32_t, Special>> found;  // by texel
    for (const TexelAtlas::Jump& jump : m_atlas.jumps()) {
        Special special{};
        special.jumps = 1;
        special.toX = static_cast<std::int32_t>(std::lrint(jump.to[0] * static_cast<float>(lic_word::one)));
        special.toY = static_cast<std::int32_t>(std::lrint(jump.to[1] * static_cast<float>(lic_word::one)));
        std::copy_n(jump.turn, 4, special.turn);
        found.emplace_back(m_atlas.slots()[jump.slot].texel, special);
    }
    if (!m_nearParting.empty()) {
        const std::span<const TexelAtlas::Slot> slots = m_atlas.slots();
        std::vector<std::uint32_t> masks(slots.size(), 0);
        const auto rootAt = [&](std::uint32_t slot) {
            return PartingIndex::Root{positionAt(mesh, slots[slot].point()), normalAt(mesh, slots[slot].point())};
        };
        // Of the 25 texels around one, those that a parting lies before, seen from the place of the slot.
        const auto maskOf = [&](std::uint32_t slot, std::int64_t around) {
            std::uint32_t mask = 0;
            if (!m_nearParting[slots[slot].triangle]) return mask;
            const PartingIndex::Root here = rootAt(slot);
            const TexelAtlas::Gradients g = m_atlas.gradients(slots[slot].triangle);
            const float fine = std::min(glm::length(g.x), glm::length(g.y));
            if (!(fine > 0.0f) || !m_partings.near(here.position, 4.0f / fine)) return mask;
            const auto texels = static_cast<std::int64_t>(m_words.size());
            for (int n = 0; n < 25; ++n) {
                const std::int64_t texel = around + (n / 5 - 2) * m_atlas.side() + n % 5 - 2;
                const std::uint32_t there =
                    texel >= 0 && texel < texels ? m_atlas.slotOf(static_cast<std::uint32_t>(texel)) : TexelAtlas::none;
                if (there == TexelAtlas::none || there == slot) continue;
                if (m_partings.detour(here, rootAt(there)) > 1.0f) mask |= 1u << n;
            }
            return mask;
        };
        parallelFor(found.size(), 256, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                Special& special = found[i].second;
                const std::int64_t around =
                    std::int64_t{special.toY / lic_word::one} * m_atlas.side() + special.toX / lic_word::one;
                special.parted = maskOf(m_atlas.slotOf(found[i].first), around);
            }
        });
        parallelFor(slots.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                if (!m_special[i]) masks[i] = maskOf(static_cast<std::uint32_t>(i), slots[i].texel);
        });
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (masks[i] == 0) continue;
            Special special{};
            special.parted = masks[i];
            found.emplace_back(slots[i].texel, special);
            m_special[i] = 1;
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    m_firstSpecial.assign(m_words.size() / lic_word::segment + 2, 0);
    m_specialTexels.clear();
    m_specials.clear();
    for (const auto& [texel, special] : found) {
        ++m_firstSpecial[texel / lic_word::segment + 1];
        m_specialTexels.push_back(texel);
        m_specials.push_back(special);
    }
    for (std::size_t i = 1; i < m_firstSpecial.size(); ++i) m_firstSpecial[i] += m_firstSpecial[i - 1];
}

// How far it leads, 1/512 texel.
int LicWords::setStep(std::uint32_t slot, glm::vec2 step, float longest) {
    const std::uint32_t texel = m_atlas.slots()[slot].texel;
    std::uint32_t& word = m_words[texel];
    const bool moves = std::isfinite(step.x) && std::isfinite(step.y);
    if (!moves) {
        word = (word & lic_word::noise) | lic_word::end;
        return 0;
    }
    const auto reach = [](const glm::ivec2& fixed) { return std::max(std::abs(fixed.x), std::abs(fixed.y)); };
    // What a texel knows of partings ends two texels away.
    if (!m_nearParting.empty() && m_nearParting[m_atlas.slots()[slot].triangle]) longest = std::min(longest, 2.0f);
    if (!m_special[slot]) {
        const glm::ivec2 fixed = fixedStep(step, longest);
        word = (word & lic_word::noise) | bitsOf(fixed.x) << 20 | bitsOf(fixed.y) << 8;
        return reach(fixed);
    }
    const std::uint32_t first = m_firstSpecial[texel / lic_word::segment];
    const auto at = std::lower_bound(m_specialTexels.begin() + first, m_specialTexels.end(), texel);
    const auto number = static_cast<std::uint32_t>(at - m_specialTexels.begin());
    const glm::ivec2 fixed = fixedStep(step, longest);
    m_specials[number].stepX = fixed.x;
    m_specials[number].stepY = fixed.y;
    word = (word & lic_word::noise) | lic_word::mark | (number - first) << 8;
    return reach(fixed);
}

float LicWords::longestStep(std::span<const std::uint8_t> blocks) const {
    int most = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (blocks[b]) most = std::max(most, m_longest[b]);
    return static_cast<float>(most) / static_cast<float>(lic_word::one);
}

void LicWords::setSteps(const DirectionField& field, const LicPlan& plan, std::span<const std::uint8_t> blocks) {
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            if (blocks[b]) stepsOfBlock(field, plan, b);
    });
}

void LicWords::stepsOfBlock(const DirectionField& field, const LicPlan& plan, std::size_t block) {
    const SurfaceMesh& mesh = m_atlas.mesh();
    const std::span<const glm::vec3> directions = field.vertices();
    const std::span<const std::uint8_t> grows = field.grows();
    const glm::vec2 nowhere(NAN);
    TriangleSteps steps{};
    int& longest = m_longest[block];
    longest = 0;
    std::uint32_t known = TexelAtlas::none;
    for (std::uint32_t i = m_atlas.firstSlot(block); i < m_atlas.firstSlot(block + 1); ++i) {
        const TexelAtlas::Slot& slot = m_atlas.slots()[i];
        if (grows.empty() || !grows[slot.triangle]) {
            setStep(i, nowhere, 0.0f);
            continue;
        }
        if (slot.triangle != known) {
            steps = stepsOf(mesh, directions, m_atlas, slot.triangle);
            known = slot.triangle;
        }
        glm::vec3 direction(0.0f);
        if (!m_nearParting.empty() && m_nearParting[slot.triangle]) {
            const glm::vec3 normal = triangleNormal(mesh, slot.triangle);
            const glm::vec3 d = field.at(slot.point());
            direction = d - normal * glm::dot(d, normal);
        } else {
            direction =
                steps.corners[0] * (1.0f - slot.u - slot.v) + steps.corners[1] * slot.u + steps.corners[2] * slot.v;
        }
        const float length = glm::length(direction);
        if (!(length > 1e-6f) || steps.texels.x == glm::vec3(0.0f)) {
            setStep(i, nowhere, 0.0f);
            continue;
        }
        const float metres = plan.stepMetres / length;
        const glm::vec2 step(glm::dot(direction, steps.texels.x), glm::dot(direction, steps.texels.y));
        longest = std::max(longest, setStep(i, step * metres, plan.longestStep));
    }
}

void LicWords::setNoise(const LicPlan& plan, std::uint32_t seed, const Map* grainMap,
                        std::span<const std::uint8_t> blocks) {
    parallelFor(blocks.size(), blocksAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            if (blocks[b]) noiseOfBlock(plan, seed, grainMap, b);
    });
}

namespace {

// The cells that a place lies in where a map makes the grain finer: some of one level are divided into the next.
float grainAt(const LicPlan& plan, std::uint32_t seed, const glm::vec3& place, float share) {
    const float wanted = plan.grains[0] * std::max(std::isfinite(share) ? share : 1.0f, 0.0f);
    float coarse = plan.grains[0];
    while (wanted > coarse && coarse < 1.0f) coarse *= 1.41421356f;
    for (std::size_t i = 0; i + 1 < plan.grains.size() && coarse * 0.70710678f >= wanted; ++i) coarse *= 0.70710678f;
    const float fine = coarse * 0.70710678f;
    if (wanted >= coarse) return coarse;
    const float divided = std::clamp((coarse - wanted) / (coarse - fine), 0.0f, 1.0f);
    std::uint64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::int64_t>(std::floor(place[axis] / coarse)) + (1 << 20);
        cell = cell << 21 | (static_cast<std::uint64_t>(at) & 0x1fffffu);
    }
    return randomFloat(seed, cell, 1) < divided ? fine : coarse;
}

}  // namespace

void LicWords::noiseOfBlock(const LicPlan& plan, std::uint32_t seed, const Map* grainMap, std::size_t block) {
    constexpr std::size_t most = std::size_t{TexelAtlas::block} * TexelAtlas::block;
    constexpr std::size_t mostPlaces = LicPlan::mostSamples * LicPlan::mostSamples * 64;
    float x[mostPlaces], y[mostPlaces], z[mostPlaces], grain[mostPlaces];
    std::uint8_t values[mostPlaces];
    static_assert(most % 64 == 0);
    const SurfaceMesh& mesh = m_atlas.mesh();
    const std::uint32_t end = m_atlas.firstSlot(block + 1);
    const int n = plan.samples;
    const auto samples = static_cast<std::size_t>(n * n);
    for (std::uint32_t first = m_atlas.firstSlot(block); first < end; first += 64) {
        const std::uint32_t last = std::min(first + 64, end);
        std::size_t places = 0;
        std::uint32_t known = TexelAtlas::none;
        glm::vec3 right(0.0f), down(0.0f);
        for (std::uint32_t i = first; i < last; ++i) {
            const TexelAtlas::Slot& slot = m_atlas.slots()[i];
            if (slot.triangle != known) {
                known = slot.triangle;
                // One texel on along both axes, in metres: the inverse of the gradients.
                const TexelAtlas::Gradients g = m_atlas.gradients(known);
                const float xx = glm::dot(g.x, g.x), yy = glm::dot(g.y, g.y), xy = glm::dot(g.x, g.y);
                const float area = xx * yy - xy * xy;
                right = area > 0.0f ? (g.x * yy - g.y * xy) / area : glm::vec3(0.0f);
                down = area > 0.0f ? (g.y * xx - g.x * xy) / area : glm::vec3(0.0f);
            }
            const glm::vec3 middle = positionAt(mesh, slot.point());
            const float share = grainMap ? grainMap->sample(uvAt(mesh, slot.point())) : 1.0f;
            for (int s = 0; s < n * n; ++s, ++places) {
                const float dx = (static_cast<float>(s % n) + 0.5f) / static_cast<float>(n) - 0.5f;
                const float dy = (static_cast<float>(s / n) + 0.5f) / static_cast<float>(n) - 0.5f;
                const glm::vec3 at = middle + right * dx + down * dy;
                x[places] = at.x;
                y[places] = at.y;
                z[places] = at.z;
                grain[places] = grainMap ? grainAt(plan, seed, at, share) : plan.grains[0];
            }
        }
        WHORL_PICK(cellNoise)({x, y, z, grain, plan.mean, seed, values}, places);
        for (std::uint32_t i = first; i < last; ++i) {
            const std::uint8_t* of = values + (i - first) * samples;
            std::uint32_t white = 0, hair = 0;
            for (std::size_t s = 0; s < samples; ++s) {
                white += of[s] & 1u;
                hair += of[s] >> 1 & 1u;
            }
            // Rounded up or down at random, so that means stay.
            const auto all = static_cast<std::uint32_t>(samples);
            const std::uint32_t chance = of[0] >> 4;
            const std::uint32_t light = (white * lic_word::lightMost * 16 + chance * all) / (16 * all);
            const std::uint32_t other = (hair * lic_word::hairMost * 16 + chance * all) / (16 * all);
            std::uint32_t& word = m_words[m_atlas.slots()[i].texel];
            word = (word & ~lic_word::noise) | std::min<std::uint32_t>(light, lic_word::lightMost) |
                   std::min<std::uint32_t>(other, lic_word::hairMost) << 5;
        }
    }
}

}  // namespace whorl
