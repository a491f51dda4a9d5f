// SPDX-License-Identifier: Apache-2.0
#include "render/passes/scene_block.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

glm::vec3 turned(const glm::vec3& v, float azimuth) {
    const float c = std::cos(azimuth);
    const float s = std::sin(azimuth);
    return glm::vec3(c * v.x + s * v.z, v.y, -s * v.x + c * v.z);
}

glm::vec3 direction(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 1e-6f && std::isfinite(length) ? v / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

}  // namespace

glm::vec3 keyLightDirection(const Camera& camera, const ViewSettings& settings) {
    return direction(settings.lightFollowsCamera ? turned(settings.lightDirection, camera.azimuth)
                                                 : settings.lightDirection);
}

glm::mat3 lightAxes(const glm::vec3& towardsLight) {
    const glm::vec3 helper = std::abs(towardsLight.y) < 0.95f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 right = glm::normalize(glm::cross(helper, towardsLight));
    const glm::vec3 up = glm::cross(towardsLight, right);
    return glm::transpose(glm::mat3(right, up, towardsLight));
}

glm::mat4 shadowMatrix(const glm::vec3& towardsLight, const Bounds& bounds) {
    const glm::mat3 axes = lightAxes(towardsLight);
    const glm::vec3 centre = bounds.empty() ? glm::vec3(0.0f) : bounds.centre();
    const float radius = bounds.empty() ? 1.0f : std::max(glm::length(bounds.size()) * 0.51f, 1e-4f);
    const float scale = 0.5f / radius;
    glm::mat4 matrix(1.0f);
    for (int column = 0; column < 3; ++column) {
        matrix[column] = glm::vec4(axes[column] * glm::vec3(scale, scale, -scale), 0.0f);
    }
    const glm::vec3 middle = axes * centre * glm::vec3(scale, scale, -scale);
    matrix[3] = glm::vec4(glm::vec3(0.5f) - middle, 1.0f);
    return matrix;
}

SceneBlock sceneBlock(const Camera& camera, const ViewSettings& settings, const Bounds& scene, glm::ivec2 size) {
    const glm::vec2 pixels(std::max(size.x, 1), std::max(size.y, 1));
    SceneBlock block;
    const glm::mat4 clipFromView = camera.clipFromView(pixels, scene);
    block.clipFromGroom = clipFromView * camera.viewFromGroom();
    block.eye = glm::vec4(camera.eye(), 1.0f);
    // A soft studio: warm key as the artist sets it, cool fill from the other side, rim from above behind.
    const glm::vec3 key = keyLightDirection(camera, settings);
    const float azimuth = settings.lightFollowsCamera ? camera.azimuth : 0.0f;
    block.keyDirection = glm::vec4(key, 0.0f);
    block.keyColour = glm::vec4(1.62f, 1.53f, 1.42f, 0.0f);
    block.fillDirection = glm::vec4(turned(direction(glm::vec3(-0.85f, 0.15f, 0.6f)), azimuth), 0.0f);
    block.fillColour = glm::vec4(0.20f, 0.235f, 0.29f, 0.0f);
    block.rimDirection = glm::vec4(turned(direction(glm::vec3(-0.55f, 0.55f, -0.8f)), azimuth), 0.0f);
    block.rimColour = glm::vec4(0.85f, 0.92f, 1.05f, 0.0f);
    block.skyColour = glm::vec4(0.92f, 0.98f, 1.08f, 0.0f);
    block.groundColour = glm::vec4(0.30f, 0.25f, 0.22f, 0.0f);
    block.viewport = glm::vec4(pixels.x, pixels.y, 1.0f / pixels.x, 1.0f / pixels.y);
    block.hair = glm::vec4(settings.diffuse, settings.specular, std::max(settings.shininess, 1.0f), settings.ambient);
    block.pixel = glm::vec4(clipFromView[1][1] * pixels.y * 0.5f, std::max(settings.minPixelWidth, 0.05f), 0.5f, 0.0f);
    return block;
}

}  // namespace whorl
