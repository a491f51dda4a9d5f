// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/density_codes.h"

#include "core/sampling/candidates.h"
#include "core/sampling/root_sweep.kernel.h"

#include <array>
#include <cassert>
#include <cmath>
#include <mutex>

namespace whorl {
namespace {

constexpr int deepest = 10;

struct Middles {
    std::vector<float> u, v;
};

// Middles of the pieces at a depth in order of the curve. Made at the first call, then shared.
const Middles& middlesAt(int depth) {
    assert(depth >= 0 && depth <= deepest);
    static std::array<std::once_flag, deepest + 1> made;
    static std::array<Middles, deepest + 1> tables;
    const auto level = static_cast<std::size_t>(depth);
    std::call_once(made[level], [&] {
        const std::size_t count = std::size_t{1} << (2 * depth);
        for (std::uint64_t piece = 0; piece < count; ++piece) {
            // The middle piece of the middle piece of the middle piece...
            const std::uint64_t share = (piece << 32 | 0xaaaaaaaau) >> (2 * depth);
            std::int32_t u = 0, v = 0;
            placeInTriangle(static_cast<std::uint32_t>(share), u, v);
            tables[level].u.push_back(static_cast<float>(u) * placeUnit);
            tables[level].v.push_back(static_cast<float>(v) * placeUnit);
        }
    });
    return tables[level];
}

// Leaves out depths at which all four pieces of each piece are equal.
int merged(int depth, std::vector<std::uint8_t>& codes, std::size_t first) {
    for (; depth > 0; --depth) {
        const std::size_t count = codes.size() - first;
        for (std::size_t i = first; i < codes.size(); i += 4)
            if (codes[i] != codes[i + 1] || codes[i] != codes[i + 2] || codes[i] != codes[i + 3]) return depth;
        for (std::size_t i = 0; i < count / 4; ++i) codes[first + i] = codes[first + 4 * i];
        codes.resize(first + count / 4);
    }
    return depth;
}

}  // namespace

std::uint8_t densityCode(float density) {
    // As in codePieces.
    const float kept = density > 0.0f && density < 3e38f ? std::min(density, 1.0f) : 0.0f;
    const int code = static_cast<int>(std::sqrt(kept) * 255.0f + 0.5f);
    return static_cast<std::uint8_t>(kept > 0.0f && code == 0 ? 1 : code);
}

const Map* DensityCodes::readsTexels(const DensityLookup& density) {
    const auto sole = density.sole();
    return sole && sole->map && sole->value > 0.0f && BorderedTexels::fits(*sole->map) ? sole->map : nullptr;
}

DensityCodes::DensityCodes(const Groom& groom, const DensityLookup& density, const BorderedTexels& texels)
    : m_mesh(*groom.mesh), m_density(density), m_texels(texels), m_scale(density.scale()) {
    const auto sole = density.sole();
    if (!sole) return;
    m_map = sole->map;
    m_even = m_map == nullptr;
    if (!m_even && m_scale > 0.0f) m_mapScale = sole->value / m_scale;
}

int DensityCodes::measure(std::uint32_t triangle, int depth, std::vector<std::uint8_t>& codes) const {
    const std::size_t first = codes.size();
    if (!(m_scale > 0.0f) || !m_density.growsOn(triangle)) {
        codes.push_back(0);
        return 0;
    }
    if (m_even) {
        codes.push_back(255);
        return 0;
    }
    codes.resize(first + (std::size_t{1} << (2 * depth)));
    if (m_texels.empty()) {
        measureEach(triangle, depth, &codes[first]);
    } else {
        measureThroughMap(triangle, depth, &codes[first]);
    }
    return merged(depth, codes, first);
}

void DensityCodes::measureThroughMap(std::uint32_t triangle, int depth, std::uint8_t* codes) const {
    const glm::vec2* uv = &m_mesh.cornerUvs[std::size_t{3} * triangle];
    const glm::vec2 toB = uv[1] - uv[0], toC = uv[2] - uv[0];
    const Middles& middles = middlesAt(depth);
    const PieceArrays arrays{m_texels.data(), m_map->width(), m_map->height(), m_map->flipV,     m_mapScale,
                             {uv->x, uv->y},  {toB.x, toB.y}, {toC.x, toC.y},  middles.u.data(), middles.v.data()};
    WHORL_PICK(codePieces)(arrays, middles.u.size(), codes);
}

void DensityCodes::measureEach(std::uint32_t triangle, int depth, std::uint8_t* codes) const {
    const glm::vec2* uv = &m_mesh.cornerUvs[std::size_t{3} * triangle];
    const glm::vec2 toB = uv[1] - uv[0], toC = uv[2] - uv[0];
    const Middles& middles = middlesAt(depth);
    for (std::size_t i = 0; i < middles.u.size(); ++i) {
        const glm::vec2 at = uv[0] + toB * middles.u[i] + toC * middles.v[i];
        codes[i] = densityCode(m_map ? m_map->sample(at) * m_mapScale : m_density.at(triangle, at) / m_scale);
    }
}

}  // namespace whorl
