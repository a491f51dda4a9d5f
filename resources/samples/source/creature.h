// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "resources/samples/source/sculpt.h"

#include <glm/glm.hpp>

namespace whorl::samples {

/// Distances to the creature's members before they are blended; for regions and painting.
struct CreatureMembers {
    float head, ear, trunk, foreleg, thigh, hindFoot, tail;
};
CreatureMembers creatureMembers(const glm::vec3& p);

/// Signed distances, in metres. The body has hollows for the eyes and nose, which are shapes of their own.
float creatureBody(const glm::vec3& p);
float creatureEye(const glm::vec3& p);
float creatureNose(const glm::vec3& p);

/// The head is modelled in a space of its own; eye, nose and ear places are given there.
glm::vec3 creatureHeadSpace(const glm::vec3& p);
glm::vec3 creatureFromHead(const glm::vec3& p);

/// A head-space point in the frame of the ear: x across, y from root (0) to tip (1), z forward out of the cup; metres
/// but y.
glm::vec3 creatureEarFrame(const glm::vec3& p);
/// The point of the tail's middle line nearest to p, and how far along the tail it is (0..1).
glm::vec4 creatureTailAxis(const glm::vec3& p);

extern const glm::vec3 kCreatureEye;
extern const glm::vec3 kCreatureNose;

enum CreaturePart { kCreatureFur, kCreatureEyes, kCreatureNosePart };

/// The creature, built once and kept for the painters.
const Sculpture& sharedCreature();

}  // namespace whorl::samples
