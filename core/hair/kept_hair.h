// SPDX-License-Identifier: Apache-2.0
// The hair that a generator keeps for its next call: only what a change touches is made again.
#pragma once

#include "core/hair/batch_edit.h"

#include <memory>
#include <optional>
#include <vector>

namespace whorl {

/// What the newest groom changed, besides the wish.
struct HairChanges {
    bool density = true;   ///< everywhere: roots have to be made anew
    bool bindings = true;  ///< which guides shape a hair
    bool shape = true;     ///< parameters of shape, of every hair
    bool look = true;
    bool shapes = true;  ///< all guides
    bool clumps = true;
    std::vector<std::uint8_t> blocks;                     ///< of guides, one each: changed
    std::vector<std::uint8_t> guides;                     ///< one each: its points have changed
    std::vector<std::vector<std::uint8_t>> movedCentres;  ///< one list a clump, empty where none moved
    std::vector<std::uint32_t> places;                    ///< of the sampler's curve: paint on the density
    std::optional<TouchedMaps> shapeMaps, lookMaps;       ///< paint on what drives shape or look
};

class KeptHair {
public:
    /// The next renewal makes everything anew.
    void drop() { m_valid = false; }
    /// The same, and gives back the memory.
    void clear();
    /// Brings the hair up to `parts`. What was shared before stays as it is. Cancelled: as after drop.
    void renew(const HairParts& parts, const HairLookups& lookups, const HairWish& wish, const HairChanges& changes,
               Progress& progress);
    /// Vertices that the groom may do without are left out. Never changes while it is held.
    std::shared_ptr<const Strands> share(const Groom& groom);

private:
    void growAnew(const HairParts& parts, const HairLookups& lookups, const HairWish& wish, Progress& progress);
    void regrowAll(const HairParts& parts, const HairLookups& lookups, const HairChanges& changes, Progress& progress);
    void edit(const HairParts& parts, const HairLookups& lookups, const HairWish& wish, const HairChanges& changes,
              Progress& progress);
    std::vector<std::uint32_t> hairsOfChangedGuides(const HairChanges& changes) const;
    std::shared_ptr<Strands> otherStrands();
    void ownStrands();
    void ownCopy();
    void noteBehind(const std::vector<std::uint32_t>& which);

    bool m_valid = false;
    HairWish m_wish;
    Batch m_batch;
    std::shared_ptr<const Strands> m_thin;  // of the strands, without skipped vertices, or null
    std::shared_ptr<Strands> m_spare;       // what was shared before; used again when nobody holds it any more
    // The hairs that differ between the spare and the newest; nothing when the layout does, or many.
    std::optional<std::vector<std::uint32_t>> m_behind;
    std::size_t m_same = 0;  // first hairs of the spare that are those of the newest
};

/// One a guide: true when its points have changed, which only those in `blocks` may have.
std::vector<std::uint8_t> changedGuides(const GuideSet& before, const GuideSet& next,
                                        const std::vector<std::uint8_t>& blocks);

}  // namespace whorl
