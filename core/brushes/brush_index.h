// SPDX-License-Identifier: Apache-2.0
// Which guides a brush can touch, found by bounding balls instead of asking every point.
#pragma once

#include "core/brushes/screen.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace whorl {

/// Balls around guides and around blocks of guides, and what a stroke remembers of the guides that it touched. Lives as
/// long as one stroke: the view stays, roots stay.
class BrushIndex {
public:
    struct Ball {
        glm::vec3 centre{0.0f};
        float radius = 0.0f;
    };
    /// A guide with at least one point of weight above zero.
    struct Touched {
        std::uint32_t guide = 0;
        std::uint32_t firstWeight = 0;  ///< its weights are weights[firstWeight ... + number of its points]
        float largest = 0.0f;
    };
    struct Selection {
        std::vector<Touched> guides;  ///< ascending
        std::vector<float> weights;   ///< falloff of each point, without strength
    };

    /// Makes the balls when they do not fit `guides` (first use, guides added or erased).
    void follow(const GuideSet& guides);
    /// Forgets everything: guides were added or erased.
    void forget();

    /// The guides under the brush, exactly those that a pass over every point finds. With `frontOnly`, only those whose
    /// root faces the eye and is not hidden by the mesh.
    void select(const Groom& groom, const Surface& surface, const BrushArea& area, const StrokeView& view,
                bool frontOnly, bool mirrored, Selection& selection);
    /// The guide point nearest to the eye within `radiusPixels` of the cursor, as (point, true).
    std::optional<glm::vec3> frontPoint(const Groom& groom, const Surface& surface, const ScreenFrame& frame,
                                        glm::vec2 pixel, float radiusPixels, const StrokeView& view, bool frontOnly,
                                        bool mirrored);

    /// Call after the points of these guides (ascending) changed.
    void update(const GuideSet& guides, std::span<const std::uint32_t> changed);

    /// The points of a guide as they were when the stroke first touched it. Call `remember` before, from one thread;
    /// the span is good until the next `remember`.
    void remember(const GuideSet& guides, std::uint32_t guide);
    std::span<const glm::vec3> original(std::uint32_t guide) const;
    /// A number that a brush adds up for a remembered guide; starts at zero.
    float& amount(std::uint32_t guide) { return m_memories[m_memoryOf[guide]].amount; }

private:
    struct Memory {
        std::size_t firstPoint = 0;
        std::size_t count = 0;
        float amount = 0.0f;
    };
    bool rootShows(const Groom& groom, const Surface& surface, const StrokeView& view, std::size_t guide,
                   bool mirrored);
    void ballOfBlock(const GuideSet& guides, std::size_t block);

    std::vector<Ball> m_blocks;
    std::vector<Ball> m_guides;
    std::vector<std::uint8_t> m_shows[2];  // per guide, for the view and its mirror image: 0 not asked yet, 1 yes, 2 no
    std::vector<std::uint32_t> m_memoryOf;  // per guide; ~0 is none
    std::vector<Memory> m_memories;
    std::vector<glm::vec3> m_points;
    std::vector<std::size_t> m_candidates;
    std::vector<Selection> m_found;
    bool m_made = false;
};

/// True when the skin's side at `root` faces the eye and nothing of the mesh stands between.
bool rootFacesEye(const Surface& surface, const StrokeView& view, const SurfacePoint& root);

}  // namespace whorl
