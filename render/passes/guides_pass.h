// SPDX-License-Identifier: Apache-2.0
// Guides as lines with visible roots.
#pragma once

#include "core/model/guide_set.h"
#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/passes/map_texture.h"
#include "render/view_settings.h"

namespace whorl {

class GuidesPass {
public:
    static Result<GuidesPass> create();
    /// Uploads the blocks that differ from the last call; all of them when counts of points changed.
    void setGuides(const GuideSet& guides, Uploads& uploads);
    /// Strong at the brush and faint elsewhere, so that the hair stays in sight; everywhere faint without a brush.
    void draw(const OverlayState& overlay, glm::ivec2 size);

private:
    GuideSet m_guides;
    std::vector<std::size_t> m_firstPoint;  // of each block, and the end
    gl::Program m_lines;
    gl::Program m_roots;
    gl::Buffer m_points;
};

}  // namespace whorl
