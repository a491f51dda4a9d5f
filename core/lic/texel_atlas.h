// SPDX-License-Identifier: Apache-2.0
// Where the texels of a square texture lie on a mesh, and what lies beyond the seams of its UVs.
#pragma once

#include "core/base/plain_vector.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/surface/surface.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

// Texels are numbered in a square of `side` that has a frame of `pad` around the texture, so that steps off its edge
// stay in memory. A texel whose middle no triangle covers, but that lies at most `margin` texels outside a seam, stands
// for the place that is as far beyond the seam, straight on over the skin. Further texels around charts are
// filled with what is near.

namespace whorl {

/// UVs that texels are laid out in.
enum class LicLayout {
    Best,  ///< those of the mesh, or an own atlas where they overlap, lie outside 0 to 1, leave seams no room or lack
    Mesh   ///< those of the mesh; where they overlap the last triangle counts
};

/// What mesh and size decide, made once. Immutable; any thread may ask.
class TexelAtlas {
public:
    static constexpr int pad = 8;
    static constexpr int block = 16;
    static constexpr float margin = 4.0f;
    static constexpr int fill = 8;  ///< texels around charts that get a value
    static constexpr std::uint32_t none = UINT32_MAX;

    /// Fails only when cancelled. `size`: 1 to 8192.
    static Result<TexelAtlas> make(std::shared_ptr<const Surface> surface, int size, LicLayout layout,
                                   Progress& progress);

    /// A texel that has a place.
    struct Slot {
        std::uint32_t texel;
        std::uint32_t triangle;
        float u, v;
        SurfacePoint point() const { return {triangle, u, v}; }
    };
    /// How the plane of texels goes on beyond a seam: `to` + `turn` * (place - middle of the texel), in texels.
    struct Jump {
        std::uint32_t slot;
        float turn[4];  ///< rows
        float to[2];
    };
    /// A texel of the texture (row * size + column) beside charts, and the slot that it gets its value from.
    struct Fill {
        std::uint32_t texel;
        std::uint32_t slot;
    };
    /// Coordinates of a triangle's plane: texels a metre.
    struct Gradients {
        glm::vec3 x{0.0f}, y{0.0f};
    };

    const Surface& surface() const { return *m_surface; }
    const SurfaceMesh& mesh() const { return m_surface->mesh(); }
    int size() const { return m_size; }
    int side() const { return m_side; }
    int blocksAcross() const { return m_side / block; }
    std::size_t blockCount() const { return m_firstSlot.size() - 1; }
    bool ownUvs() const { return m_ownUvs; }
    const std::shared_ptr<const std::vector<glm::vec2>>& cornerUvs() const { return m_cornerUvs; }

    std::span<const Slot> slots() const { return m_slots; }
    /// Slots of a block are `firstSlot(b)` up to `firstSlot(b + 1)`, ordered by triangle.
    std::uint32_t firstSlot(std::size_t b) const { return m_firstSlot[b]; }
    /// Row * `block` + column in its block.
    std::uint8_t placeInBlock(std::uint32_t slot) const { return m_placeInBlock[slot]; }
    /// `none` where no place is.
    std::uint32_t slotOf(std::uint32_t texel) const { return m_slotOf[texel]; }
    std::uint32_t blockOf(std::uint32_t texel) const {
        const auto width = static_cast<std::uint32_t>(m_side);
        return texel / width / block * static_cast<std::uint32_t>(blocksAcross()) + texel % width / block;
    }
    /// In order of slots.
    std::span<const Jump> jumps() const { return m_jumps; }
    std::span<const Fill> fills(std::size_t b) const {  ///< that take from block `b`
        return std::span(m_fills).subspan(m_firstFill[b], m_firstFill[b + 1] - m_firstFill[b]);
    }
    /// Zero for triangles without area.
    Gradients gradients(std::uint32_t triangle) const;
    glm::vec2 texelPlace(std::size_t corner) const;
    /// Metres of skin: half of the texels have a smaller side, and in one of ten a way of so much is more than a texel
    /// long in some direction.
    float usualTexel() const { return m_usualTexel; }
    float fineTexel() const { return m_fineTexel; }

    /// One a block: how many blocks away the nearest marked one is, in the plane of the texture; at most 255.
    std::vector<std::uint8_t> ringsAround(std::span<const std::uint8_t> blocks) const;

private:
    TexelAtlas() = default;
    struct Raster;
    void measure();
    void addMargins(Raster& raster) const;
    void place(Raster& raster);
    void fillAround();

    std::shared_ptr<const Surface> m_surface;
    std::shared_ptr<const std::vector<glm::vec2>> m_cornerUvs;
    int m_size = 0;
    int m_side = 0;
    bool m_ownUvs = false;
    float m_usualTexel = 0.0f;
    float m_fineTexel = 0.0f;
    std::vector<Slot> m_slots;
    std::vector<std::uint32_t> m_firstSlot;
    std::vector<std::uint8_t> m_placeInBlock;
    PlainVector<std::uint32_t> m_slotOf;
    std::vector<Jump> m_jumps;
    std::vector<Fill> m_fills;
    std::vector<std::uint32_t> m_firstFill;
};

}  // namespace whorl
