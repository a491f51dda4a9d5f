// SPDX-License-Identifier: Apache-2.0
// Camera and lights as every shader sees them.
#pragma once

#include "render/camera.h"
#include "render/view_settings.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace whorl {

/// The uniform block of resources/shaders/scene.glsl (std140: vectors of four and matrices only).
struct SceneBlock {
    glm::mat4 clipFromGroom{1.0f};
    glm::mat4 shadowFromGroom{1.0f};
    glm::mat4 voxelFromGroom{1.0f};
    glm::vec4 ambientScale{0.0f};
    glm::vec4 ambientOffset{-1.0f};
    glm::vec4 eye{0.0f};
    glm::vec4 keyDirection{0.0f};
    glm::vec4 keyColour{0.0f};
    glm::vec4 fillDirection{0.0f};
    glm::vec4 fillColour{0.0f};
    glm::vec4 rimDirection{0.0f};
    glm::vec4 rimColour{0.0f};
    glm::vec4 skyColour{0.0f};
    glm::vec4 groundColour{0.0f};
    glm::vec4 viewport{0.0f};
    glm::vec4 hair{0.0f};
    glm::vec4 shadow{0.0f};
    glm::vec4 pixel{0.0f};
};

/// Towards the key light, unit length, groom space.
glm::vec3 keyLightDirection(const Camera& camera, const ViewSettings& settings);

/// Rows are the light's right, up and backward axes (groom space to a space whose -z is the light's way).
glm::mat3 lightAxes(const glm::vec3& towardsLight);

/// To the mesh's shadow map, 0 to 1 in x, y and depth, fitted around the ball that holds `bounds`.
glm::mat4 shadowMatrix(const glm::vec3& towardsLight, const Bounds& bounds);

/// Camera and lights; shadow, voxel and ambient places are filled by those who make them.
SceneBlock sceneBlock(const Camera& camera, const ViewSettings& settings, const Bounds& scene, glm::ivec2 size);

}  // namespace whorl
