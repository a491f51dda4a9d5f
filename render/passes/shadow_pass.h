// SPDX-License-Identifier: Apache-2.0
// Keeps what lights need up to date: hair volume, ambient volume and the mesh's shadow map.
#pragma once

#include "render/gl/objects.h"
#include "render/passes/mesh_pass.h"
#include "render/passes/scene_block.h"
#include "render/passes/voxel_shadow.h"

namespace whorl {

class ShadowPass {
public:
    ShadowPass();

    void meshChanged() { m_mapValid = false; }
    void hairChanged() {
        m_hairValid = false;
        m_ambientValid = false;
    }
    /// Makes what is out of date and fills the places of it in `scene`. `hair` and `mesh` may be null. Shadows
    /// stay while the light is within `lightSlack` radians of the one that made them; above zero, ambient light stays,
    /// too. Draws the shadow map with `sceneBuffer`.
    void update(const Strands* hair, const ViewSettings& settings, const HairDetail& detail, float lightSlack,
                const Bounds& meshBounds, MeshPass* mesh, SceneBlock& scene, gl::Buffer& sceneBuffer);
    void bind() const;

private:
    static constexpr int mapSize = 1024;

    gl::Texture m_hairVolume;
    gl::Texture m_ambientVolume;
    gl::Texture m_map;
    gl::Framebuffer m_mapTarget;
    VoxelShadow m_voxels;
    AmbientVolume m_ambient;
    glm::vec3 m_hairLight{0.0f};
    glm::vec3 m_mapLight{0.0f};
    HairDetail m_hairDetail{};
    HairDetail m_ambientDetail{};
    bool m_meshDrawn = false;
    bool m_hairValid = false;
    bool m_ambientValid = false;
    bool m_mapValid = false;
};

}  // namespace whorl
