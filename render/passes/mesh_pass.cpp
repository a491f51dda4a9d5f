// SPDX-License-Identifier: Apache-2.0
#include "render/passes/mesh_pass.h"

#include <algorithm>

namespace whorl {

Result<MeshPass> MeshPass::create(int maxTextureSize) {
    MeshPass pass;
    pass.m_maxTextureSize = maxTextureSize;
    for (const bool lic : {false, true}) {
        for (const bool litByVertex : {false, true}) {
            const std::string defines =
                std::string(lic ? "#define LIC\n" : "") + (litByVertex ? "#define VERTEX_LIT\n" : "");
            Result<gl::Program> program = gl::Program::draw("mesh.vert.glsl", "mesh.frag.glsl", defines);
            if (!program) return program.error();
            pass.m_programs[lic ? 1 : 0][litByVertex ? 1 : 0] = std::move(*program);
        }
    }
    Result<gl::Program> shadow = gl::Program::draw("mesh.vert.glsl", "empty.frag.glsl", "#define SHADOW\n");
    if (!shadow) return shadow.error();
    pass.m_shadowProgram = std::move(*shadow);
    pass.m_positions = gl::Buffer("mesh positions");
    pass.m_normals = gl::Buffer("mesh normals");
    pass.m_corners = gl::Buffer("mesh corners");
    pass.m_uvs = gl::Buffer("mesh uvs");
    pass.m_white = gl::Texture::make2D("white", gl::Format::Rgba8, glm::ivec2(1), gl::Wrap::Repeat);
    const std::uint32_t white = 0xffffffffu;
    pass.m_white.upload(glm::ivec2(0), glm::ivec2(1), &white);
    std::vector<std::uint8_t> palette;
    for (int group = 0; group < 256; ++group) {
        const glm::vec3 colour = groupColour(group);
        for (int i = 0; i < 3; ++i) palette.push_back(static_cast<std::uint8_t>(colour[i] * 255.0f + 0.5f));
    }
    pass.m_groupColours = gl::Texture::make2D("group colours", gl::Format::Rgb8, glm::ivec2(256, 1), gl::Wrap::Clamp);
    pass.m_groupColours.upload(glm::ivec2(0), glm::ivec2(256, 1), palette.data());
    pass.m_colours = gl::Buffer("triangle colours");
    return pass;
}

void MeshPass::setTriangleColours(std::shared_ptr<const std::vector<glm::vec4>> colours) {
    if (colours == m_triangleColours) return;
    m_triangleColours = std::move(colours);
    if (m_triangleColours) m_colours.upload(*m_triangleColours);
}

void MeshPass::setGroom(const Groom& groom, Uploads& uploads) {
    if (!m_mesh.sameAs(groom.mesh)) {
        m_mesh = groom.mesh;
        m_positions.upload(m_mesh->positions);
        m_normals.upload(m_mesh->normals);
        m_corners.upload(m_mesh->triangles);
        m_uvs.upload(m_mesh->cornerUvs);
        m_triangles = m_mesh->triangles.size();
        ++uploads.meshes;
        uploads.bytes += m_positions.size() + m_normals.size() + m_corners.size() + m_uvs.size();
    }
    m_parts = *groom.partSettings;
    m_lic = groom.lic;
    if (!m_maps.sameAs(groom.maps)) {
        m_maps = groom.maps;
        std::erase_if(m_textures, [&](const auto& entry) { return m_maps.find(entry.first) == nullptr; });
        for (auto& [name, texture] : m_textures) texture.update(*m_maps.find(name), m_maxTextureSize, uploads);
    }
}

void MeshPass::bindBuffers() const {
    m_positions.bindStorage(0);
    m_normals.bindStorage(1);
    m_corners.bindStorage(2);
    m_uvs.bindStorage(3);
}

void MeshPass::draw(const ViewSettings& settings, bool litByVertex, const LicPass* lic, Uploads& uploads) {
    if (m_triangles == 0) return;
    const auto textureOf = [&](const std::string& name) -> const MapTexture* {
        const Map* map = name.empty() ? nullptr : m_maps.find(name);
        if (map == nullptr || map->empty()) return nullptr;
        MapTexture& texture = m_textures[name];
        if (texture.empty()) texture.update(*map, m_maxTextureSize, uploads);
        return &texture;
    };
    const bool painted = lic != nullptr && settings.showLic && lic->covers(*m_mesh);
    gl::Program& program = m_programs[painted ? 1 : 0][litByVertex ? 1 : 0];
    if (painted) lic->bind(program, *m_lic, settings.ambient / ViewSettings().ambient);
    const MapTexture* overlay = textureOf(settings.overlayMap);
    program.set("overlayOpacity", overlay != nullptr ? std::clamp(settings.overlayOpacity, 0.0f, 1.0f) : 0.0f);
    if (overlay != nullptr) {
        overlay->bind(4);
        program.set("overlayFlipped", overlay->map().flipV ? 1 : 0);
        program.set("overlayColours", overlay->map().channels() == 3 ? 1 : 0);
        program.set("overlayRange", 1.0f);
        program.set("overlayGroups", settings.overlayGroups ? 1 : 0);
        m_groupColours.bind(5);
    } else {
        m_white.bind(4);
    }
    bindBuffers();
    // Colours of another mesh, which are about to be replaced, are not shown.
    const bool coloured = settings.heat && m_triangleColours && m_triangleColours->size() == m_triangles;
    program.set("coloured", coloured ? 1 : 0);
    if (coloured) m_colours.bindStorage(4);
    gl::apply({.depth = gl::Depth::TestWrite});
    for (std::size_t i = 0; i < m_mesh->parts.size(); ++i) {
        const MeshPart& part = m_mesh->parts[i];
        if (i < m_parts.size() && !m_parts[i].visible) continue;
        const MapTexture* texture = settings.showTexture ? textureOf(part.texture) : nullptr;
        program.set("baseColour", part.baseColour);
        int textured = 0;
        if (texture != nullptr) {
            texture->bind(3);
            // 8-bit sRGB is decoded by the card, 16-bit by the shader.
            textured = texture->map().srgb && texture->map().format() == TexelFormat::U16 ? 2 : 1;
            program.set("textureFlipped", texture->map().flipV ? 1 : 0);
        } else {
            m_white.bind(3);
        }
        program.set("textured", textured);
        program.use();
        gl::drawTriangles(std::size_t{3} * part.firstTriangle, std::size_t{3} * part.triangleCount);
    }
}

void MeshPass::drawShadow() {
    if (m_triangles == 0) return;
    bindBuffers();
    m_shadowProgram.use();
    gl::apply({.depth = gl::Depth::TestWrite, .slopeBias = 2.0f});
    for (std::size_t i = 0; i < m_mesh->parts.size(); ++i) {
        const MeshPart& part = m_mesh->parts[i];
        if (i < m_parts.size() && !m_parts[i].visible) continue;
        gl::drawTriangles(std::size_t{3} * part.firstTriangle, std::size_t{3} * part.triangleCount);
    }
}

}  // namespace whorl
