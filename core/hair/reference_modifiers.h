// SPDX-License-Identifier: Apache-2.0
// Modifiers and strands written for reading: one hair after another. Part of the reference (see reference.h).
#pragma once

#include "core/hair/guide_index.h"
#include "core/hair/modifiers/centres.h"
#include "core/hair/reference.h"
#include "core/hair/roots.h"
#include "core/hair/traits.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace whorl {

/// A hair from its guides alone: interpolated and scaled, from `start` on. Empty without guides.
std::vector<glm::vec3> referenceInterpolation(const Groom& groom, const GuideIndex& index, const HairRoot& root,
                                              const glm::vec3& start, float scale);

/// What modifiers need to know besides the hair.
struct ReferenceModifiers {
    const Groom& groom;
    const GuideIndex& index;
    const TraitLookup& traits;
    const ModifierChain& chain;
    const ClumpSet& clumps;  ///< places of the centres; their curves are made anew
};

/// All modifiers of the hair's group, in their order. `stages`, when not null, gets the curve after each.
void modifyReference(const ReferenceModifiers& with, const HairRoot& root, const HairTraits& traits,
                     std::span<const float> ease, std::vector<glm::vec3>& curve,
                     std::vector<HairStage>* stages = nullptr);

/// Points of one member of the strand around a base hair with these points and normals, before the cut.
std::vector<glm::vec3> referenceMember(std::span<const glm::vec3> base, std::span<const glm::vec3> normals,
                                       const HairRoot& root, const HairTraits& traits, std::span<const float> ease,
                                       float across, float up, float lift);

/// Normals of a member: those of its base hair (unit or nearly), turned to stand across the member.
std::vector<glm::vec3> referenceMemberNormals(std::span<const glm::vec3> points, std::span<const glm::vec3> normals);

}  // namespace whorl
