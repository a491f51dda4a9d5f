// SPDX-License-Identifier: Apache-2.0
// A line that a stroke of the pointer draws on the skin: what brushes for partings and strokes share.
#pragma once

#include "core/brushes/brush.h"

#include <span>
#include <vector>

namespace whorl {

class DrawnLine {
public:
    /// Takes the place under the pointer; true when the line goes on to it. Steps off the skin are left out, the line
    /// goes on where the pointer comes back.
    bool add(const BrushStep& step);
    /// Places so far.
    std::size_t size() const { return m_places.size(); }
    /// On the skin, without the shaking of the hand; both ends stay. See tracedParting.
    Result<std::vector<SurfacePoint>> traced(const Surface& surface) const;

private:
    std::vector<glm::vec3> m_places;
};

/// Pixels from the pointer to the nearest of `points` that shows (those that look away or are hidden do not, when the
/// brush leaves such guides alone); infinite when there is none.
float pixelsTo(const BrushStep& step, std::span<const SurfacePoint> points);

/// The id of the stroke nearest to a pixel, within `radius` pixels, as pixelsTo sees it; 0 for none.
std::uint32_t strokeUnder(const Groom& groom, const Surface& surface, const StrokeView& view, glm::vec2 pixel,
                          float radius, bool frontOnly);

}  // namespace whorl
