// SPDX-License-Identifier: Apache-2.0
// Hair texture as the graphics card takes it, with its smaller versions, made by whoever paints it.
#pragma once

#include "core/lic/texture.h"
#include "render/chart_mask.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

// Averages take in only texels that lie in charts, and the texels around a chart take the mean of those beside them:
// at no distance does a seam let through what lies between the charts.

namespace whorl {

/// Square images of four bytes a texel, lowest byte first, in tiles that one image shares with the next until they
/// differ. Immutable; any thread may read.
class LicImage {
public:
    static constexpr int tileSize = ChartMask::tileSize;
    /// Rows are tileSize texels apart; at the right and at the bottom a level may fill only a part.
    struct Tile {
        std::uint32_t texels[tileSize * tileSize];
    };
    using TilePointer = std::shared_ptr<const Tile>;
    using Tiles = std::vector<TilePointer>;  ///< row by row

    /// The image of `texture`; null when that is null or empty. `before`: null or any other image; what is the same
    /// there is not made again and keeps its tiles. The bytes are the same either way, at any number of threads.
    static std::shared_ptr<const LicImage> make(std::shared_ptr<const LicTexture> texture,
                                                const std::shared_ptr<const LicImage>& before = nullptr);

    /// What it was made of; never null or empty.
    const std::shared_ptr<const LicTexture>& texture() const { return m_texture; }
    int levels() const { return m_mask->levels(); }
    int side(int level) const { return m_mask->side(level); }
    /// Tone (128 is 0), its square, cover, LicTexture::sides; averaged as numbers.
    const Tiles& tones(int level) const { return m_tones[static_cast<std::size_t>(level)]; }
    /// Colour in sRGB, averaged as light.
    const Tiles& colours(int level) const { return m_colours[static_cast<std::size_t>(level)]; }

private:
    LicImage() = default;

    std::shared_ptr<const LicTexture> m_texture;
    std::shared_ptr<const ChartMask> m_mask;
    std::vector<Tiles> m_tones;
    std::vector<Tiles> m_colours;
};

}  // namespace whorl
