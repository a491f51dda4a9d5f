// SPDX-License-Identifier: Apache-2.0
#include "core/lic/texel_atlas.h"

#include "core/lic/texel_raster.h"
#include "core/surface/atlas.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace whorl {
namespace {

bool insideSquare(const std::vector<glm::vec2>& uvs) {
    return std::ranges::all_of(uvs, [](const glm::vec2& uv) {
        return uv.x >= -1e-4f && uv.x <= 1.0001f && uv.y >= -1e-4f && uv.y <= 1.0001f;
    });
}

}  // namespace

Result<TexelAtlas> TexelAtlas::make(std::shared_ptr<const Surface> surface, int size, LicLayout layout,
                                    Progress& progress) {
    TexelAtlas atlas;
    atlas.m_surface = std::move(surface);
    atlas.m_size = std::clamp(size, 1, 8192);
    atlas.m_side = (atlas.m_size + 2 * pad + block - 1) / block * block;
    const SurfaceMesh& mesh = atlas.mesh();
    std::optional<Raster> raster;
    if (layout == LicLayout::Mesh || (!needsAtlas(mesh) && insideSquare(mesh.cornerUvs))) {
        atlas.m_cornerUvs = std::make_shared<const std::vector<glm::vec2>>(mesh.cornerUvs);
        raster.emplace(atlas);
    }
    if (progress.cancelled()) return cancelledError();
    if (!raster || !raster->roomFor(layout)) {
        SurfaceMesh copy = mesh;
        makeAtlas(copy, atlas.m_size, static_cast<int>(2.0f * margin));
        atlas.m_cornerUvs = std::make_shared<const std::vector<glm::vec2>>(std::move(copy.cornerUvs));
        atlas.m_ownUvs = true;
        if (progress.cancelled()) return cancelledError();
        raster.emplace(atlas);
    }
    if (progress.cancelled()) return cancelledError();
    atlas.measure();
    atlas.place(*raster);
    raster.reset();
    if (progress.cancelled()) return cancelledError();
    atlas.fillAround();
    return atlas;
}

glm::vec2 TexelAtlas::texelPlace(std::size_t corner) const {
    const glm::vec2 uv = (*m_cornerUvs)[corner];
    const auto size = static_cast<float>(m_size);
    return glm::vec2(uv.x, 1.0f - uv.y) * size + static_cast<float>(pad);
}

TexelAtlas::Gradients TexelAtlas::gradients(std::uint32_t triangle) const {
    const glm::uvec3 corners = mesh().triangles[triangle];
    const glm::dvec3 a(mesh().positions[corners.x]);
    const glm::dvec3 e1 = glm::dvec3(mesh().positions[corners.y]) - a, e2 = glm::dvec3(mesh().positions[corners.z]) - a;
    const glm::vec2 p = texelPlace(triangle * 3ull);
    const glm::dvec2 d1(texelPlace(triangle * 3ull + 1) - p), d2(texelPlace(triangle * 3ull + 2) - p);
    const double aa = glm::dot(e1, e1), bb = glm::dot(e2, e2), ab = glm::dot(e1, e2), area = aa * bb - ab * ab;
    if (!(area > 1e-12 * aa * bb) || !(area > 0.0)) return {};
    const glm::dvec3 x = e1 * (d1.x * bb - d2.x * ab) + e2 * (d2.x * aa - d1.x * ab);
    const glm::dvec3 y = e1 * (d1.y * bb - d2.y * ab) + e2 * (d2.y * aa - d1.y * ab);
    return {glm::vec3(x / area), glm::vec3(y / area)};
}

// Sides of texels, by texels.
void TexelAtlas::measure() {
    std::vector<std::pair<float, float>> sides, shortest;  // metres, texels of that side
    double all = 0.0;
    for (std::uint32_t t = 0; t < mesh().triangleCount(); ++t) {
        const glm::vec2 p = texelPlace(t * 3ull);
        const glm::dvec2 d1(texelPlace(t * 3ull + 1) - p), d2(texelPlace(t * 3ull + 2) - p);
        const double texels = 0.5 * std::abs(d1.x * d2.y - d1.y * d2.x), area = triangleArea(mesh(), t);
        const Gradients g = gradients(t);
        // The longest that a metre can get: the larger singular value of both gradients.
        const auto xx = static_cast<double>(glm::dot(g.x, g.x)), yy = static_cast<double>(glm::dot(g.y, g.y)),
                   xy = static_cast<double>(glm::dot(g.x, g.y));
        const double longest = std::sqrt(0.5 * (xx + yy + std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy)));
        if (!(texels > 0.0) || !(area > 0.0) || !(longest > 0.0)) continue;
        sides.emplace_back(static_cast<float>(std::sqrt(area / texels)), static_cast<float>(texels));
        shortest.emplace_back(static_cast<float>(1.0 / longest), static_cast<float>(texels));
        all += texels;
    }
    const auto below = [&](std::vector<std::pair<float, float>>& of, double share) {
        std::sort(of.begin(), of.end());
        float found = 1.0f;
        double before = 0.0;
        for (const auto& [metres, texels] : of) {
            if (before > share * all) break;
            found = metres;
            before += static_cast<double>(texels);
        }
        return found;
    };
    m_usualTexel = below(sides, 0.5);
    m_fineTexel = std::min(below(shortest, 0.1), m_usualTexel);
}

void TexelAtlas::place(Raster& raster) {
    const auto count = raster.owner.size();
    const auto width = static_cast<std::size_t>(m_side), across = static_cast<std::size_t>(blocksAcross());
    m_slotOf.assign(count, none);
    m_firstSlot.assign(1, 0);
    std::vector<Slot> here;
    std::vector<Jump> beyond;
    for (std::size_t b = 0; b < across * across; ++b) {
        here.clear();
        for (std::size_t i = 0; i < std::size_t{block} * block; ++i) {
            const std::size_t x = b % across * block + i % block, y = b / across * block + i / block;
            const std::size_t texel = y * width + x;
            const glm::dvec2 middle(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            Slot slot{static_cast<std::uint32_t>(texel), raster.owner[texel], 0.0f, 0.0f};
            if (slot.triangle == none && raster.seam[texel] != none) {
                const auto there = raster.beyond(raster.seam[texel], glm::vec2(middle));
                if (!there) continue;
                slot.triangle = there->point.triangle;
                slot.u = there->point.u;
                slot.v = there->point.v;
                const glm::mat2& turn = there->turn;
                beyond.push_back(
                    {slot.texel, {turn[0][0], turn[1][0], turn[0][1], turn[1][1]}, {there->place.x, there->place.y}});
            } else if (slot.triangle != none) {
                const glm::dvec2 s = raster.shares(slot.triangle, middle);
                slot.u = static_cast<float>(s.x);
                slot.v = static_cast<float>(s.y);
            }
            if (slot.triangle != none) here.push_back(slot);
        }
        std::stable_sort(here.begin(), here.end(),
                         [](const Slot& p, const Slot& q) { return p.triangle < q.triangle; });
        for (const Slot& slot : here) {
            m_slotOf[slot.texel] = static_cast<std::uint32_t>(m_slots.size());
            m_slots.push_back(slot);
            const std::uint32_t x = slot.texel % static_cast<std::uint32_t>(m_side);
            const std::uint32_t y = slot.texel / static_cast<std::uint32_t>(m_side);
            m_placeInBlock.push_back(static_cast<std::uint8_t>(y % block * block + x % block));
        }
        m_firstSlot.push_back(static_cast<std::uint32_t>(m_slots.size()));
    }
    for (Jump& jump : beyond) jump.slot = m_slotOf[jump.slot];
    std::sort(beyond.begin(), beyond.end(), [](const Jump& p, const Jump& q) { return p.slot < q.slot; });
    m_jumps = std::move(beyond);
}

// Rings around charts, each texel from one of its neighbours of the ring before.
void TexelAtlas::fillAround() {
    const int least = pad, most = pad + m_size - 1;
    struct Taken {
        std::uint32_t texel, from;
    };
    std::vector<Taken> found, ring;
    PlainVector<std::uint32_t> source(m_slotOf.size());
    for (std::size_t i = 0; i < source.size(); ++i)
        source[i] = m_slotOf[i] != none ? static_cast<std::uint32_t>(i) : none;
    std::vector<std::uint32_t> edge;
    for (const Slot& slot : m_slots) edge.push_back(slot.texel);
    const auto width = static_cast<std::uint32_t>(m_side);
    for (int pass = 0; pass < fill; ++pass) {
        ring.clear();
        for (const std::uint32_t texel : edge) {
            const int x = static_cast<int>(texel % width), y = static_cast<int>(texel / width);
            for (int n = 0; n < 9; ++n) {
                const int nx = x + n % 3 - 1, ny = y + n / 3 - 1;
                if (nx < least || ny < least || nx > most || ny > most) continue;
                const auto next = static_cast<std::uint32_t>(ny) * width + static_cast<std::uint32_t>(nx);
                if (source[next] == none) ring.push_back({next, source[texel]});
            }
        }
        std::sort(ring.begin(), ring.end(), [](const Taken& p, const Taken& q) {
            return p.texel != q.texel ? p.texel < q.texel : p.from < q.from;
        });
        edge.clear();
        for (const Taken& f : ring) {
            if (source[f.texel] != none) continue;
            source[f.texel] = f.from;
            found.push_back(f);
            edge.push_back(f.texel);
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [&](const Taken& p, const Taken& q) { return blockOf(p.from) < blockOf(q.from); });
    m_firstFill.assign(blockCount() + 1, 0);
    for (const Taken& f : found) {
        ++m_firstFill[blockOf(f.from) + 1];
        const std::uint32_t x = f.texel % width - pad, y = f.texel / width - pad;
        m_fills.push_back({y * static_cast<std::uint32_t>(m_size) + x, m_slotOf[f.from]});
    }
    for (std::size_t b = 0; b < blockCount(); ++b) m_firstFill[b + 1] += m_firstFill[b];
}

std::vector<std::uint8_t> TexelAtlas::ringsAround(std::span<const std::uint8_t> blocks) const {
    const auto across = static_cast<std::size_t>(blocksAcross()), width = across + 2;
    // With a frame that is far from everything; once from the top left, once from the bottom right.
    std::vector<std::uint8_t> rings(width * width, 255);
    const auto next = [](std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
        return std::min(std::min(std::min(a, b), std::min(c, d)), std::uint8_t{254}) + 1;
    };
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const std::size_t i = (b / across + 1) * width + b % across + 1, up = i - width;
        rings[i] =
            blocks[b] ? 0 : static_cast<std::uint8_t>(next(rings[up - 1], rings[up], rings[up + 1], rings[i - 1]));
    }
    std::vector<std::uint8_t> found(blocks.size());
    for (std::size_t b = blocks.size(); b-- > 0;) {
        const std::size_t i = (b / across + 1) * width + b % across + 1, down = i + width;
        const int other = next(rings[down - 1], rings[down], rings[down + 1], rings[i + 1]);
        rings[i] = static_cast<std::uint8_t>(std::min<int>(rings[i], other));
        found[b] = rings[i];
    }
    return found;
}

}  // namespace whorl
