// SPDX-License-Identifier: Apache-2.0
// Painting on the model: which texels of a map lie under a brush, and what a stroke has put on them so far.
#pragma once

#include "core/brushes/paint_places.h"
#include "core/surface/surface.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace whorl {

/// One dab of paint: a ball around the skin under the cursor.
struct PaintDab {
    glm::vec3 centre{0.0f};
    float radius = 0.0f;    ///< metres
    float strength = 1.0f;  ///< 0 to 1
    glm::vec3 eye{0.0f};
    bool frontOnly = true;  ///< leaves alone what faces away from the eye
    bool hard = false;      ///< the value itself everywhere in the ball: for maps of numbers such as groups
};

/// The texels of one map on one mesh, tile by tile as a stroke reaches them. Texels are found through the triangles
/// that cover their centres, so a seam between UV charts does not show; a texel that several triangles cover (mirrored
/// UVs) takes paint from each. Uncovered texels up to `border` texels beyond a chart go with its nearest triangle, so
/// that bilinear sampling at a seam never meets an unpainted texel. Where dabs overlap the stronger one counts: a
/// stroke does not pile up.
class PaintCanvas {
public:
    static constexpr int border = PaintPlaces::border;

    /// `base`: the map as the stroke found it; one channel.
    PaintCanvas(const Surface& surface, const Map& base);

    /// Paints `value` on the map of that name (same shape as the base). Unshares only tiles whose bytes change, and
    /// nothing when none do. True when any did.
    bool paint(MapSet& maps, std::string_view name, const PaintDab& dab, float value);

    /// Memory of the tiles reached so far, without what strokes share.
    std::size_t bytes() const;

private:
    // What the stroke has put on one tile.
    struct Mask {
        std::vector<float> strength;       // the largest so far, by texel; empty until reached
        std::vector<std::uint16_t> risen;  // texels that the newest dab raised; one may come twice
    };
    static void raise(Mask& mask, const PaintTile& tile, const PaintDab& dab);
    bool writeTile(MapSet& maps, std::string_view name, std::size_t index, float value);

    std::shared_ptr<PaintPlaces> m_places;
    Map m_base;
    std::vector<Mask> m_masks;  // by tile
    std::vector<std::uint8_t> m_wanted;
    std::vector<std::size_t> m_touched;
};

}  // namespace whorl
