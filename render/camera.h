// SPDX-License-Identifier: Apache-2.0
// The eye of a view: orbits a target.
#pragma once

#include "core/base/result.h"
#include "core/brushes/brush.h"
#include "core/surface/surface_point.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string_view>

namespace whorl {

/// Angles in radians: azimuth 0 looks at the front (from +Z), pi/2 at the model's left side (from +X); elevation above
/// the horizon. Distances in metres.
struct Camera {
    glm::vec3 target{0.0f};
    float distance = 1.0f;
    float azimuth = 0.0f;
    float elevation = 0.0f;
    float fieldOfView = 0.55f;  ///< vertical

    glm::vec3 eye() const;
    glm::mat4 viewFromGroom() const;
    /// Near and far planes fitted around `scene`.
    glm::mat4 clipFromView(glm::vec2 viewportPixels, const Bounds& scene) const;
    StrokeView strokeView(glm::vec2 viewportPixels, const Bounds& scene) const;

    void orbit(glm::vec2 pixels);
    void pan(glm::vec2 pixels, glm::vec2 viewportPixels);
    /// Above 1 comes nearer.
    void zoom(float factor);
    /// Moves target and distance so that the box fills the view.
    void frame(const Bounds& bounds, glm::vec2 viewportPixels);

    /// "front", "back", "left", "right" or "side" (from the model's left), "top", "three-quarter", or
    /// "azimuth,elevation" in degrees.
    static Result<Camera> named(std::string_view name, const Bounds& bounds, glm::vec2 viewportPixels);
};

}  // namespace whorl
