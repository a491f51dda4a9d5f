// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/density_codes.h"

#include "core/base/parallel.h"
#include "core/sampling/candidates.h"
#include "core/sampling/root_sweep.kernel.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <mutex>

namespace whorl {
namespace {

constexpr int deepest = 10;
// Larger maps are sampled where they are.
constexpr std::size_t mostTexels = std::size_t{1} << 26;

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

std::vector<float> withBorder(const Map& map) {
    const std::size_t stride = static_cast<std::size_t>(map.width()) + 2;
    std::vector<float> texels(stride * (static_cast<std::size_t>(map.height()) + 2));
    const auto value = [&](int x, int y) {
        if (map.channels() == 1) return map.texel(x, y);
        return (map.texel(x, y, 0) + map.texel(x, y, 1) + map.texel(x, y, 2)) / 3.0f;
    };
    parallelFor(static_cast<std::size_t>(map.height()), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            float* row = &texels[(y + 1) * stride];
            for (int x = 0; x < map.width(); ++x) row[x + 1] = value(x, static_cast<int>(y));
            row[0] = row[map.width()];
            row[map.width() + 1] = row[1];
        }
    });
    const auto rows = static_cast<std::size_t>(map.height());
    std::copy_n(&texels[rows * stride], stride, texels.data());
    std::copy_n(&texels[stride], stride, &texels[(rows + 1) * stride]);
    return texels;
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

DensityCodes::DensityCodes(const Groom& groom, const DensityLookup& density, bool many)
    : m_mesh(*groom.mesh), m_density(density), m_scale(density.scale()) {
    const auto sole = density.sole();
    if (!sole) return;
    m_map = sole->map;
    m_even = m_map == nullptr;
    if (m_even || !(m_scale > 0.0f)) return;
    m_mapScale = sole->value / m_scale;
    const std::size_t texels = static_cast<std::size_t>(m_map->width()) * static_cast<std::size_t>(m_map->height());
    if (many && texels <= mostTexels) m_texels = withBorder(*m_map);
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
