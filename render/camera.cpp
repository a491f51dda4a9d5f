// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

namespace whorl {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
// At the very pole the view has no up direction.
constexpr float highestElevation = pi * 0.5f - 0.001f;

glm::vec3 towardsEye(const Camera& camera) {
    const float c = std::cos(camera.elevation);
    return glm::vec3(std::sin(camera.azimuth) * c, std::sin(camera.elevation), std::cos(camera.azimuth) * c);
}

float aspect(glm::vec2 viewportPixels) {
    return std::max(viewportPixels.x, 1.0f) / std::max(viewportPixels.y, 1.0f);
}

// Radius of the ball around the box; a box without size gets a small one.
float ballRadius(const Bounds& bounds) {
    return bounds.empty() ? 0.5f : std::max(glm::length(bounds.size()) * 0.5f, 1e-4f);
}

}  // namespace

glm::vec3 Camera::eye() const {
    return target + towardsEye(*this) * distance;
}

glm::mat4 Camera::viewFromGroom() const {
    return glm::lookAt(eye(), target, glm::vec3(0.0f, 1.0f, 0.0f));
}

glm::mat4 Camera::clipFromView(glm::vec2 viewportPixels, const Bounds& scene) const {
    const glm::vec3 centre = scene.empty() ? target : scene.centre();
    const float radius = ballRadius(scene) * 1.05f;
    const float depth = glm::dot(eye() - centre, towardsEye(*this));
    const float farPlane = std::max(depth + radius, distance * 0.01f + 1e-4f);
    const float nearPlane = std::clamp(depth - radius, farPlane * 0.002f, farPlane * 0.99f);
    return glm::perspective(fieldOfView, aspect(viewportPixels), nearPlane, farPlane);
}

StrokeView Camera::strokeView(glm::vec2 viewportPixels, const Bounds& scene) const {
    StrokeView view;
    view.clipFromGroom = clipFromView(viewportPixels, scene) * viewFromGroom();
    view.eyeGroom = eye();
    view.viewportPixels = viewportPixels;
    return view;
}

void Camera::orbit(glm::vec2 pixels) {
    azimuth = std::remainder(azimuth - pixels.x * 0.0075f, 2.0f * pi);
    elevation = std::clamp(elevation + pixels.y * 0.0075f, -highestElevation, highestElevation);
}

void Camera::pan(glm::vec2 pixels, glm::vec2 viewportPixels) {
    const float metresPerPixel = 2.0f * distance * std::tan(fieldOfView * 0.5f) / std::max(viewportPixels.y, 1.0f);
    const glm::mat4 view = viewFromGroom();
    const glm::vec3 right(view[0].x, view[1].x, view[2].x);
    const glm::vec3 up(view[0].y, view[1].y, view[2].y);
    target += (up * pixels.y - right * pixels.x) * metresPerPixel;
}

void Camera::zoom(float factor) {
    if (factor > 0.0f && std::isfinite(factor)) distance = std::clamp(distance / factor, 1e-3f, 1e4f);
}

void Camera::frame(const Bounds& bounds, glm::vec2 viewportPixels) {
    if (bounds.empty()) return;
    target = bounds.centre();
    const float tall = std::tan(fieldOfView * 0.5f);
    const float wide = tall * aspect(viewportPixels);
    const glm::vec3 backward = towardsEye(*this);
    const glm::vec3 right(std::cos(azimuth), 0.0f, -std::sin(azimuth));
    const glm::vec3 up = glm::cross(backward, right);
    // The nearest place from which every corner of the box is inside the view, with a small margin.
    float needed = 1e-3f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 half = bounds.size() * 0.5f;
        const glm::vec3 at((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                           (corner & 4) != 0 ? half.z : -half.z);
        const float depth = glm::dot(at, backward);
        needed = std::max(needed, depth + std::abs(glm::dot(at, right)) / wide);
        needed = std::max(needed, depth + std::abs(glm::dot(at, up)) / tall);
    }
    distance = needed * 1.06f;
}

Result<Camera> Camera::named(std::string_view name, const Bounds& bounds, glm::vec2 viewportPixels) {
    struct Named {
        std::string_view name;
        float azimuth;
        float elevation;
    };
    constexpr Named all[] = {{"front", 0.0f, 0.0f},
                             {"back", pi, 0.0f},
                             {"left", pi * 0.5f, 0.0f},
                             {"side", pi * 0.5f, 0.0f},
                             {"right", -pi * 0.5f, 0.0f},
                             {"top", 0.0f, highestElevation},
                             {"three-quarter", pi * 0.21f, 0.12f}};
    Camera camera;
    bool known = false;
    for (const Named& entry : all) {
        if (entry.name == name) {
            camera.azimuth = entry.azimuth;
            camera.elevation = entry.elevation;
            known = true;
        }
    }
    if (!known) {
        float degrees[2] = {0.0f, 0.0f};
        const char* at = name.data();
        const char* const end = at + name.size();
        for (int i = 0; i < 2; ++i) {
            const auto [next, fault] = std::from_chars(at, end, degrees[i]);
            const bool good = fault == std::errc{} && std::isfinite(degrees[i]) &&
                              (i == 0 ? next != end && *next == ',' : next == end);
            if (!good) {
                return Error{
                    "The view \"" + std::string(name) +
                    "\" is unknown; say front, back, left, right, side, top, three-quarter, or azimuth,elevation "
                    "in degrees such as 30,10."};
            }
            at = next + 1;
        }
        camera.azimuth = std::remainder(degrees[0], 360.0f) * pi / 180.0f;
        camera.elevation = std::clamp(degrees[1] * pi / 180.0f, -highestElevation, highestElevation);
    }
    camera.frame(bounds, viewportPixels);
    return camera;
}

}  // namespace whorl
