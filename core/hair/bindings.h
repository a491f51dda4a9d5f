// SPDX-License-Identifier: Apache-2.0
// Hairs bound to the guides that shape them: worked out once, used at every stroke sample.
#pragma once

#include "core/base/plain_vector.h"
#include "core/hair/guide_index.h"
#include "core/hair/roots.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// The guides of each hair, `perHair` places a hair of which counts[i] are in use.
struct Bindings {
    std::size_t perHair = 0;
    std::vector<std::uint8_t> counts;
    PlainVector<std::uint32_t> guides;  ///< indices in the GuideSet
    PlainVector<float> weights;         ///< those of a hair add up to 1
};

/// Binds `roots` (nothing useful when cancelled). Neighbouring roots should follow one another, as hairs do. `old`
/// gives its memory.
Bindings bindHairs(const Groom& groom, const GuideIndex& index, std::span<const HairRoot> roots, Progress& progress,
                   Bindings old = {});

}  // namespace whorl
