// SPDX-License-Identifier: Apache-2.0
#include "render/passes/lic_pass.h"

#include "core/base/random.h"
#include "render/offscreen.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <functional>

namespace whorl {
namespace {

constexpr int textureSize = 512;

/// Hairs down a ball: each column of texels a hair of its own lightness, as a convolution of infinite length would be.
LicTexture ballTexture(const Cow<SurfaceMesh>& shape, int size, const std::function<float(float, float)>& coverAt,
                       float mean = 0.5f) {
    const SurfaceMesh& mesh = *shape;
    LicTexture texture;
    texture.mesh = shape.share();
    texture.size = size;
    std::vector<std::uint8_t> light, cover, colours;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float noise = randomFloat(7, static_cast<std::uint64_t>(x), static_cast<std::uint32_t>(y / 96));
            light.push_back(static_cast<std::uint8_t>((mean + 0.1f * (noise - 0.5f)) * 255.0f + 0.5f));
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
            const float v = 1.0f - (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
            cover.push_back(static_cast<std::uint8_t>(coverAt(u, v) * 255.0f + 0.5f));
            for (const int c : {96, 66, 44}) colours.push_back(static_cast<std::uint8_t>(c));
        }
    }
    texture.light = std::make_shared<const std::vector<std::uint8_t>>(std::move(light));
    texture.cover = std::make_shared<const std::vector<std::uint8_t>>(std::move(cover));
    texture.colours = std::make_shared<const std::vector<std::uint8_t>>(std::move(colours));
    texture.cornerUvs = std::make_shared<const std::vector<glm::vec2>>(mesh.cornerUvs);
    std::vector<glm::vec3> tangents;
    for (const glm::uvec3& corners : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 n = mesh.normals[corners[k]];
            glm::vec3 down = glm::vec3(0, -1, 0) + n * n.y;
            const float length = glm::length(down);
            tangents.push_back(length > 0.02f ? down / length : glm::vec3(0.0f));
        }
    }
    texture.tangents = std::make_shared<const std::vector<glm::vec3>>(std::move(tangents));
    texture.mean = mean;
    texture.deviation = 0.1f / std::sqrt(12.0f);
    return texture;
}

/// The same hair, turned by a right angle on the skin.
LicTexture turned(LicTexture texture, const SurfaceMesh& mesh) {
    std::vector<glm::vec3> tangents = *texture.tangents;
    for (std::size_t i = 0; i < tangents.size(); ++i)
        tangents[i] = glm::cross(mesh.normals[mesh.triangles[i / 3][static_cast<int>(i % 3)]], tangents[i]);
    texture.tangents = std::make_shared<const std::vector<glm::vec3>>(std::move(tangents));
    return texture;
}

std::shared_ptr<const LicTexture> shared(LicTexture texture) {
    return std::make_shared<const LicTexture>(std::move(texture));
}

/// Linear light of a pixel, all colours.
double lightAt(const Picture& picture, int x, int y) {
    const std::size_t i =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)) * 4;
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        sum += static_cast<double>(linearFromSrgb(static_cast<float>(picture.pixels[i + c]) / 255.0f));
    return sum / 3.0;
}

double meanLight(const Picture& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) sum += lightAt(picture, x, y);
    return sum / (static_cast<double>(picture.width) * picture.height);
}

/// Middle of where `a` is lighter than `b`, in shares of the picture from the left and the top.
glm::dvec2 middleOfDifference(const Picture& a, const Picture& b) {
    glm::dvec2 sum(0.0);
    double weights = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double more = std::max(lightAt(a, x, y) - lightAt(b, x, y), 0.0);
            sum += more * glm::dvec2((x + 0.5) / a.width, (y + 0.5) / a.height);
            weights += more;
        }
    }
    return sum / std::max(weights, 1e-9);
}

/// How far that light spreads across and up and down.
glm::dvec2 sizeOfDifference(const Picture& a, const Picture& b) {
    const glm::dvec2 middle = middleOfDifference(a, b);
    glm::dvec2 sum(0.0);
    double weights = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double more = std::max(lightAt(a, x, y) - lightAt(b, x, y), 0.0);
            const glm::dvec2 off = glm::dvec2((x + 0.5) / a.width, (y + 0.5) / a.height) - middle;
            sum += more * off * off;
            weights += more;
        }
    }
    return glm::sqrt(sum / std::max(weights, 1e-9));
}

int mostDifference(const Picture& a, const Picture& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
    return most;
}

}  // namespace

class LicPassTest : public QObject {
    Q_OBJECT

    std::unique_ptr<OffscreenRenderer> m_offscreen;
    Groom m_groom;
    std::shared_ptr<const Surface> m_surface;
    Camera m_camera;
    ViewSettings m_settings;
    std::shared_ptr<const LicImage> m_image;

    Picture draw(int side = 240) { return m_offscreen->draw(m_camera, m_settings, {}, side, side); }
    void setLic(const LicParams& params) {
        m_groom.lic.edit() = params;
        m_offscreen->renderer().setGroom(m_groom, m_surface);
    }
    void setTexture(const LicTexture& texture) {
        m_image = LicImage::make(shared(texture), m_image);
        m_offscreen->renderer().setLicImage(m_image);
    }
    LicTexture fullTexture(int size = textureSize) {
        return ballTexture(m_groom.mesh, size, [](float, float) { return 1.0f; });
    }

private Q_SLOTS:
    void init() {
        Result<OffscreenRenderer> offscreen = OffscreenRenderer::create();
        QVERIFY2(offscreen.ok(), offscreen.ok() ? "" : offscreen.error().message.c_str());
        m_offscreen = std::make_unique<OffscreenRenderer>(std::move(*offscreen));
        m_groom = testing::groomOn(testing::sphere(48, 64), 1);
        m_surface = std::make_shared<Surface>(m_groom.mesh);
        m_camera = *Camera::named("front", m_surface->bounds, glm::vec2(240.0f));
        m_offscreen->renderer().setGroom(m_groom, m_surface);
        m_settings = ViewSettings();
        m_settings.showLic = true;
        m_image = nullptr;
    }

    void tonesAreEvenAroundTheMean() {
        QCOMPARE(licTone(0.5f, 0.5f, 0.1f), 0.0f);
        QVERIFY(std::abs(licTone(0.6f, 0.5f, 0.1f) + licTone(0.4f, 0.5f, 0.1f)) < 1e-6f);
        QVERIFY(licTone(0.6f, 0.5f, 0.1f) > licTone(0.55f, 0.5f, 0.1f));
        QVERIFY(licTone(1.0f, 0.0f, 0.01f) < 1.0f);
        // The same hairs seen through a longer kernel, which differ less, are as dark and light.
        QVERIFY(std::abs(licTone(0.52f, 0.5f, 0.02f) - licTone(0.6f, 0.5f, 0.1f)) < 1e-5f);
        QCOMPARE(licTone(0.7f, 0.5f, 0.0f), 0.0f);
    }

    void withoutHairTheSkinIsAsItWas() {
        m_settings.showLic = false;
        const Picture skin = draw();
        m_settings.showLic = true;
        // No texture yet.
        QVERIFY(draw().pixels == skin.pixels);
        setTexture(ballTexture(m_groom.mesh, textureSize, [](float, float) { return 0.0f; }));
        const Picture bare = draw();
        // Two programs may round the last bit differently.
        QVERIFY2(mostDifference(bare, skin) <= 1, qPrintable(QString::number(mostDifference(bare, skin))));
        setTexture(fullTexture());
        QVERIFY(mostDifference(draw(), skin) > 60);
        m_settings.showLic = false;
        QVERIFY(draw().pixels == skin.pixels);
        // As lit by vertices while the view moves.
        m_settings.interactive = true;
        const Picture quick = draw();
        m_settings.showLic = true;
        setTexture(ballTexture(m_groom.mesh, textureSize, [](float, float) { return 0.0f; }));
        QVERIFY(mostDifference(draw(), quick) <= 1);
        m_offscreen->renderer().setLicImage(nullptr);
        QVERIFY(draw().pixels == quick.pixels);
    }

    void whileTheViewMovesItLooksTheSame() {
        setTexture(fullTexture());
        const double still = meanLight(draw());
        m_settings.interactive = true;
        const double moving = meanLight(draw());
        QVERIFY2(std::abs(moving - still) < 0.05 * still, qPrintable(QString("%1 and %2").arg(moving).arg(still)));
    }

    void textureOfAnotherMeshIsNotShown() {
        const Picture skin = draw();
        const auto full = [](float, float) { return 1.0f; };
        setTexture(ballTexture(Cow<SurfaceMesh>(testing::sphere(10, 12)), textureSize, full));
        QVERIFY(draw().pixels == skin.pixels);
        // Nor that of one with as many triangles, which nothing but its identity tells apart.
        const Cow<SurfaceMesh> mesh = m_groom.mesh;
        setTexture(ballTexture(mesh, textureSize, full));
        const Picture hair = draw();
        QVERIFY(mostDifference(hair, skin) > 60);
        m_groom.mesh = Cow<SurfaceMesh>(*mesh);
        m_offscreen->renderer().setGroom(m_groom, m_surface);
        QVERIFY(draw().pixels == skin.pixels);
        setTexture(ballTexture(m_groom.mesh, textureSize, full));
        QVERIFY(draw().pixels == hair.pixels);
        m_groom.mesh = mesh;
        m_offscreen->renderer().setGroom(m_groom, m_surface);
        QVERIFY(draw().pixels == skin.pixels);
    }

    void coverBlendsSkinAndHair() {
        m_settings.showLic = false;
        const double skin = meanLight(draw());
        m_settings.showLic = true;
        setTexture(fullTexture());
        const double hair = meanLight(draw());
        setTexture(ballTexture(m_groom.mesh, textureSize, [](float, float) { return 0.5f; }));
        const double half = meanLight(draw());
        QVERIFY2(hair < 0.75 * skin, qPrintable(QString("%1 against %2").arg(hair).arg(skin)));
        QVERIFY2(std::abs(half - 0.5 * (skin + hair)) < 0.01 * skin,
                 qPrintable(QString("%1 of %2 and %3").arg(half).arg(skin).arg(hair)));
    }

    void haloMovesWithTheLight() {
        setTexture(fullTexture());
        m_settings.lightFollowsCamera = false;
        LicParams gloss;
        gloss.specular = 1.0f;
        gloss.tilt = 0.0f;
        LicParams dull = gloss;
        dull.specular = 0.0f;
        const auto halo = [&](const glm::vec3& light) {
            m_settings.lightDirection = light;
            setLic(gloss);
            const Picture with = draw();
            setLic(dull);
            return middleOfDifference(with, draw());
        };
        const glm::dvec2 high = halo(glm::vec3(0.0f, 0.8f, 0.6f)), low = halo(glm::vec3(0.0f, -0.3f, 0.95f));
        QVERIFY2(low.y > high.y + 0.1, qPrintable(QString("%1 against %2").arg(low.y).arg(high.y)));
        // And with the eye: from above it comes to the top of the ball, which then is the middle of the picture.
        m_settings.lightDirection = glm::vec3(0.0f, 0.8f, 0.6f);
        m_camera.elevation = 0.6f;
        const glm::dvec2 above = halo(glm::vec3(0.0f, 0.8f, 0.6f));
        QVERIFY2(std::abs(above.y - high.y) > 0.03, qPrintable(QString("%1 against %2").arg(above.y).arg(high.y)));
    }

    void tiltMovesTheHaloAlongTheHair() {
        setTexture(fullTexture());
        LicParams gloss;
        gloss.specular = 1.0f;
        const auto halo = [&](float tilt) {
            gloss.tilt = tilt;
            gloss.specular = 1.0f;
            setLic(gloss);
            const Picture with = draw();
            gloss.specular = 0.0f;
            setLic(gloss);
            return middleOfDifference(with, draw()).y;
        };
        QVERIFY(std::abs(halo(0.3f) - halo(-0.3f)) > 0.02);
    }

    void haloLiesAcrossTheHair() {
        m_settings.lightFollowsCamera = false;
        m_settings.lightDirection = glm::vec3(0.0f, 0.0f, 1.0f);
        LicParams params;
        params.shininess = 120.0f;
        params.tilt = 0.0f;
        const auto size = [&](const LicTexture& texture) {
            setTexture(texture);
            params.specular = 1.0f;
            setLic(params);
            const Picture with = draw();
            params.specular = 0.0f;
            setLic(params);
            return sizeOfDifference(with, draw());
        };
        const glm::dvec2 down = size(fullTexture());
        const glm::dvec2 around = size(turned(fullTexture(), *m_groom.mesh));
        QVERIFY2(down.x > 1.3 * down.y, qPrintable(QString("%1 by %2").arg(down.x).arg(down.y)));
        QVERIFY2(around.y > 1.3 * around.x, qPrintable(QString("%1 by %2").arg(around.x).arg(around.y)));
    }

    // Hairs narrower than a pixel: as light as those that are seen one by one, and without their contrast.
    void brightnessStaysOverDistance() {
        setTexture(fullTexture(2048));
        // Below the shoulder of the tone curve, which takes from single bright hairs.
        m_settings.exposure = 0.5f;
        for (const float shininess : {10.0f, 40.0f, 300.0f}) {
            LicParams params;
            params.shininess = shininess;
            params.specular = 0.6f;
            params.contrast = 1.0f;
            setLic(params);
            const double near = meanLight(draw(900));
            for (const int side : {450, 225, 110, 60}) {
                const double far = meanLight(draw(side));
                QVERIFY2(std::abs(far / near - 1.0) < 0.02, qPrintable(QString("%1 pixels, shininess %2: %3 of %4")
                                                                           .arg(side)
                                                                           .arg(double{shininess})
                                                                           .arg(far)
                                                                           .arg(near)));
            }
        }
    }

    void farHairDoesNotShimmer() {
        // Turned by a fraction of a pixel, the picture from far changes hardly.
        setTexture(fullTexture(2048));
        LicParams params;
        params.contrast = 1.0f;
        setLic(params);
        m_settings.lightFollowsCamera = false;
        const auto change = [&] {
            m_camera.azimuth = 0.0f;
            const Picture before = draw(60);
            m_camera.azimuth = 0.006f;
            return mostDifference(before, draw(60));
        };
        const int hair = change();
        // The outline of the ball moves, too.
        m_settings.showLic = false;
        const int skin = change();
        QVERIFY2(hair <= skin + 2, qPrintable(QString("%1 against %2").arg(hair).arg(skin)));
    }

    void contrastIsThatOfTheParameter() {
        m_settings.lightFollowsCamera = false;
        setTexture(fullTexture());
        const auto spread = [&](float contrast) {
            LicParams params;
            params.contrast = contrast;
            params.specular = 0.0f;
            setLic(params);
            const Picture picture = draw(480);
            double sum = 0.0;
            for (int x = 180; x < 300; ++x) sum += std::abs(lightAt(picture, x, 240) - lightAt(picture, x + 1, 240));
            return sum / 120.0;
        };
        const double none = spread(0.0f), some = spread(0.4f), full = spread(0.8f);
        QVERIFY2(none < 0.25 * some, qPrintable(QString("%1 %2").arg(none).arg(some)));
        QVERIFY2(full > 1.5 * some, qPrintable(QString("%1 %2").arg(full).arg(some)));
    }

    void moreWhiteIsLighter() {
        double before = 0.0;
        for (const float mean : {0.05f, 0.3f, 0.5f, 0.75f, 0.95f}) {
            setTexture(ballTexture(
                m_groom.mesh, textureSize, [](float, float) { return 1.0f; }, mean));
            const double light = meanLight(draw());
            QVERIFY2(light > before * 1.02, qPrintable(QString("%1: %2").arg(double{mean}).arg(light)));
            before = light;
        }
    }

    void hairFacingAwayFromTheLightIsDark() {
        setTexture(fullTexture());
        m_settings.lightFollowsCamera = false;
        m_settings.lightDirection = glm::vec3(0.0f, 0.0f, 1.0f);
        const double lit = lightAt(draw(), 120, 120);
        m_settings.lightDirection = glm::vec3(0.0f, 0.0f, -1.0f);
        const double dark = lightAt(draw(), 120, 120);
        QVERIFY2(dark < 0.5 * lit, qPrintable(QString("%1 against %2").arg(dark).arg(lit)));
    }

    void strandsCastShadowsOnIt() {
        auto strands = std::make_shared<Strands>();
        // A fringe before the ball, towards the light, that the eye looks past.
        for (int i = 0; i < 4000; ++i) {
            const float x = -0.08f + 0.16f * static_cast<float>(i % 200) / 200.0f;
            const float z = 0.12f + 0.02f * static_cast<float>(i / 200) / 20.0f;
            for (int j = 0; j < 4; ++j) {
                strands->positions.push_back(glm::vec3(x, 0.13f + 0.01f * static_cast<float>(j), z));
                strands->normals.push_back(glm::vec3(0, 0, 1));
                strands->widths.push_back(0.0004f);
                strands->colours.push_back(glm::vec4(0.2f, 0.1f, 0.05f, 1.0f));
            }
            strands->firstVertex.push_back(static_cast<std::uint32_t>(strands->positions.size()));
            strands->ids.push_back(static_cast<std::uint32_t>(i));
            strands->roots.push_back({});
            strands->rootUvs.push_back(glm::vec2(0));
            strands->groups.push_back(0);
        }
        setTexture(fullTexture());
        m_settings.lightFollowsCamera = false;
        m_settings.lightDirection = glm::vec3(0.0f, 0.8f, 0.6f);
        m_settings.fullCount = 0.0f;
        const auto lower = [&] {
            const Picture picture = draw();
            double sum = 0.0;
            for (int y = 50; y < 75; ++y) sum += lightAt(picture, 120, y);
            return sum;
        };
        const double open = lower();
        m_offscreen->renderer().setStrands(strands);
        const double shaded = lower();
        QVERIFY2(shaded < 0.9 * open, qPrintable(QString("%1 against %2").arg(shaded).arg(open)));
    }

    void partialUploadEqualsWhole() {
        Renderer& renderer = m_offscreen->renderer();
        for (const int size : {512, 300}) {
            renderer.setLicImage(nullptr);
            m_image = nullptr;
            LicTexture texture = fullTexture(size);
            const std::uint64_t atFirst = renderer.uploads().licTiles;
            setTexture(texture);
            const std::uint64_t all = renderer.uploads().licTiles - atFirst;
            const auto tiles = static_cast<std::uint64_t>(ChartMask::tiles(size));
            QCOMPARE(all, 2 * tiles * tiles);
            draw();

            std::vector<std::uint8_t> light = *texture.light, cover = *texture.cover;
            for (int y = size / 2; y < size / 2 + 20; ++y) {
                for (int x = size / 4; x < size / 4 + 30; ++x) {
                    light[static_cast<std::size_t>(y * size + x)] = static_cast<std::uint8_t>(x % 2 == 0 ? 250 : 0);
                    cover[static_cast<std::size_t>(y * size + x)] = 200;
                }
            }
            texture.light = std::make_shared<const std::vector<std::uint8_t>>(std::move(light));
            texture.cover = std::make_shared<const std::vector<std::uint8_t>>(std::move(cover));
            const std::uint64_t before = renderer.uploads().licTiles;
            setTexture(texture);
            const std::uint64_t part = renderer.uploads().licTiles - before;
            QVERIFY2(part >= 1 && part <= 4, qPrintable(QString::number(part)));
            // Nothing new: nothing travels.
            const Uploads same = renderer.uploads();
            setTexture(texture);
            QVERIFY(renderer.uploads() == same);

            Result<OffscreenRenderer> other = OffscreenRenderer::create();
            QVERIFY(other.ok());
            other->renderer().setGroom(m_groom, m_surface);
            other->renderer().setLicImage(LicImage::make(shared(texture)));
            for (const int side : {400, 100, 25}) {
                QVERIFY(other->draw(m_camera, m_settings, {}, side, side).pixels == draw(side).pixels);
            }
        }
    }

    // Two triangles whose corners point apart: on each side of the line hair is lit as if the other were not there.
    void hairBesideAPartingIsThatOfItsSide() {
        const SurfaceMesh mesh = testing::plane(1, 0.2f);
        m_groom = testing::groomOn(mesh, 1);
        m_surface = std::make_shared<Surface>(m_groom.mesh);
        m_camera = *Camera::named("top", m_surface->bounds, glm::vec2(240.0f));
        m_offscreen->renderer().setGroom(m_groom, m_surface);
        LicTexture texture = fullTexture(64);
        texture.light = std::make_shared<const std::vector<std::uint8_t>>(texture.light->size(), std::uint8_t{128});
        const auto pointing = [&](const glm::vec3& left, const glm::vec3& right) {
            std::vector<glm::vec3> tangents;
            for (const glm::uvec3& corners : mesh.triangles)
                for (int k = 0; k < 3; ++k) tangents.push_back(mesh.positions[corners[k]].x < 0.0f ? left : right);
            return std::make_shared<const std::vector<glm::vec3>>(std::move(tangents));
        };
        const auto sidesAt = [&](float line) {
            std::vector<std::uint8_t> sides(64 * 64, 7);
            for (std::size_t i = 0; i < sides.size(); ++i) {
                const glm::vec2 uv((static_cast<float>(i % 64) + 0.5f) / 64.0f,
                                   1.0f - (static_cast<float>(i / 64) + 0.5f) / 64.0f);
                // The triangle that the texel lies in, and its corners on the same side.
                for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
                    const glm::vec2* p = mesh.cornerUvs.data() + 3 * t;
                    int own = 0;
                    bool left = true, right = true;  // of all its edges
                    for (int k = 0; k < 3; ++k) {
                        const glm::vec2 e = p[(k + 1) % 3] - p[k], d = uv - p[k];
                        left = left && e.x * d.y - e.y * d.x >= 0.0f;
                        right = right && e.x * d.y - e.y * d.x <= 0.0f;
                        own |= (p[k].x < 0.5f) == (uv.x < line) ? 1 << k : 0;
                    }
                    if (left || right) sides[i] = static_cast<std::uint8_t>(own | static_cast<int>(t) * 8);
                }
            }
            return std::make_shared<const std::vector<std::uint8_t>>(std::move(sides));
        };
        const glm::vec3 across = glm::normalize(glm::vec3(1.0f, 0.0f, 0.3f)), away(-0.6f, 0.0f, 0.8f);
        texture.sides = sidesAt(0.5f);
        texture.tangents = pointing(across, away);
        setTexture(texture);
        const Picture both = draw();
        texture.tangents = pointing(across, across);
        setTexture(texture);
        const Picture left = draw();
        texture.tangents = pointing(away, away);
        setTexture(texture);
        const Picture right = draw();
        QVERIFY(mostDifference(left, right) > 10);
        int wrong = 0;
        for (int y = 40; y < 200; ++y) {
            for (int x = 40; x < 200; ++x) {
                // Along the line, and along the diagonal, where pixels see two triangles.
                if (std::abs(x - 120) < 4 || std::abs(x + y - 239) < 3) continue;
                const double should = lightAt(x < 120 ? left : right, x, y);
                wrong += std::abs(lightAt(both, x, y) - should) > 0.01 ? 1 : 0;
            }
        }
        QCOMPARE(wrong, 0);
        // Without sides, corners are mixed.
        texture.sides = nullptr;
        texture.tangents = pointing(across, away);
        setTexture(texture);
        QVERIFY(mostDifference(draw(), both) > 10);
    }

    // Charts that cover little of the texture: far away, nothing of what lies between them is seen.
    void seamsStayClosedFarAway() {
        LicTexture texture = fullTexture(512);
        // Hairs of one tone, which are the same in both layouts.
        texture.light = std::make_shared<const std::vector<std::uint8_t>>(texture.light->size(), std::uint8_t{128});
        const LicTexture whole = texture;
        std::vector<glm::vec2> uvs(m_groom.mesh->cornerUvs);
        const SurfaceMesh& mesh = *m_groom.mesh;
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            // Two charts: the side of the triangle's middle decides.
            float low = 1.0f, high = 0.0f;
            for (std::uint32_t k = 0; k < 3; ++k) {
                low = std::min(low, mesh.cornerUvs[t * 3 + k].x);
                high = std::max(high, mesh.cornerUvs[t * 3 + k].x);
            }
            const bool left = 0.5f * (low + high) < 0.5f;
            for (std::uint32_t k = 0; k < 3; ++k)
                uvs[t * 3 + k].x = mesh.cornerUvs[t * 3 + k].x * 0.8f + (left ? 0.0f : 0.2f);
        }
        texture.cornerUvs = std::make_shared<const std::vector<glm::vec2>>(uvs);
        std::vector<std::uint8_t> cover(texture.cover->size(), 255);
        for (int y = 0; y < 512; ++y) {
            for (int x = 0; x < 512; ++x) {
                const float u = (static_cast<float>(x) + 0.5f) / 512.0f;
                // A margin of two texels, as a painter leaves it.
                if (u > 0.4f + 2.0f / 512.0f && u < 0.6f - 2.0f / 512.0f)
                    cover[static_cast<std::size_t>(y * 512 + x)] = 0;
            }
        }
        texture.cover = std::make_shared<const std::vector<std::uint8_t>>(std::move(cover));
        for (const float azimuth : {0.0f, 1.5707963f, 3.1415927f, 4.712389f}) {
            m_camera.azimuth = azimuth;
            setTexture(texture);
            const Picture apart = draw(50);
            setTexture(whole);
            const int most = mostDifference(apart, draw(50));
            QVERIFY2(most <= 3, qPrintable(QString("%1 at %2").arg(most).arg(double{azimuth})));
        }
    }
};

}  // namespace whorl

QTEST_APPLESS_MAIN(whorl::LicPassTest)
#include "lic_pass_test.moc"
