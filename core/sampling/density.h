// SPDX-License-Identifier: Apache-2.0
// How much hair the artist asks for at a place.
#pragma once

#include "core/model/groom.h"

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <vector>

namespace whorl {

/// Density asked at a UV of a part: that of the group which the group map picks there (value x map), zero on parts
/// that grow no hair. Refers to the groom, which must outlive it.
class DensityLookup {
public:
    explicit DensityLookup(const Groom& groom);
    /// Zero or more; NaN and negative texels count as zero.
    float at(std::uint32_t triangle, glm::vec2 uv) const;
    int groupAt(glm::vec2 uv) const;
    /// True when the hairs of a group keep apart (GeneralParams::even).
    bool isEven(int group) const { return m_groups[static_cast<std::size_t>(group)].even; }
    /// True when those of any, of all groups do.
    bool anyEven() const;
    bool allEven() const;
    /// Largest texel count along one side of the maps in use: one texel is 1 / this. 1 when no map is used.
    int mapWidth() const { return m_width; }
    int mapHeight() const { return m_height; }
    bool growsOn(std::uint32_t triangle) const;
    /// One a triangle, zero for those that grow no hair.
    std::span<const std::uint8_t> grows() const { return m_growsByTriangle; }
    /// True when the density at the very place is above zero: a root near the edge of a painted area can lie in a
    /// sub-triangle with weight and yet on a texel without hair.
    bool growsAt(const SurfaceMesh& mesh, const SurfacePoint& root) const;
    /// No `at` is above this.
    float upperBound() const;
    /// No `at` is above this either, up to rounding, and paint on maps of integers does not change it: the largest
    /// value of a group, times the next power of two above all texels where a map holds floats.
    float scale() const;

    /// What decides alone where hair grows: the map of the only group in use, null when it has none. Nothing when there
    /// is a group map.
    struct Sole {
        float value;
        const Map* map;
    };
    std::optional<Sole> sole() const;

private:
    struct Entry {
        float value;
        const Map* map;
        bool even;
    };
    const Groom& m_groom;
    std::vector<Entry> m_groups;
    std::vector<std::uint8_t> m_growsByTriangle;
    const Map* m_groupMap = nullptr;
    int m_width = 1;
    int m_height = 1;
};

}  // namespace whorl
