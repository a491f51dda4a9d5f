// SPDX-License-Identifier: Apache-2.0
// What a LicPainter keeps. Private to painter*.cpp.
#pragma once

#include "core/lic/lic_changes.h"
#include "core/lic/lic_colours.h"
#include "core/lic/lic_cover.h"
#include "core/lic/lic_words.h"
#include "core/lic/painter.h"

#include <algorithm>
#include <mutex>

namespace whorl {

/// What has to be made again, one a block.
struct LicStale {
    explicit LicStale(std::size_t blocks)
        : steps(blocks),
          noise(blocks),
          lengths(blocks),
          light(blocks),
          density(blocks),
          opacity(blocks),
          cover(blocks),
          colours(blocks) {}
    LicBlocks steps, noise, lengths, light, density, opacity, cover, colours;
    bool partings = false, ranks = false, border = false;
};

inline bool anyOf(const LicBlocks& blocks) {
    return std::ranges::find(blocks, 1) != blocks.end();
}

/// Blocks from `left` and `top` up to `right` and `bottom`; none where `right` is below `left`.
struct LicReach {
    std::int16_t left = 0, right = -1, top = 0, bottom = -1;
};

/// A block in which streamlines go on beyond a seam, `none` for too many to tell, and for how many steps at most.
struct LicLanding {
    std::uint32_t block;
    int steps;
};

struct LicPainter::State {
    explicit State(TexelAtlas texels)
        : atlas(std::move(texels)), words(atlas), cover(atlas), colours(atlas), changes(atlas) {
        hair.assign(atlas.slots().size(), 0);
        landings.resize(atlas.blockCount());
        reaches.resize(atlas.blockCount());
    }

    /// What `groom`, `now` and `next` make stale of what was painted last; all of it when `fresh`.
    LicStale staleAgainst(const Groom& groom, const DirectionField& now, const LicPlan& next, bool fresh) const;
    void densityAgainst(const Groom& groom, LicStale& stale) const;
    void coloursAgainst(const Groom& groom, LicStale& stale) const;
    void setLengths(const Groom& groom, const LicBlocks& blocks);
    void lightAgainst(const LicPlan& next, LicStale& stale) const;
    bool paintBlocks(const LicStale& stale, bool fresh, LicTexture& next, Progress& progress);
    void convolve(std::size_t b, int unseen, std::uint8_t* light);
    void setTangents(LicTexture& texture, std::span<const std::uint32_t> triangles) const;

    const TexelAtlas atlas;
    std::mutex mutex;
    LicWords words;
    LicCover cover;
    LicColours colours;
    const LicChanges changes;
    std::vector<std::uint16_t> lengths;  // by block, empty without a map
    std::vector<std::uint8_t> hair;      // one a slot: the convolved noise that tells hairs apart
    // By block: where its streamlines may have been before they went over a seam, and where they went on.
    std::vector<LicReach> reaches;
    std::vector<std::vector<LicLanding>> landings;
    // What was painted last.
    bool painted = false;
    Groom groom;
    DirectionField field;
    LicPlan plan;
    float densityScale = 0.0f;
    LicTexture texture;
};

}  // namespace whorl
