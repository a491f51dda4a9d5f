// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/density.h"

#include "core/surface/surface_point.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace whorl {

DensityLookup::DensityLookup(const Groom& groom) : m_groom(groom) {
    const auto use = [&](const std::string& name) -> const Map* {
        const Map* map = name.empty() ? nullptr : groom.maps.find(name);
        if (!map || map->empty()) return nullptr;
        m_width = std::max(m_width, map->width());
        m_height = std::max(m_height, map->height());
        return map;
    };
    if (groom.groups->size() > 1) m_groupMap = use(groom.counts->groupMap.name);
    for (const Group& group : *groom.groups) {
        const Driven& density = group.params.general.density;
        m_groups.push_back({density.value, use(density.map), group.params.general.even});
    }
    m_growsByTriangle.assign(groom.mesh->triangles.size(), 1);
    const auto& parts = groom.mesh->parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (groom.growsHair(static_cast<std::uint32_t>(i))) continue;
        const std::size_t first = std::min<std::size_t>(parts[i].firstTriangle, m_growsByTriangle.size());
        const std::size_t count = std::min<std::size_t>(parts[i].triangleCount, m_growsByTriangle.size() - first);
        std::fill_n(m_growsByTriangle.begin() + static_cast<std::ptrdiff_t>(first), count, std::uint8_t{0});
    }
}

int DensityLookup::groupAt(glm::vec2 uv) const {
    if (!m_groupMap) return 0;
    const float number = std::round(m_groupMap->sampleNearest(uv) * 255.0f);
    const int last = static_cast<int>(m_groups.size()) - 1;
    // Written so that not-a-number is group 0.
    return number > 0.0f ? static_cast<int>(std::min(number, static_cast<float>(last))) : 0;
}

float DensityLookup::at(std::uint32_t triangle, glm::vec2 uv) const {
    if (!growsOn(triangle)) return 0.0f;
    const Entry& group = m_groups[static_cast<std::size_t>(groupAt(uv))];
    const float density = group.map ? group.value * group.map->sample(uv) : group.value;
    return density > 0.0f && std::isfinite(density) ? density : 0.0f;
}

bool DensityLookup::anyEven() const {
    return std::any_of(m_groups.begin(), m_groups.end(), [](const Entry& group) { return group.even; });
}

bool DensityLookup::allEven() const {
    return std::all_of(m_groups.begin(), m_groups.end(), [](const Entry& group) { return group.even; });
}

bool DensityLookup::growsOn(std::uint32_t triangle) const {
    return m_growsByTriangle[triangle] != 0;
}

bool DensityLookup::growsAt(const SurfaceMesh& mesh, const SurfacePoint& root) const {
    return at(root.triangle, uvAt(mesh, root)) > 0.0f;
}

namespace {

// Largest finite texel of a map of floats, 1 at least; 1 for others.
float brightest(const Map* map) {
    float most = 1.0f;
    if (!map || map->format() != TexelFormat::F32) return most;
    for (int row = 0; row < map->tileRows(); ++row) {
        for (int column = 0; column < map->tileColumns(); ++column) {
            const std::vector<std::uint8_t>& bytes = map->tileBytes(column, row);
            // Numbers above zero sort as their bits do; all others, and what is infinite or none, count as zero.
            std::int32_t brightest = 0;
            for (std::size_t i = 0; i < bytes.size() / sizeof(float); ++i) {
                std::int32_t bits = 0;
                std::memcpy(&bits, &bytes[i * sizeof(float)], sizeof(bits));
                bits = bits < 0x7f800000 ? bits : 0;
                brightest = bits > brightest ? bits : brightest;
            }
            most = std::max(most, std::bit_cast<float>(brightest));
        }
    }
    return most;
}

}  // namespace

float DensityLookup::upperBound() const {
    float bound = 0.0f;
    for (const Entry& group : m_groups)
        if (const float most = group.value * brightest(group.map); most > bound && std::isfinite(most)) bound = most;
    // Weights of bilinear sampling add up to 1 only up to rounding.
    return bound * 1.00001f;
}

float DensityLookup::scale() const {
    float bound = 0.0f;
    for (const Entry& group : m_groups) {
        const float most = group.value * std::exp2(std::ceil(std::log2(brightest(group.map))));
        if (most > bound && std::isfinite(most)) bound = most;
    }
    return bound;
}

std::optional<DensityLookup::Sole> DensityLookup::sole() const {
    if (m_groupMap) return std::nullopt;
    return Sole{m_groups[0].value, m_groups[0].map};
}

}  // namespace whorl
