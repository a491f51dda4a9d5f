// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace whorl::samples {

/// Human ear for a head whose side it is blended into. All functions take points with x >= 0.
namespace ear {

/// Distance used to skip the ear when far away.
float bounds(const glm::vec3& p);

/// Blends the ear into a head whose distance at p is given.
float blend(const glm::vec3& p, float head);

/// Positive on the part of the surface that stands off the head.
float region(const glm::vec3& p);

/// Positive behind the rim, on the side that faces the head.
float backSide(const glm::vec3& p);

}  // namespace ear

}  // namespace whorl::samples
