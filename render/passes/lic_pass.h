// SPDX-License-Identifier: Apache-2.0
// Hair texture by line integral convolution on the graphics card, for the mesh pass to draw over the skin.
#pragma once

#include "core/lic/texture.h"
#include "core/model/lic_params.h"
#include "render/gl/objects.h"
#include "render/gl/program.h"
#include "render/passes/lic_mips.h"
#include "render/uploads.h"

#include <cstddef>
#include <memory>

namespace whorl {

class LicPass {
public:
    LicPass();

    /// May be null. Layers are compared with those before by pointer, then in tiles: only what differs is uploaded.
    void setTexture(std::shared_ptr<const LicTexture> texture, Uploads& uploads);
    /// There is a texture, and it is one of a mesh of so many triangles.
    bool covers(std::size_t triangles) const;
    /// Textures and uniforms for a program of mesh.vert.glsl and mesh.frag.glsl with LIC defined. `ambient`: how strong
    /// light from everywhere is, 1 as usual.
    void bind(gl::Program& program, const LicParams& params, float ambient) const;

private:
    std::shared_ptr<const LicTexture> m_texture;
    ChartMask m_mask;
    MipImage m_tones{MipImage::Encoding::Linear};
    MipImage m_colours{MipImage::Encoding::Srgb};
    gl::Texture m_toneTexture;
    gl::Texture m_colourTexture;
    gl::Buffer m_uvs;
    gl::Buffer m_tangents;
};

}  // namespace whorl
