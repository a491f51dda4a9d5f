// SPDX-License-Identifier: Apache-2.0
// Hair texture by line integral convolution on the graphics card, for the mesh pass to draw over the skin.
#pragma once

#include "core/model/lic_params.h"
#include "core/model/surface_mesh.h"
#include "render/gl/objects.h"
#include "render/gl/program.h"
#include "render/lic_image.h"
#include "render/uploads.h"

#include <memory>

namespace whorl {

class LicPass {
public:
    LicPass();

    /// May be null. Uploads the tiles and layers that are other objects than those before.
    void setImage(std::shared_ptr<const LicImage> image, Uploads& uploads);
    /// There is an image, and it was painted for this very mesh.
    bool covers(const SurfaceMesh& mesh) const;
    /// Textures and uniforms for a program of mesh.vert.glsl and mesh.frag.glsl with LIC defined. `ambient`: how strong
    /// light from everywhere is, 1 as usual.
    void bind(gl::Program& program, const LicParams& params, float ambient) const;

private:
    std::shared_ptr<const LicImage> m_image;
    gl::Texture m_tones;
    gl::Texture m_colours;
    gl::Buffer m_uvs;
    gl::Buffer m_tangents;
};

}  // namespace whorl
