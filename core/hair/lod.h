// SPDX-License-Identifier: Apache-2.0
// How many hairs a coat needs at the size that it is seen at.
#pragma once

#include "core/model/groom.h"

#include <cstdint>

namespace whorl {

/// What is seen of a coat, as a ball around it.
struct SeenCoat {
    float radius = 0.1f;       ///< metres, of a ball around the hair
    float distance = 1.0f;     ///< metres, from the eye to its middle
    float fieldOfView = 0.7f;  ///< radians, from the lower to the upper edge of the image
    float imageHeight = 1080;  ///< pixels
};

/// Diameter of the ball in the image, pixels: height x tan(a) / tan(fieldOfView / 2), where sin(a) = radius / distance.
/// Infinite inside the ball; zero for what is not a view (a field of view or height that is not above zero).
float diameterOnScreen(const SeenCoat& coat);

/// Share of `hairs` hairs, 0 to 1, to give GenerateOptions::lod: `hairsPerPixel` for each pixel of the disc that the
/// coat covers at most, pi / 4 x diameter^2 x hairsPerPixel / hairs. All of them close by; the farther away, the fewer
/// and the wider. Never less than `fewest` hairs (or all, when there are not so many), so that no coat vanishes.
float lodForScreen(const SeenCoat& coat, std::uint32_t hairs, float hairsPerPixel = 2.0f, std::uint32_t fewest = 64);

/// The share that leaves at most `most` of `hairs` hairs.
float lodForCount(std::uint32_t hairs, std::uint32_t most);

/// `groom` at a level of detail for good, as GenerateOptions::lod makes it: `share` of its hairs (above 0, at most 1),
/// a subset of all, and as much wider, but not wider than a groom may have them.
Groom atDetail(Groom groom, float share);

}  // namespace whorl
