// SPDX-License-Identifier: Apache-2.0
// The mesh with its textures, and one map of the groom in colour over it.
#pragma once

#include "core/model/groom.h"
#include "render/gl/draw.h"
#include "render/gl/program.h"
#include "render/passes/lic_pass.h"
#include "render/passes/map_texture.h"
#include "render/view_settings.h"

#include <glm/vec4.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace whorl {

class MeshPass {
public:
    static Result<MeshPass> create(int maxTextureSize);

    /// Uploads what differs from the last call.
    void setGroom(const Groom& groom, Uploads& uploads);
    /// One a triangle, opacity last, or none; shown while ViewSettings::heat is on. Uploads when the pointer differs.
    void setTriangleColours(std::shared_ptr<const std::vector<glm::vec4>> colours);
    /// Scene block, volumes and shadow map must be bound.
    /// `litByVertex`: cheaper, for meshes with fewer corners than they cover pixels. `lic`: hair texture, may be null.
    void draw(const ViewSettings& settings, bool litByVertex, const LicPass* lic, Uploads& uploads);
    /// Depth of all visible parts in the projection of scene.shadowFromGroom.
    void drawShadow();
    std::size_t triangles() const { return m_triangles; }

private:
    void bindBuffers() const;

    int m_maxTextureSize = 0;
    gl::Program m_programs[2][2];  // with hair texture; lit by vertex
    gl::Program m_shadowProgram;
    gl::Buffer m_positions;
    gl::Buffer m_normals;
    gl::Buffer m_corners;
    gl::Buffer m_uvs;
    gl::Buffer m_colours;
    gl::Texture m_groupColours;
    gl::Texture m_white;
    std::shared_ptr<const std::vector<glm::vec4>> m_triangleColours;
    Cow<SurfaceMesh> m_mesh;
    std::vector<PartSettings> m_parts;
    Cow<LicParams> m_lic;
    MapSet m_maps;
    std::map<std::string, MapTexture, std::less<>> m_textures;  // only maps that were needed
    std::size_t m_triangles = 0;
};

}  // namespace whorl
