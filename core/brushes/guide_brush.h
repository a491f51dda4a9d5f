// SPDX-License-Identifier: Apache-2.0
// What brushes that reshape guides share: which guides, how strongly, in which order, and writing the result.
#pragma once

#include "core/brushes/brush.h"
#include "core/brushes/brush_index.h"
#include "core/brushes/constraints.h"
#include "core/brushes/screen.h"
#include "core/surface/parting_index.h"

#include <optional>
#include <span>
#include <vector>

namespace whorl {

/// One guide under the brush.
struct GuideTouch {
    std::uint32_t guide = 0;
    std::span<const glm::vec3> original;  ///< when the stroke first touched it: where lengths come from
    std::span<const float> weights;       ///< per point, falloff times strength
    float largest = 0.0f;                 ///< the largest of them
    float amount = 0.0f;                  ///< adds up over the stroke where `GuideBrush::gather` says so
    std::span<glm::vec3> points;          ///< in: as it is; out: as the brush wants it. The first stays
};

/// The region of this step; nothing where the brush has no place (a ball without skin or hair under the cursor).
std::optional<BrushArea> brushArea(BrushStep& step);

/// Which side of partings a stroke is on: that of the skin under its first step. The anchor follows the pointer but
/// does not cross a parting with it.
class StrokeSide {
public:
    /// Once a step, with the groom of any step: strokes do not change partings that hold guides back.
    void follow(const BrushStep& step);
    /// True when no parting stands between the guide's root and the stroke.
    bool has(const BrushStep& step, std::uint32_t guide) const;

private:
    bool m_made = false;
    PartingIndex m_partings;
    std::optional<PartingIndex::Root> m_anchor;
};

/// Base of brushes that move points. Several threads shape guides at once; the results are written in order, so that
/// only blocks with a changed guide are unshared.
class GuideBrush : public Brush {
public:
    void step(BrushStep& step) final;

protected:
    /// Once a step before any guide; false skips the step.
    virtual bool prepare(const BrushStep& step, const BrushArea& area);
    /// What this step adds to the guide's `amount`.
    virtual float gather(const BrushStep& step, float largest) const;
    /// Reshapes one guide. Const: called from several threads.
    virtual void shape(const BrushStep& step, const BrushArea& area, GuideTouch& touch) const = 0;

    /// Clearance to use, by the artist's settings.
    const SkinClearance& skin() const { return m_skin; }

private:
    SkinClearance m_skin;
    StrokeSide m_side;
    BrushIndex::Selection m_selection;
    std::vector<std::size_t> m_firstPoint;
    std::vector<glm::vec3> m_points;
    std::vector<std::uint32_t> m_changed;
};

}  // namespace whorl
