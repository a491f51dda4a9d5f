// SPDX-License-Identifier: Apache-2.0
#include "render/passes/shadow_pass.h"

#include "render/gl/draw.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {

ShadowPass::ShadowPass() {
    m_hairVolume = gl::Texture::make3D("hair shadow volume", gl::Format::R16, glm::ivec3(VoxelShadow::size));
    m_ambientVolume = gl::Texture::make3D("ambient volume", gl::Format::Rgba16F, glm::ivec3(AmbientVolume::size));
    m_map = gl::Texture::make2D("mesh shadow map", gl::Format::Depth32F, glm::ivec2(mapSize), gl::Wrap::Clamp);
    m_map.compareDepth();
    m_mapTarget = gl::Framebuffer("mesh shadow map", nullptr, &m_map);
}

void ShadowPass::update(const Strands* hair, const ViewSettings& settings, const HairDetail& detail, float lightSlack,
                        const Bounds& meshBounds, MeshPass* mesh, SceneBlock& scene, gl::Buffer& sceneBuffer) {
    const glm::vec3 light(scene.keyDirection);
    const bool shadows = settings.shadows == ShadowMode::Voxel;
    const auto moved = [&](const glm::vec3& before) {
        return lightSlack > 0.0f ? glm::dot(before, light) < std::cos(lightSlack) : before != light;
    };
    scene.shadow.x = 0.0f;
    scene.shadow.y = 1.0f / static_cast<float>(mapSize);
    if (hair != nullptr && shadows) {
        // While the view moves, shadows of other detail than what is drawn serve as well.
        const bool lenient = lightSlack > 0.0f;
        if (!m_hairValid || moved(m_hairLight) || (!lenient && !(m_hairDetail == detail))) {
            m_voxels.build(*hair, detail, light);
            m_hairVolume.upload3D(m_voxels.texels().data());
            m_hairLight = light;
            m_hairDetail = detail;
            m_hairValid = true;
        }
        if (m_ambient.texels().empty() || (!lenient && (!m_ambientValid || !(m_ambientDetail == detail)))) {
            m_ambient.build(*hair, detail);
            m_ambientVolume.upload3D(m_ambient.texels().data());
            m_ambientDetail = detail;
            m_ambientValid = true;
        }
        scene.voxelFromGroom = m_voxels.voxelFromGroom();
        scene.shadow.x = std::log2(std::clamp(settings.shadowAlpha, 0.01f, 1.0f)) * VoxelShadow::fullLayers;
        scene.ambientScale = glm::vec4(m_ambient.scale(), 0.0f);
        scene.ambientOffset = glm::vec4(m_ambient.offset(), 0.0f);
    }

    const bool drawn = mesh != nullptr && shadows;
    const bool outdated = !m_mapValid || moved(m_mapLight) || m_meshDrawn != drawn;
    if (outdated) m_mapLight = light;
    scene.shadowFromGroom = shadowMatrix(m_mapLight, meshBounds);
    const float radius = meshBounds.empty() ? 1.0f : glm::length(meshBounds.size()) * 0.51f;
    // Two texels out of the skin, so that it does not shadow itself.
    scene.shadow.z = 2.0f * 2.0f * radius / static_cast<float>(mapSize);
    if (outdated) {
        m_mapTarget.bind();
        m_mapTarget.clearDepth();
        if (drawn) {
            sceneBuffer.upload(&scene, sizeof(scene));
            sceneBuffer.bindUniform(0);
            mesh->drawShadow();
        }
        m_mapValid = true;
        m_meshDrawn = drawn;
    }
}

void ShadowPass::bind() const {
    m_hairVolume.bind(0);
    m_ambientVolume.bind(1);
    m_map.bind(2);
}

}  // namespace whorl
