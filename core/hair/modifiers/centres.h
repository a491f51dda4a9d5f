// SPDX-License-Identifier: Apache-2.0
// The middles of locks: where they stand, their curves, and which one a hair belongs to.
#pragma once

#include "core/hair/bindings.h"
#include "core/hair/guide_shapes.h"
#include "core/hair/modifiers/chain.h"
#include "core/hair/modifiers/scatter.h"
#include "core/hair/traits.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Centres of one clump. Their curves are what hairs at their roots would be before frizz, kink and modifiers, with the
/// clump's own noise.
struct ClumpCentres {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    std::vector<HairRoot> roots;
    GuideIndex index;  ///< its group 0, whose guides are places in `roots`
    Bindings bindings;
    std::size_t stride = GuideShapes::lanes;
    std::vector<float> x, y, z;  ///< metres; vertex v of centre c at [c * stride + v]

    bool empty() const { return roots.empty(); }
};

/// Centres of all clumps of a groom, and what they are made with.
struct ClumpSet {
    Scatter scatter;
    std::vector<ClumpCentres> clumps;  ///< as many as ModifierChain::clumps

    /// Places and bindings of all centres, then their curves. `scatterChanged`: mesh or growing parts are not those of
    /// the last call.
    void build(const Groom& groom, const ModifierChain& chain, const GuideIndex& index, const GuideShapes& shapes,
               bool scatterChanged, Progress& progress);
    /// Curves again of centres that a guide with `changed[guide]` shapes (all for an empty span). Marks them in
    /// `moved`, one list a clump.
    void renew(const Groom& groom, const ModifierChain& chain, const GuideShapes& shapes,
               std::span<const std::uint8_t> changed, std::vector<std::vector<std::uint8_t>>& moved);
};

/// Nearest centre of each root for every clump, ClumpCentres::none where there is none; lists of the clumps of other
/// groups hold none only.
using CentresOfHairs = std::vector<std::vector<std::uint32_t>>;
CentresOfHairs centresOf(const ModifierChain& chain, const ClumpSet& set, std::span<const HairRoot> roots,
                         Progress& progress);

}  // namespace whorl
