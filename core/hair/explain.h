// SPDX-License-Identifier: Apache-2.0
// Why a hair is as it is.
#pragma once

#include "core/hair/reference.h"
#include "core/hair/roots.h"

#include <memory>
#include <string>
#include <vector>

namespace whorl {

/// A guide near a hair.
struct ExplainedGuide {
    std::uint32_t index = 0;  ///< in the GuideSet
    std::uint32_t id = 0;
    float weight = 0.0f;    ///< 0 for guides that a parting separates
    float distance = 0.0f;  ///< from root to root, metres
    float detour = 1.0f;    ///< PartingIndex::detour
};

/// A parameter that a map drives at the hair's root.
struct ExplainedMap {
    std::string parameter;  ///< "general/density"
    std::string map;
    float value = 0.0f;  ///< of the map there (first channel or mean), before it is multiplied
};

struct HairExplanation {
    HairRoot root;
    std::string group;
    bool grows = false;
    std::string why{};     ///< when it does not grow: a sentence
    float density = 0.0f;  ///< asked for at the root
    HairTraits traits{};
    std::vector<ExplainedGuide> guides;     ///< that shape it, heaviest first
    std::vector<ExplainedGuide> separated;  ///< nearest ones that a parting keeps away, at most as many as shape it
    std::vector<ExplainedMap> maps;
    std::vector<HairStage> stages;
};

/// Follows hair `id` of `count` (0: the groom's number of hairs) through its making, by the plain reference. `surface`
/// is that of the groom's mesh. Ids are numbers in the sampler's sequence: with gaps, where the density leaves hairs
/// out. Fails for ids that are beyond all hairs and grooms where nothing grows.
Result<HairExplanation> explainHair(const Groom& groom, std::shared_ptr<const Surface> surface, std::uint32_t id,
                                    std::uint32_t count, Progress& progress);

/// Lines of "name: value" for people.
std::string explanationText(const HairExplanation& explanation);

}  // namespace whorl
