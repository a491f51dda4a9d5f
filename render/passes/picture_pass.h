// SPDX-License-Identifier: Apache-2.0
// The picture in linear light: backdrop at first; resolve, tone curve and encoding at last.
#pragma once

#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/passes/strand_raster.h"
#include "render/view_settings.h"

#include <span>
#include <vector>

namespace whorl {

class PicturePass {
public:
    static Result<PicturePass> create();
    /// Binds the own framebuffer of that size and number of samples, with its depth cleared.
    void begin(glm::ivec2 size, int samples);
    void drawBackground(const ViewSettings& settings);
    /// Depth of every pixel, 0 near to 1 far, rows from the bottom. Ends multisampling: what follows is drawn into one
    /// sample a pixel.
    std::span<const float> resolveDepth();
    /// Lays what the processor drew over the picture, after resolveDepth.
    void drawLayer(const StrandRaster& layer);
    /// Into the target, scaled to its size.
    void finish(const ViewSettings& settings, unsigned target, glm::ivec2 size);

private:
    gl::Program m_background;
    gl::Program m_finish;
    gl::Program m_layerProgram;
    gl::Texture m_colour;
    gl::Texture m_depth;
    gl::Texture m_resolved;
    gl::Texture m_resolvedDepth;
    gl::Texture m_layer;
    gl::Texture m_small;
    gl::Framebuffer m_target;
    gl::Framebuffer m_resolvedTarget;
    gl::Framebuffer m_smallTarget;
    int m_samples = 0;
    bool m_isResolved = false;
    std::vector<float> m_depths;
};

}  // namespace whorl
