// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/assemble.h"
#include "resources/samples/source/sculpt.h"

#include <glm/glm.hpp>

namespace whorl::samples {

/// Signed distance of the mannequin bust, in metres.
float bustDistance(const glm::vec3& p);

/// Positive on the closed upper lid, whose lower edge is a line the mesh must follow.
float bustUpperLid(const glm::vec3& p);
/// Positive on the upper lip, for the same reason.
float bustUpperLip(const glm::vec3& p);

/// Coverage (0..1) of painted features: red of the lips, closed lid, lash line.
struct BustMarks {
    float lips, lid, lash;
};
BustMarks bustMarks(const glm::vec3& p);

/// The bust before it is cut and packed, and how to do that; regions below 16. For sculptures that wear something.
HalfMesh bustHalf();
Recipe bustRecipe();

/// The bust, built once and kept for the painters.
const Sculpture& sharedBust();

}  // namespace whorl::samples
