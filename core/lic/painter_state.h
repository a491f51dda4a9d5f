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
          border(blocks),
          opacity(blocks),
          cover(blocks),
          colours(blocks) {}
    LicBlocks steps, noise, lengths, light, density, border, opacity, cover, colours;
    bool partings = false, ranks = false;
};

inline bool anyOf(const LicBlocks& blocks) {
    return std::ranges::find(blocks, 1) != blocks.end();
}

struct LicPainter::State {
    explicit State(TexelAtlas texels)
        : atlas(std::move(texels)), words(atlas), cover(atlas), colours(atlas), changes(atlas) {
        light.assign(atlas.slots().size(), 0);
        hair.assign(atlas.slots().size(), 0);
        landings.resize(atlas.blockCount());
    }

    /// What `groom`, `now` and `next` make stale of what was painted last; all of it when `fresh`.
    LicStale staleAgainst(const Groom& groom, const DirectionField& now, const LicPlan& next, bool fresh) const;
    void densityAgainst(const Groom& groom, LicStale& stale) const;
    void coloursAgainst(const Groom& groom, LicStale& stale) const;
    void setLengths(const Groom& groom, const LicBlocks& blocks);
    bool convolve(const LicBlocks& blocks, Progress& progress);
    template <class T, class Value>
    void write(std::shared_ptr<const std::vector<T>>& layer, std::size_t channels, const LicBlocks& blocks, bool fresh,
               Value&& value) const;
    void setTangents(LicTexture& texture, std::span<const std::uint32_t> triangles) const;

    const TexelAtlas atlas;
    std::mutex mutex;
    LicWords words;
    LicCover cover;
    LicColours colours;
    const LicChanges changes;
    std::vector<std::uint16_t> lengths;  // by block, empty without a map
    std::vector<std::uint8_t> light;     // one a slot, as `hair`
    std::vector<std::uint8_t> hair;
    std::vector<std::vector<std::uint32_t>> landings;  // by block: those that its streamlines jump to; `none`: many
    // What was painted last.
    bool painted = false;
    Groom groom;
    DirectionField field;
    LicPlan plan;
    float densityScale = 0.0f;
    LicTexture texture;
};

}  // namespace whorl
