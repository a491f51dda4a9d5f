// SPDX-License-Identifier: Apache-2.0
// Guides as the processor draws them: what guides.vert.glsl and guides.frag.glsl do on a graphics card.
#pragma once

#include "core/model/guide_set.h"
#include "render/passes/scene_block.h"
#include "render/passes/strand_raster.h"

#include <vector>

namespace whorl {

/// How guides look: pixels and linear colours.
struct GuideLook {
    float halfWidth = 0.6f;
    float rootRadius = 1.5f;
    glm::vec3 rootColour{0.95f, 0.42f, 0.08f};
    glm::vec3 tipColour{1.0f, 0.85f, 0.35f};
    glm::vec3 dotColour{0.10f, 0.75f, 0.95f};
    float opacityNear = 0.6f;    ///< at the brush
    float opacityFar = 0.07f;    ///< elsewhere
    glm::vec2 fade{1e6f, 2e6f};  ///< depths between which guides become fainter
};

struct GuideRibbons {
    std::vector<RasterPoint> points;
    std::vector<std::uint32_t> segments;
};

/// Ribbons through at most `pieces` + 1 points of each guide, with dark rims and a dot at the root, for a picture of
/// `drawn` pixels that is shown with `shown` pixels.
void makeGuideRibbons(const GuideSet& guides, std::uint32_t pieces, const SceneBlock& scene,
                      const OverlayState& overlay, const GuideLook& look, glm::ivec2 drawn, glm::ivec2 shown,
                      GuideRibbons& ribbons);

}  // namespace whorl
