// SPDX-License-Identifier: Apache-2.0
// Which triangle covers a texel, and which seam is near it. Private to texel_atlas.cpp.
#pragma once

#include "core/lic/texel_atlas.h"
#include "core/surface/surface_walk.h"

#include <glm/mat2x2.hpp>

#include <optional>
#include <utility>

namespace whorl {

struct TexelAtlas::Raster {
    const TexelAtlas& atlas;
    std::vector<std::array<std::uint32_t, 3>> across;
    SurfaceWalk walk;
    std::vector<std::uint32_t> charts;  ///< one a triangle
    PlainVector<std::uint32_t> owner;   ///< triangle whose UVs hold the middle of the texel
    PlainVector<std::uint32_t> seam;    ///< 3 * triangle + edge: the nearest seam of which the texel is outside
    PlainVector<float> seamDistance;    ///< texels
    std::size_t covered = 0;            ///< texels that some triangle covers
    std::size_t twice = 0;              ///< that more than one does
    std::size_t besideSeams = 0;        ///< next to a seam, outside
    std::size_t taken = 0;              ///< of those, that another chart covers

    explicit Raster(const TexelAtlas& texels);
    bool roomFor(LicLayout layout) const;
    bool isSeam(std::uint32_t triangle, std::uint32_t edge) const;
    /// Shares of corners 1 and 2 at a place in texels.
    glm::dvec2 shares(std::uint32_t triangle, const glm::dvec2& place) const;

    /// What a place outside a seam (in texels) stands for: another place, and how the plane of texels is turned there.
    struct Beyond {
        glm::mat2 turn{1.0f};
        glm::vec2 place{0.0f};
        SurfacePoint point;
    };
    std::optional<Beyond> beyond(std::uint32_t seamEdge, const glm::vec2& place) const;

private:
    void cover();
    void findCharts();
    void findSeams();
    void besideSeam(std::uint32_t triangle, std::uint32_t edge);
};

}  // namespace whorl
