// SPDX-License-Identifier: Apache-2.0
// A view for strokes that come from scripts and tests, where there is no camera on a screen.
#pragma once

#include "core/base/result.h"
#include "core/brushes/brush.h"

#include <string_view>

namespace whorl {

/// Looks at the middle of the box from `azimuth` (radians; 0: from +Z, pi/2: from +X, the model's left side) and
/// `elevation` above the horizon (within a right angle), so far away that the box's surrounding ball fits the viewport.
/// Vertical field of view 0.55 rad. It is not the camera of any viewport: render/camera.h frames pictures on its own.
StrokeView orbitView(const Bounds& bounds, float azimuth, float elevation, glm::vec2 viewportPixels);

/// "front", "back", "left", "right", "top" or "azimuth,elevation" in degrees.
Result<StrokeView> namedOrbitView(std::string_view name, const Bounds& bounds, glm::vec2 viewportPixels);

}  // namespace whorl
