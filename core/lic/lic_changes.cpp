// SPDX-License-Identifier: Apache-2.0
#include "core/lic/lic_changes.h"

#include "core/base/parallel.h"
#include "core/model/map_changes.h"

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

// Lists of blocks from pairs (key, block) that come in order of blocks, some more than once.
void gather(std::size_t keys, const std::vector<std::array<std::uint32_t, 2>>& pairs, std::vector<std::uint32_t>& first,
            std::vector<std::uint32_t>& blocks) {
    first.assign(keys + 1, 0);
    for (const auto& pair : pairs) ++first[pair[0] + 1];
    for (std::size_t i = 0; i < keys; ++i) first[i + 1] += first[i];
    blocks.resize(pairs.size());
    std::vector<std::uint32_t> at(first.begin(), first.end() - 1);
    for (const auto& pair : pairs) blocks[at[pair[0]]++] = pair[1];
}

}  // namespace

LicChanges::LicChanges(const TexelAtlas& atlas) : m_atlas(atlas) {
    constexpr int side = TouchedUvs::side;
    const SurfaceMesh& mesh = atlas.mesh();
    std::vector<std::array<std::uint32_t, 2>> cells, triangles;
    std::vector<std::uint32_t> lastOfCell(static_cast<std::size_t>(side) * side, TexelAtlas::none);
    for (std::uint32_t b = 0; b < atlas.blockCount(); ++b) {
        std::uint32_t known = TexelAtlas::none;
        bool far = false;
        for (std::uint32_t i = atlas.firstSlot(b); i < atlas.firstSlot(b + 1); ++i) {
            const TexelAtlas::Slot& slot = atlas.slots()[i];
            if (slot.triangle != known) triangles.push_back({known = slot.triangle, b});
            const glm::vec2 uv = uvAt(mesh, slot.point());
            if (!(std::abs(uv.x) < TouchedUvs::farOut && std::abs(uv.y) < TouchedUvs::farOut)) {
                far = true;
                continue;
            }
            const auto cell = static_cast<std::uint32_t>(TouchedUvs::cellOf(uv.y) * side + TouchedUvs::cellOf(uv.x));
            if (lastOfCell[cell] != b) cells.push_back({cell, b});
            lastOfCell[cell] = b;
        }
        if (far) m_farOut.push_back(b);
    }
    gather(lastOfCell.size(), cells, m_firstOfCell, m_blocksOfCell);
    gather(mesh.triangleCount(), triangles, m_firstOfTriangle, m_blocksOfTriangle);
}

void LicChanges::add(const LicBlocks& more, LicBlocks& blocks) {
    for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b] = blocks[b] | more[b];
}

void LicChanges::addMap(const Groom& before, const std::string& nameBefore, const Groom& after,
                        const std::string& nameAfter, LicBlocks& blocks) const {
    const Map* was = nameBefore.empty() ? nullptr : before.maps.find(nameBefore);
    const Map* is = nameAfter.empty() ? nullptr : after.maps.find(nameAfter);
    if (was == is) return;
    if (!was || !is || !differInTexels(*was, *is)) {
        addAll(blocks);
        return;
    }
    TouchedUvs touched;
    for (const TexelRect& rect : changedTexels(*was, *is)) touched.add(*is, rect);
    if (touched.empty()) return;
    for (const std::uint32_t b : m_farOut) blocks[b] = 1;
    for (int row = 0; row < TouchedUvs::side; ++row) {
        for (int column = 0; column < TouchedUvs::side; ++column) {
            if (!touched.cell(column, row)) continue;
            const auto cell = static_cast<std::size_t>(row * TouchedUvs::side + column);
            for (std::uint32_t i = m_firstOfCell[cell]; i < m_firstOfCell[cell + 1]; ++i) blocks[m_blocksOfCell[i]] = 1;
        }
    }
}

template <class Same>
std::vector<std::uint32_t> LicChanges::differing(Same&& same) const {
    constexpr std::size_t atOnce = 8192;
    const std::size_t count = m_atlas.mesh().triangleCount();
    std::vector<std::vector<std::uint32_t>> found((count + atOnce - 1) / atOnce);
    parallelFor(count, atOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            if (!same(t)) found[first / atOnce].push_back(static_cast<std::uint32_t>(t));
    });
    std::vector<std::uint32_t> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
}

std::vector<std::uint32_t> LicChanges::triangles(const DirectionField& before, const DirectionField& after) const {
    const std::span<const glm::vec3> was = before.vertices(), is = after.vertices();
    const std::span<const std::uint8_t> grew = before.grows(), grows = after.grows();
    if (was.data() == is.data()) return {};
    const SurfaceMesh& mesh = m_atlas.mesh();
    const bool comparable = was.size() == is.size() && grew.size() == grows.size();
    return differing([&](std::size_t t) {
        const glm::uvec3 corners = mesh.triangles[t];
        return comparable && grew[t] == grows[t] && was[corners.x] == is[corners.x] &&
               was[corners.y] == is[corners.y] && was[corners.z] == is[corners.z];
    });
}

std::vector<std::uint32_t> LicChanges::grown(const DirectionField& before, const DirectionField& after) const {
    const std::span<const std::uint8_t> grew = before.grows(), grows = after.grows();
    if (grew.data() == grows.data()) return {};
    return differing([&](std::size_t t) { return grew.size() == grows.size() && grew[t] == grows[t]; });
}

void LicChanges::addTriangles(std::span<const std::uint32_t> triangles, LicBlocks& blocks) const {
    for (const std::uint32_t t : triangles)
        for (std::uint32_t i = m_firstOfTriangle[t]; i < m_firstOfTriangle[t + 1]; ++i)
            blocks[m_blocksOfTriangle[i]] = 1;
}

}  // namespace whorl
