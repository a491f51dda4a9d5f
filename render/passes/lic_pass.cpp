// SPDX-License-Identifier: Apache-2.0
#include "render/passes/lic_pass.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace whorl {
namespace {

constexpr int side = MipImage::tileSize;
constexpr std::uint8_t allSides = 7;

/// Marks tiles of a layer of `channels` bytes a texel that differ.
void markChanges(const LicTexture::Layer<std::uint8_t>& before, const LicTexture::Layer<std::uint8_t>& now, int size,
                 std::size_t channels, std::vector<std::uint8_t>& changed) {
    if (before == now) return;
    if (!before || !now || before->size() != now->size()) {
        std::fill(changed.begin(), changed.end(), std::uint8_t{1});
        return;
    }
    const int columns = MipImage::tiles(size);
    parallelFor(changed.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t tile = begin; tile < end; ++tile) {
            const int x = static_cast<int>(tile) % columns * side, y = static_cast<int>(tile) / columns * side;
            const std::size_t bytes = static_cast<std::size_t>(std::min(side, size - x)) * channels;
            for (int row = y; row < std::min(y + side, size) && changed[tile] == 0; ++row) {
                const std::size_t at =
                    (static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)) *
                    channels;
                if (std::memcmp(before->data() + at, now->data() + at, bytes) != 0) changed[tile] = 1;
            }
        }
    });
}

}  // namespace

LicPass::LicPass() : m_uvs("hair texture uvs"), m_tangents("hair texture tangents") {}

void LicPass::setTexture(std::shared_ptr<const LicTexture> texture, Uploads& uploads) {
    if (texture == m_texture) return;
    const std::shared_ptr<const LicTexture> before = std::exchange(m_texture, std::move(texture));
    if (!m_texture || m_texture->empty()) {
        m_texture = nullptr;
        return;
    }
    const LicTexture& now = *m_texture;
    const int size = now.size;
    const bool resized = !before || before->size != size;
    const bool fresh = resized || before->cornerUvs != now.cornerUvs;
    if (resized) {
        m_toneTexture = gl::Texture::make2D("hair tones", gl::Format::Rgba8, glm::ivec2(size), gl::Wrap::Clamp, true);
        m_colourTexture =
            gl::Texture::make2D("hair colours", gl::Format::Rgba8Srgb, glm::ivec2(size), gl::Wrap::Clamp, true);
    }
    if (fresh) {
        m_mask = ChartMask(size, *now.cornerUvs);
        m_uvs.upload(*now.cornerUvs);
        uploads.bytes += m_uvs.size();
    }
    if (!before || before->tangents != now.tangents) {
        m_tangents.upload(*now.tangents);
        uploads.bytes += m_tangents.size();
    }
    const auto sendTo = [&](gl::Texture& target) {
        return [&](const MipImage::Piece& piece) {
            target.uploadLevel(piece.level, piece.from, piece.size, piece.texels, side);
            if (piece.level == 0) ++uploads.licTiles;
            uploads.bytes += static_cast<std::size_t>(piece.size.x) * static_cast<std::size_t>(piece.size.y) * 4;
        };
    };
    const auto tiles = static_cast<std::size_t>(MipImage::tiles(size));
    std::vector<std::uint8_t> changed(tiles * tiles, fresh ? 1 : 0);
    if (!fresh) {
        if (before->mean != now.mean || before->deviation != now.deviation)
            std::fill(changed.begin(), changed.end(), std::uint8_t{1});
        markChanges(before->light, now.light, size, 1, changed);
        markChanges(before->cover, now.cover, size, 1, changed);
        markChanges(before->sides, now.sides, size, 1, changed);
    }
    std::array<MipImage::Texel, 256> tones;
    for (std::size_t i = 0; i < tones.size(); ++i) {
        const float tone = licTone(static_cast<float>(i) / 255.0f, now.mean, now.deviation);
        // 128 is zero.
        tones[i] = {static_cast<std::uint8_t>(tone * 127.0f + 128.5f),
                    static_cast<std::uint8_t>(tone * tone * 255.0f + 0.5f), 0, 255};
    }
    const auto at = [size](int row, int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
    };
    m_tones.update(
        m_mask, changed,
        [&](int row, int first, int last, MipImage::Texel* out) {
            for (int x = first; x < last; ++x, ++out) {
                const std::uint8_t cover = (*now.cover)[at(row, x)];
                // Where no hair lies there is no light to be told: what is around decides.
                *out = cover > 0 ? tones[(*now.light)[at(row, x)]] : MipImage::Texel{128, 0, 0, 255};
                (*out)[2] = cover;
                (*out)[3] = now.sides ? (*now.sides)[at(row, x)] : allSides;
            }
        },
        sendTo(m_toneTexture));
    std::fill(changed.begin(), changed.end(), fresh ? std::uint8_t{1} : std::uint8_t{0});
    if (!fresh) markChanges(before->colours, now.colours, size, 3, changed);
    m_colours.update(
        m_mask, changed,
        [&](int row, int first, int last, MipImage::Texel* out) {
            const std::uint8_t* from = now.colours->data() + at(row, first) * 3;
            for (int x = first; x < last; ++x, ++out, from += 3) *out = {from[0], from[1], from[2], 255};
        },
        sendTo(m_colourTexture));
}

bool LicPass::covers(std::size_t triangles) const {
    return m_texture && m_texture->cornerUvs->size() == triangles * 3;
}

void LicPass::bind(gl::Program& program, const LicParams& params, float ambient) const {
    m_toneTexture.bind(6);
    m_colourTexture.bind(7);
    m_uvs.bindStorage(5);
    m_tangents.bindStorage(6);
    program.set("licLight", glm::vec4(params.ambient * ambient, params.diffuse, params.specular,
                                      1.0f / std::max(params.shininess, 1.0f)));
    program.set("licTone", glm::vec4(params.contrast, params.tilt, m_texture->mean, 0.0f));
}

}  // namespace whorl
