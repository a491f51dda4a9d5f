// SPDX-License-Identifier: Apache-2.0
#include "core/brushes/orbit_view.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace whorl {
namespace {

constexpr float rightAngle = 1.57079633f;

bool readNumber(std::string_view text, float& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}

}  // namespace

StrokeView orbitView(const Bounds& bounds, float azimuth, float elevation, glm::vec2 viewportPixels) {
    constexpr float fieldOfView = 0.55f;
    const glm::vec3 target = bounds.centre();
    const float radius = std::max(0.5f * glm::length(bounds.size()), 1e-6f);
    const float aspect = viewportPixels.x / viewportPixels.y;
    const float halfAngle = std::atan(std::tan(fieldOfView * 0.5f) * std::min(aspect, 1.0f));
    const float distance = radius / std::sin(halfAngle);
    // Straight down the view has no up: stop just before.
    elevation = std::clamp(elevation, -rightAngle + 1e-3f, rightAngle - 1e-3f);
    const glm::vec3 toEye(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                          std::cos(elevation) * std::cos(azimuth));
    StrokeView view;
    view.eyeGroom = target + toEye * distance;
    view.viewportPixels = viewportPixels;
    // Room around the mesh for hair.
    const glm::mat4 clipFromView = glm::perspective(
        fieldOfView, aspect, std::max(distance - 3.0f * radius, 0.05f * distance), distance + 3.0f * radius);
    view.clipFromGroom = clipFromView * glm::lookAt(view.eyeGroom, target, glm::vec3(0.0f, 1.0f, 0.0f));
    return view;
}

Result<StrokeView> namedOrbitView(std::string_view name, const Bounds& bounds, glm::vec2 viewportPixels) {
    const auto at = [&](float azimuth, float elevation) {
        return orbitView(bounds, azimuth, elevation, viewportPixels);
    };
    if (name == "front") return at(0.0f, 0.0f);
    if (name == "back") return at(2.0f * rightAngle, 0.0f);
    if (name == "left") return at(rightAngle, 0.0f);
    if (name == "right") return at(-rightAngle, 0.0f);
    if (name == "top") return at(0.0f, rightAngle);
    const std::size_t comma = name.find(',');
    float azimuth = 0.0f, elevation = 0.0f;
    if (comma == std::string_view::npos || !readNumber(name.substr(0, comma), azimuth) ||
        !readNumber(name.substr(comma + 1), elevation) || std::abs(azimuth) > 3600.0f || std::abs(elevation) > 90.0f) {
        return Error{"There is no view \"" + std::string(name) +
                     "\"; use front, back, left, right, top or AZIMUTH,ELEVATION in degrees."};
    }
    return at(azimuth * rightAngle / 90.0f, elevation * rightAngle / 90.0f);
}

}  // namespace whorl
