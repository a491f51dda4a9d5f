// SPDX-License-Identifier: Apache-2.0
// From bound hairs to finished curves.
#pragma once

#include "core/hair/bindings.h"
#include "core/hair/guide_shapes.h"
#include "core/hair/modifiers/centres.h"
#include "core/hair/outside.h"
#include "core/hair/strands.h"
#include "core/hair/traits.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

using TraitList = PlainVector<HairTraits>;

/// All that hairs are made of. Refers to its parts, which must outlive it; arrays have one entry a root.
struct HairSources {
    const Groom& groom;
    const std::vector<HairRoot>& roots;
    const Bindings& bindings;
    const TraitList& traits;
    const GuideShapes& shapes;
    glm::vec3 kinkOffset;
    const SkinGuard* skin;  ///< null: nothing keeps outside
    const ModifierChain& chain;
    const ClumpSet& clumps;
    const CentresOfHairs& centres;
    const std::vector<std::uint32_t>& order;  ///< the roots that count, by place, in order of the curve
};

/// The roots that grow hair, in order, and the strands of each: strands [firstStrand[i], firstStrand[i + 1]) of the
/// i-th one, a single one or the members of a strand.
struct GrownHairs {
    std::vector<std::uint32_t> roots;
    std::vector<std::uint32_t> firstStrand{0};
    std::size_t count() const { return roots.size(); }
};

/// Traits of all roots (some left unset when cancelled). `old` gives its memory and, where `coloursKnown`, the colours
/// of the same roots.
TraitList makeTraits(const TraitLookup& lookup, std::span<const HairRoot> roots, Progress& progress, TraitList old = {},
                     bool coloursKnown = false);

/// Vertices of the hairs that a root grows; zero where it grows none.
std::uint32_t verticesOfRoot(const HairSources& sources, std::uint32_t root);

/// Fills in all that is one a hair for hair `hair` (a place in `grown`) and its members, but where its vertices begin.
void setHair(const HairSources& sources, const GrownHairs& grown, std::uint32_t hair, Strands& strands);

/// Makes room in `strands` for every root that grows a hair and fills in all that is one a hair.
GrownHairs layOut(const HairSources& sources, Strands& strands);

/// Fills in the vertices of the hairs `which` (places in `grown`), from any number of threads. Unfinished when
/// cancelled.
void evaluateHairs(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
                   Strands& strands, Progress& progress);

/// Gives the hairs `which` the widths and colours of their traits again; their shape stays.
void renewLook(const HairSources& sources, const GrownHairs& grown, std::span<const std::uint32_t> which,
               Strands& strands);

}  // namespace whorl
