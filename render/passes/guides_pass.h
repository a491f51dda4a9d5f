// SPDX-License-Identifier: Apache-2.0
// Guides as lines with visible roots.
#pragma once

#include "core/model/guide_set.h"
#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/passes/guide_ribbons.h"
#include "render/passes/map_texture.h"
#include "render/view_settings.h"

namespace whorl {

class GuidesPass {
public:
    static Result<GuidesPass> create();
    /// Uploads the blocks that differ from the last call; all of them when counts of points changed.
    void setGuides(const GuideSet& guides, Uploads& uploads);
    /// Strong at the brush and faint elsewhere, so that the hair stays in sight; everywhere faint without a brush, and
    /// fainter from depth `fade.x` to `fade.y` and beyond.
    void draw(const OverlayState& overlay, glm::ivec2 size, const GuideLook& look);

private:
    GuideSet m_guides;
    std::vector<std::size_t> m_blockStart;    // first point of each block, and the end
    std::vector<std::uint32_t> m_firstPoint;  // of each guide, and the end
    gl::Buffer m_indices;
    std::size_t m_indexCount = 0;
    gl::Buffer m_rootPoints;
    gl::Program m_lines;
    gl::Program m_roots;
    gl::Buffer m_points;
};

}  // namespace whorl
