// SPDX-License-Identifier: Apache-2.0
// Changes a batch of hair only where roots or hairs differ from before.
#pragma once

#include "core/hair/batch.h"
#include "core/model/map_changes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Hairs of a batch to be made again: those at `slots`, in order, instead of hairs [first, last) of the layout before.
/// Slots that grow no hair leave nothing.
struct HairEdit {
    std::uint32_t first = 0, last = 0;
    std::uint32_t firstSlot = 0, lastSlot = 0;  // in BatchEdit::slots
};

struct BatchEdit {
    std::vector<HairEdit> edits;  ///< in order; `first` and `last` never go back
    std::vector<std::uint32_t> slots;
    bool empty() const { return edits.empty(); }
};

/// Takes the roots of `ranges` (in order, apart) anew: those that are as before keep their slot, others get one, with
/// bindings, traits and centres. What is gone stays in its slot until the next call. Notes the hairs that this changes
/// in `edit`.
void renewRoots(const HairParts& parts, const HairLookups& lookups, const HairWish& wish,
                std::span<const RootRange> ranges, Batch& batch, BatchEdit& edit, Progress& progress);

/// Traits of roots where maps differ are made anew; notes those hairs in `edit`.
void renewTraits(const HairLookups& lookups, float lod, const TouchedMaps& maps, Batch& batch, BatchEdit& edit);

/// True when as many vertices and hairs come as go, edit by edit: nothing else has to move.
bool keepsLayout(const HairSources& sources, const GrownHairs& grown, const BatchEdit& edit, const Strands& strands);

/// Writes all that is one a hair of an edit that `keepsLayout` over what was there; see spliced.
void replaceHairs(const HairSources& sources, const BatchEdit& edit, GrownHairs& grown, Strands& strands,
                  std::vector<std::uint32_t>& which);

/// The strands after an edit: what is kept is copied from `from`, which has the layout `grown`; all that is one a hair
/// is filled in. The first `same` hairs of `to` are those of `from` already. `which`: places of hairs to be evaluated,
/// ascending.
GrownHairs spliced(const HairSources& sources, const GrownHairs& grown, const BatchEdit& edit, const Strands& from,
                   Strands& to, std::size_t same, std::vector<std::uint32_t>& which);

}  // namespace whorl
