// SPDX-License-Identifier: Apache-2.0
// Density in one byte: what the root sampler keeps of every piece of the surface.
#pragma once

#include "core/sampling/bordered_texels.h"
#include "core/sampling/density.h"

#include <cstdint>
#include <vector>

namespace whorl {

/// Code of a density between 0 and 1: 255 times its square root, so that thin fur is told from thinner. Zero only where
/// nothing grows (also for what is not a number). Code c stands for (c / 255)^2.
std::uint8_t densityCode(float density);

/// Measures triangles: codes of their pieces at a depth, in order of the curve in a triangle (see placeInTriangle).
/// What a piece's code is depends on the density at its middle, and on `scale`, only. Refers to groom and lookup, which
/// must outlive it.
class DensityCodes {
public:
    /// `texels`: of the map that decides alone, where that `readsTexels`. Must outlive it.
    DensityCodes(const Groom& groom, const DensityLookup& density, const BorderedTexels& texels);

    /// The map whose texels are worth reading first: the one that decides alone. Null when there is none.
    static const Map* readsTexels(const DensityLookup& density);

    /// Density of code 255; zero when nothing grows.
    double scale() const { return m_scale; }
    /// Appends the codes of a triangle, 4^depth or fewer where they are equal. Gives the depth of what was appended.
    int measure(std::uint32_t triangle, int depth, std::vector<std::uint8_t>& codes) const;

private:
    void measureThroughMap(std::uint32_t triangle, int depth, std::uint8_t* codes) const;
    void measureEach(std::uint32_t triangle, int depth, std::uint8_t* codes) const;

    const SurfaceMesh& m_mesh;
    const DensityLookup& m_density;
    const Map* m_map = nullptr;  // decides alone; texels times m_mapScale are 0 to 1
    const BorderedTexels& m_texels;
    float m_mapScale = 1.0f;
    float m_scale = 0.0f;
    bool m_even = false;  // one density everywhere
};

}  // namespace whorl
