// SPDX-License-Identifier: Apache-2.0
// Drawing hair texture, against the bare mesh; making and setting what a dab changes, against all of it.
#include "core/base/random.h"
#include "editor/cli/bench.h"
#include "render/gl/draw.h"
#include "render/offscreen.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace whorl {

std::vector<BenchRow> benchLicDraw();

namespace {

constexpr glm::ivec2 frameSize(1280, 720);
constexpr int textureSize = 2048;

/// Two triangles a cell, denser towards the poles.
SurfaceMesh ball(std::uint32_t rings) {
    const std::uint32_t sectors = rings * 2;
    SurfaceMesh mesh;
    std::vector<glm::vec2> uvs;
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        for (std::uint32_t sector = 0; sector <= sectors; ++sector) {
            const glm::vec2 uv(static_cast<float>(sector) / static_cast<float>(sectors),
                               (static_cast<float>(ring) + 0.001f) / (static_cast<float>(rings) + 0.002f));
            const float polar = 3.14159265f * uv.y, turn = 6.2831853f * uv.x;
            const glm::vec3 normal(std::sin(polar) * std::cos(turn), std::cos(polar),
                                   -std::sin(polar) * std::sin(turn));
            mesh.normals.push_back(normal);
            mesh.positions.push_back(normal * 0.1f);
            uvs.push_back(glm::vec2(uv.x, 1.0f - uv.y));
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = ring * (sectors + 1) + sector, b = a + sectors + 1;
            for (const glm::uvec3& corners : {glm::uvec3(a, b, a + 1), glm::uvec3(a + 1, b, b + 1)}) {
                mesh.triangles.push_back(corners);
                for (int k = 0; k < 3; ++k) mesh.cornerUvs.push_back(uvs[corners[k]]);
            }
        }
    }
    mesh.parts.push_back({.name = "ball", .triangleCount = mesh.triangleCount()});
    return mesh;
}

template <class T>
std::shared_ptr<const std::vector<T>> shared(std::vector<T> values) {
    return std::make_shared<const std::vector<T>>(std::move(values));
}

/// Hairs of many lengths down the ball.
LicTexture downwards(const Groom& groom) {
    constexpr auto texels = static_cast<std::size_t>(textureSize) * textureSize;
    const SurfaceMesh& mesh = *groom.mesh;
    LicTexture texture;
    texture.mesh = groom.mesh.share();
    texture.size = textureSize;
    std::vector<std::uint8_t> light(texels), colours(texels * 3, 80);
    for (std::size_t i = 0; i < texels; ++i) {
        const std::uint64_t x = i % textureSize, y = i / textureSize;
        light[i] = static_cast<std::uint8_t>(90.0f + 75.0f * randomFloat(3, x * 64 + (y + x * 37) / 90, 0));
    }
    texture.light = shared(std::move(light));
    texture.cover = shared(std::vector<std::uint8_t>(texels, 255));
    texture.colours = shared(std::move(colours));
    texture.cornerUvs = shared(mesh.cornerUvs);
    std::vector<glm::vec3> tangents;
    for (const glm::uvec3& corners : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 n = mesh.normals[corners[k]], down = n * n.y - glm::vec3(0.0f, 1.0f, 0.0f);
            const float length = glm::length(down);
            tangents.push_back(length > 1e-4f ? down / length : glm::vec3(1.0f, 0.0f, 0.0f));
        }
    }
    texture.tangents = shared(std::move(tangents));
    texture.mean = 0.5f;
    texture.deviation = 0.085f;
    return texture;
}

double meanDifference(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    return sum / static_cast<double>(std::max<std::size_t>(a.pixels.size(), 1));
}

void benchMesh(std::vector<BenchRow>& rows, OffscreenRenderer& offscreen, std::uint32_t rings, const char* size) {
    Groom groom;
    groom.mesh = Cow<SurfaceMesh>(ball(rings));
    groom.partSettings.edit().assign(1, {});
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    Renderer& renderer = offscreen.renderer();
    renderer.setGroom(groom, surface);
    renderer.setLicImage(LicImage::make(std::make_shared<const LicTexture>(downwards(groom))));
    Camera camera = *Camera::named("three-quarter", surface->bounds, glm::vec2(frameSize));
    gl::Texture colour = gl::Texture::make2D("bench frame", gl::Format::Rgba8, frameSize, gl::Wrap::Clamp);
    const gl::Framebuffer target("bench frame", &colour, nullptr);
    for (const bool interactive : {true, false}) {
        ViewSettings settings;
        settings.interactive = interactive;
        settings.showLic = true;
        ViewSettings bare = settings;
        bare.showLic = false;
        const auto frame = [&](const ViewSettings& how) {
            camera.orbit(glm::vec2(1.0f, 0.0f));
            renderer.draw(camera, how, {}, target.target(), frameSize);
            gl::finish();
        };
        const Medians medians = interleaved([&] { frame(settings); }, [&] { frame(bare); });
        BenchRow row;
        row.name = std::string("lic-draw/") + size + " triangles, 1280x720, " +
                   (interactive ? "while the view moves" : "still, 4 samples");
        row.seconds = medians.ours;
        row.baselineSeconds = medians.baseline;
        row.baseline = "the mesh without hair texture";
        row.items = 1;
        row.unit = "frames";
        row.correct = meanDifference(offscreen.draw(camera, settings, {}, frameSize.x, frameSize.y),
                                     offscreen.draw(camera, bare, {}, frameSize.x, frameSize.y)) > 2.0;
        row.note = renderer.software() ? "no graphics card" : "graphics card";
        rows.push_back(row);
    }
}

void benchSetting(std::vector<BenchRow>& rows, OffscreenRenderer& offscreen) {
    Groom groom;
    groom.mesh = Cow<SurfaceMesh>(ball(80));
    groom.partSettings.edit().assign(1, {});
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    Renderer& renderer = offscreen.renderer();
    renderer.setGroom(groom, surface);
    LicTexture before = downwards(groom);
    before.serial = 1;
    LicTexture after = before;
    std::vector<std::uint8_t> light = *before.light;
    for (std::size_t y = 700; y < 800; ++y)
        std::fill_n(light.begin() + static_cast<long>(y) * textureSize + 900, 100, 9);
    after.light = shared(std::move(light));
    after.serial = 2;
    after.changedSince = 1;
    after.changedFrom = {900, 700};
    after.changedTo = {1000, 800};
    const auto first = std::make_shared<const LicTexture>(before), second = std::make_shared<const LicTexture>(after);
    const std::shared_ptr<const LicImage> whole = LicImage::make(first);
    std::shared_ptr<const LicImage> next;
    const Medians making =
        interleaved([&] { next = LicImage::make(second, whole); }, [&] { next = LicImage::make(first); });
    BenchRow row;
    row.name = "lic-draw/image of a dab of 100 x 100 in 2048 x 2048";
    row.seconds = making.ours;
    row.baselineSeconds = making.baseline;
    row.baseline = "image of the whole texture, on the thread that paints it";
    row.correct = LicImage::make(second, whole) != whole;
    rows.push_back(row);

    next = LicImage::make(second, whole);
    renderer.setLicImage(whole);
    bool flip = false;
    const std::uint64_t tilesBefore = renderer.uploads().licTiles;
    const auto dab = [&] {
        renderer.setLicImage((flip = !flip) ? next : whole);
        gl::finish();
    };
    dab();
    const std::uint64_t tiles = renderer.uploads().licTiles - tilesBefore;
    const Medians dabs = interleaved(dab, {});
    const Medians all = interleaved(
        [&] {
            renderer.setLicImage(nullptr);
            renderer.setLicImage(whole);
            gl::finish();
        },
        {});
    row = {};
    row.name = "lic-draw/dab of 100 x 100 set on the drawing thread";
    row.seconds = dabs.ours;
    row.baselineSeconds = all.ours;
    row.baseline = "whole texture of 2048 x 2048 set there";
    row.correct = tiles > 0 && tiles < 10;
    row.note = std::to_string(tiles) + " tiles a dab";
    rows.push_back(row);
}

}  // namespace

std::vector<BenchRow> benchLicDraw() {
    std::vector<BenchRow> rows;
    Result<OffscreenRenderer> offscreen = OffscreenRenderer::create();
    if (!offscreen) {
        BenchRow row;
        row.name = "lic-draw";
        row.correct = false;
        row.note = offscreen.error().message;
        return {row};
    }
    benchMesh(rows, *offscreen, 50, "10,000");
    benchMesh(rows, *offscreen, 158, "100,000");
    benchMesh(rows, *offscreen, 500, "1,000,000");
    benchSetting(rows, *offscreen);
    return rows;
}

}  // namespace whorl
