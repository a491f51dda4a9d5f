// SPDX-License-Identifier: Apache-2.0
// How much hair is asked for on a triangle as a whole: three ways of seed 001.
#pragma once

#include "core/sampling/density.h"

#include <glm/vec2.hpp>

#include <array>
#include <memory>
#include <string_view>

namespace whorl {

enum class TriangleDensity {
    Corners,  ///< average of what the corners ask for: quick, right for triangles about as small as texels
    Blurred,  ///< the same on maps blurred by a Gaussian, so that corners know of what lies around them
    Texels    ///< average over all texels in the triangle (seed 001 sums them): misses nothing
};
inline constexpr std::array<std::string_view, 3> triangleDensityNames{"corners", "blurred", "texels"};

/// Refers to the groom, which must outlive it. Any thread may ask.
class TriangleDensities {
public:
    TriangleDensities(const Groom& groom, TriangleDensity way);
    ~TriangleDensities();

    /// Mean density on a piece of a triangle of the mesh, given by the (u, v) of its corners.
    float mean(std::uint32_t triangle, const std::array<glm::vec2, 3>& piece) const;

private:
    float corners(std::uint32_t triangle, const std::array<glm::vec2, 3>& uvs) const;
    float texels(std::uint32_t triangle, const std::array<glm::vec2, 3>& uvs) const;

    const SurfaceMesh& m_mesh;
    TriangleDensity m_way;
    std::unique_ptr<const Groom> m_blurred;  // null unless Blurred
    DensityLookup m_density;
};

/// Gaussian blur with a standard deviation of `sigma` texels, cut off after three; the map repeats. Texels that are not
/// finite count as zero.
Map blurred(const Map& map, float sigma);

}  // namespace whorl
