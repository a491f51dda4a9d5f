// SPDX-License-Identifier: Apache-2.0
#include "render/passes/lic_pass.h"

#include <algorithm>
#include <utility>

namespace whorl {
namespace {

void uploadTiles(gl::Texture& target, int level, int width, const LicImage::Tiles& now, const LicImage::Tiles* before,
                 Uploads& uploads) {
    constexpr int side = LicImage::tileSize;
    const int columns = ChartMask::tiles(width);
    for (int y = 0; y < columns; ++y) {
        for (int x = 0; x < columns; ++x) {
            const auto i = static_cast<std::size_t>(y * columns + x);
            if (before != nullptr && (*before)[i] == now[i]) continue;
            const glm::ivec2 from(x * side, y * side);
            const glm::ivec2 size(std::min(side, width - from.x), std::min(side, width - from.y));
            target.uploadLevel(level, from, size, now[i]->texels, side);
            if (level == 0) ++uploads.licTiles;
            uploads.bytes += static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4;
        }
    }
}

}  // namespace

LicPass::LicPass() : m_uvs("hair texture uvs"), m_tangents("hair texture tangents") {}

void LicPass::setImage(std::shared_ptr<const LicImage> image, Uploads& uploads) {
    if (image == m_image) return;
    const std::shared_ptr<const LicImage> before = std::exchange(m_image, std::move(image));
    if (!m_image) return;
    const LicTexture& now = *m_image->texture();
    const LicTexture* was = before ? before->texture().get() : nullptr;
    const bool resized = !was || was->size != now.size;
    if (resized) {
        const glm::ivec2 size(now.size);
        m_tones = gl::Texture::make2D("hair tones", gl::Format::Rgba8, size, gl::Wrap::Clamp, true);
        m_colours = gl::Texture::make2D("hair colours", gl::Format::Rgba8Srgb, size, gl::Wrap::Clamp, true);
    }
    if (!was || was->cornerUvs != now.cornerUvs) {
        m_uvs.upload(*now.cornerUvs);
        uploads.bytes += m_uvs.size();
    }
    if (!was || was->tangents != now.tangents) {
        m_tangents.upload(*now.tangents);
        uploads.bytes += m_tangents.size();
    }
    for (int level = 0; level < m_image->levels(); ++level) {
        const int width = m_image->side(level);
        uploadTiles(m_tones, level, width, m_image->tones(level), resized ? nullptr : &before->tones(level), uploads);
        uploadTiles(m_colours, level, width, m_image->colours(level), resized ? nullptr : &before->colours(level),
                    uploads);
    }
}

bool LicPass::covers(const SurfaceMesh& mesh) const {
    return m_image && m_image->texture()->mesh.get() == &mesh;
}

void LicPass::bind(gl::Program& program, const LicParams& params, float ambient) const {
    m_tones.bind(6);
    m_colours.bind(7);
    m_uvs.bindStorage(5);
    m_tangents.bindStorage(6);
    program.set("licLight", glm::vec4(params.ambient * ambient, params.diffuse, params.specular,
                                      1.0f / std::max(params.shininess, 1.0f)));
    program.set("licTone", glm::vec4(params.contrast, params.tilt, m_image->texture()->mean, 0.0f));
}

}  // namespace whorl
