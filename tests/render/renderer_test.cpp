// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include "render/gl/program.h"
#include "render/offscreen.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

constexpr int side = 160;

// Hairs straight out of a ball, bent downwards.
std::shared_ptr<const Strands> ballHair(const Groom& groom, int hairs, float length = 0.05f, float width = 0.0004f) {
    auto strands = std::make_shared<Strands>();
    const SurfaceMesh& mesh = *groom.mesh;
    for (int i = 0; i < hairs; ++i) {
        const auto triangle = static_cast<std::uint32_t>(static_cast<std::uint64_t>(i) * mesh.triangleCount() /
                                                         static_cast<std::uint64_t>(hairs));
        const SurfacePoint root{triangle, 0.3f, 0.3f};
        const glm::vec3 normal = normalAt(mesh, root);
        const glm::vec3 start = positionAt(mesh, root);
        for (int j = 0; j < 8; ++j) {
            const float t = static_cast<float>(j) / 7.0f;
            strands->positions.push_back(start + normal * (length * t) + glm::vec3(0, -0.3f * length * t * t, 0));
            strands->normals.push_back(normal);
            strands->widths.push_back(width);
            strands->colours.push_back(glm::vec4(0.3f, 0.16f, 0.08f, 1.0f));
        }
        strands->firstVertex.push_back(static_cast<std::uint32_t>(strands->positions.size()));
        strands->ids.push_back(static_cast<std::uint32_t>(i));
        strands->roots.push_back(root);
        strands->rootUvs.push_back(glm::vec2(0));
        strands->groups.push_back(0);
    }
    return strands;
}

double meanLight(const Picture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) sum += i % 4 == 3 ? 0 : picture.pixels[i];
    return sum / static_cast<double>(picture.pixels.size());
}

int pixelsThatDiffer(const Picture& a, const Picture& b, int tolerance) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
        int most = 0;
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, std::abs(int{a.pixels[i + k]} - int{b.pixels[i + k]}));
        count += most > tolerance ? 1 : 0;
    }
    return count;
}

}  // namespace

class RendererTest : public QObject {
    Q_OBJECT

    std::unique_ptr<OffscreenRenderer> m_offscreen;
    Groom m_groom;
    std::shared_ptr<const Surface> m_surface;
    Camera m_camera;

    Picture draw(const ViewSettings& settings, const OverlayState& overlay = {}) {
        return m_offscreen->draw(m_camera, settings, overlay, side, side);
    }

private Q_SLOTS:
    void init() {
        Result<OffscreenRenderer> offscreen = OffscreenRenderer::create();
        QVERIFY2(offscreen.ok(), offscreen.ok() ? "" : offscreen.error().message.c_str());
        m_offscreen = std::make_unique<OffscreenRenderer>(std::move(*offscreen));
        m_groom = testing::groomOn(testing::sphere(24, 32), 150);
        m_surface = std::make_shared<Surface>(m_groom.mesh);
        Bounds bounds = m_surface->bounds;
        bounds.add(glm::vec3(0.16f));
        bounds.add(glm::vec3(-0.16f));
        m_camera = *Camera::named("front", bounds, glm::vec2(side));
        m_offscreen->renderer().setGroom(m_groom, m_surface);
    }

    void pictureShowsTheMesh() {
        const Picture picture = draw({});
        QCOMPARE(picture.width, side);
        QCOMPARE(picture.pixels.size(), std::size_t{side} * side * 4);
        const auto at = [&](int x, int y) {
            return picture.pixels[(static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)) * 4];
        };
        QVERIFY(at(side / 2, side / 2) > at(3, side - 3) + 40);
        QVERIFY(at(side / 2, side / 2) < 255);
        // Light comes from above.
        QVERIFY(at(side / 2, side * 3 / 8) > at(side / 2, side * 5 / 8));
    }

    void sameStateGivesTheSamePicture() {
        m_offscreen->renderer().setStrands(ballHair(m_groom, 800));
        const Picture first = draw({});
        const Picture second = draw({});
        QVERIFY(first.pixels == second.pixels);
    }

    void emptyGroomIsBackgroundOnly() {
        m_offscreen->renderer().setGroom(Groom{}, nullptr);
        m_offscreen->renderer().setStrands(std::make_shared<const Strands>());
        ViewSettings settings;
        settings.showGuides = true;
        const Picture nothing = draw(settings);
        settings.showMesh = false;
        settings.showHair = false;
        QVERIFY(draw(settings).pixels == nothing.pixels);
    }

    void hairAddsPixelsOnlyNearHair() {
        ViewSettings settings;
        settings.shadows = ShadowMode::None;
        const Picture bald = draw(settings);
        m_offscreen->renderer().setStrands(ballHair(m_groom, 400));
        const Picture hairy = draw(settings);
        QVERIFY(pixelsThatDiffer(bald, hairy, 8) > 500);
        // Hair reaches to 0.165 m at most: the corners of the picture stay as they were.
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const float dx = (static_cast<float>(x) + 0.5f) / side - 0.5f;
                const float dy = (static_cast<float>(y) + 0.5f) / side - 0.5f;
                if (dx * dx + dy * dy < 0.51f * 0.51f) continue;
                const std::size_t i = (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)) * 4;
                for (std::size_t k = 0; k < 3; ++k) QCOMPARE(hairy.pixels[i + k], bald.pixels[i + k]);
            }
        }
        settings.showHair = false;
        QVERIFY(draw(settings).pixels == bald.pixels);
    }

    void meshHidesHairBehindIt() {
        auto behind = std::make_shared<Strands>(*ballHair(m_groom, 1));
        for (glm::vec3& p : behind->positions) p = glm::vec3(p.x * 0.1f, p.y * 0.1f, -0.15f);
        m_offscreen->renderer().setStrands(behind);
        ViewSettings settings;
        settings.shadows = ShadowMode::None;
        const Picture with = draw(settings);
        settings.showHair = false;
        QVERIFY(with.pixels == draw(settings).pixels);
    }

    void shadowsDarken() {
        m_offscreen->renderer().setStrands(ballHair(m_groom, 3000));
        ViewSettings settings;
        settings.shadows = ShadowMode::None;
        const double lit = meanLight(draw(settings));
        settings.shadows = ShadowMode::Voxel;
        const double shadowed = meanLight(draw(settings));
        QVERIFY2(shadowed < lit - 2.0, qPrintable(QString("%1 against %2").arg(shadowed).arg(lit)));
        // Light that passes every layer makes no shadow of hair.
        settings.shadowAlpha = 0.5f;
        QVERIFY(meanLight(draw(settings)) < shadowed);
    }

    void uploadsOnlyWhatChanged() {
        Renderer& renderer = m_offscreen->renderer();
        Map map(256, 192, 1, TexelFormat::U8, 0.5f);
        m_groom.maps.set("density", map);
        ViewSettings settings;
        settings.overlayMap = "density";
        settings.showGuides = true;
        const auto hair = ballHair(m_groom, 100);
        renderer.setGroom(m_groom, m_surface);
        renderer.setStrands(hair);
        const Picture before = draw(settings);
        const Uploads first = renderer.uploads();
        QCOMPARE(first.meshes, std::uint64_t{1});
        QCOMPARE(first.mapTiles, std::uint64_t{12});
        QCOMPARE(first.guideBlocks, std::uint64_t{m_groom.guides.blockCount()});

        renderer.setGroom(m_groom, m_surface);
        renderer.setStrands(hair);
        draw(settings);
        QVERIFY(renderer.uploads() == first);

        Groom painted = m_groom;
        painted.maps.edit("density")->setTexel(128, 96, 0, 1.0f);
        renderer.setGroom(painted, m_surface);
        QCOMPARE(renderer.uploads().mapTiles, first.mapTiles + 1);
        QCOMPARE(renderer.uploads().guideBlocks, first.guideBlocks);

        Groom combed = painted;
        std::size_t front = 0;
        while (combed.guides.points(front)[0].z < 0.08f) ++front;
        combed.guides.editPoints(front)[5].y += 0.01f;
        renderer.setGroom(combed, m_surface);
        QCOMPARE(renderer.uploads().guideBlocks, first.guideBlocks + 1);
        QCOMPARE(renderer.uploads().mapTiles, first.mapTiles + 1);
        QCOMPARE(renderer.uploads().meshes, first.meshes);

        // Incremental uploads end in the same picture as everything anew.
        const Picture incremental = draw(settings);
        QVERIFY(incremental.pixels != before.pixels);
        Result<OffscreenRenderer> other = OffscreenRenderer::create();
        QVERIFY(other.ok());
        other->renderer().setGroom(combed, m_surface);
        other->renderer().setStrands(hair);
        QVERIFY(other->draw(m_camera, settings, {}, side, side).pixels == incremental.pixels);
    }

    void overlayShowsTheMap() {
        m_groom.maps.set("density", Map(64, 64, 1, TexelFormat::F32, 1.0f));
        m_groom.maps.set("none", Map(64, 64, 1, TexelFormat::F32, 0.0f));
        m_offscreen->renderer().setGroom(m_groom, m_surface);
        ViewSettings settings;
        const Picture plain = draw(settings);
        settings.overlayMap = "density";
        const Picture full = draw(settings);
        settings.overlayMap = "none";
        const Picture none = draw(settings);
        QVERIFY(pixelsThatDiffer(plain, full, 20) > 2000);
        QVERIFY(pixelsThatDiffer(none, full, 20) > 2000);
        settings.overlayOpacity = 0.0f;
        QVERIFY(draw(settings).pixels == plain.pixels);
        settings.overlayMap = "a map that is not there";
        settings.overlayOpacity = 1.0f;
        QVERIFY(draw(settings).pixels == plain.pixels);
    }

    // A star stands in the picture where its triangle is, red for a whorl and blue for a saddle, and hardly shines
    // through the model.
    void starsStandWhereDirectionsTurn() {
        ViewSettings settings;
        settings.showStrokes = true;
        m_camera.zoom(2.0f);
        const StrokeView view = m_camera.strokeView(glm::vec2(side), m_surface->bounds);
        const auto triangleAt = [&](const glm::vec3& position) {
            return m_surface->query.nearest(position)->point.triangle;
        };
        const Picture none = draw(settings);
        for (const int index : {1, -1, 2}) {
            const std::uint32_t triangle = triangleAt({0.02f, 0.03f, 0.09f});
            m_offscreen->renderer().setSingularities({{triangle, index}});
            const Picture star = draw(settings);
            const auto at = view.pixelFromGroom(positionAt(m_surface->mesh(), {triangle, 1.0f / 3.0f, 1.0f / 3.0f}));
            QVERIFY(at);
            int count = 0;
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    const auto i = (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)) * 4;
                    const auto more = [&](std::size_t c) { return int{star.pixels[i + c]} - int{none.pixels[i + c]}; };
                    if (std::max({std::abs(more(0)), std::abs(more(1)), std::abs(more(2))}) <= 24) continue;
                    ++count;
                    QVERIFY((more(0) > more(2)) == (index > 0));
                    const glm::vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                    QVERIFY2(glm::distance(pixel, *at) < 6.0f, qPrintable(QString("%1, %2").arg(x).arg(y)));
                }
            }
            QVERIFY2(count > 4, qPrintable(QString::number(count)));
            settings.showStrokes = false;
            QVERIFY(draw(settings).pixels == none.pixels);
            settings.showStrokes = true;
        }
        m_offscreen->renderer().setSingularities({{triangleAt({0.02f, 0.03f, -0.09f}), 1}});
        QCOMPARE(pixelsThatDiffer(draw(settings), none, 24), 0);
        m_offscreen->renderer().setSingularities({});
        QVERIFY(draw(settings).pixels == none.pixels);
    }

    void brushAndTextAreDrawnOver() {
        const Picture plain = draw({});
        OverlayState overlay;
        overlay.showBrush = true;
        overlay.brushPixel = glm::vec2(80, 60);
        overlay.brushRadius = 30;
        const Picture brush = draw({}, overlay);
        QVERIFY(pixelsThatDiffer(plain, brush, 10) > 60);
        int brightest = 0;
        for (std::size_t x = 107; x < 114; ++x) brightest = std::max<int>(brightest, brush.pixels[(60 * side + x) * 4]);
        QVERIFY2(brightest > 170, qPrintable(QString::number(brightest)));
        overlay.showBrush = false;
        overlay.text = "10,000 hairs";
        QVERIFY(pixelsThatDiffer(plain, draw({}, overlay), 10) > 60);
    }

    // Triangles of the graphics card against ribbons of the processor: their edges are sampled differently, so single
    // pixels may differ, the picture may not.
    void cardAndProcessorDrawTheSameHair() {
        m_offscreen->renderer().setStrands(ballHair(m_groom, 3000));
        ViewSettings settings;
        settings.showGuides = true;
        OverlayState overlay;
        overlay.showBrush = true;
        overlay.brushPixel = glm::vec2(side) * 0.5f;
        overlay.brushRadius = side * 0.2f;
        for (const int samples : {1, 4}) {
            settings.samples = samples;
            m_offscreen->renderer().setHairByProcessor(false);
            const Picture card = draw(settings, overlay);
            m_offscreen->renderer().setHairByProcessor(true);
            const Picture processor = draw(settings, overlay);
            QVERIFY(std::abs(meanLight(card) - meanLight(processor)) < 1.0);
            const int different = pixelsThatDiffer(card, processor, 40);
            QVERIFY2(different < side * side / 50, qPrintable(QString::number(different)));
            // Without hair many more differ.
            ViewSettings bald = settings;
            bald.showHair = bald.showGuides = false;
            QVERIFY(pixelsThatDiffer(draw(bald), processor, 40) > 5 * different + 500);
        }
    }

    void interactiveStaysClose() {
        m_offscreen->renderer().setStrands(ballHair(m_groom, 6000));
        const Picture still = draw({});
        ViewSettings settings;
        settings.interactive = true;
        const Picture moving = draw(settings);
        QVERIFY(std::abs(meanLight(still) - meanLight(moving)) < 6.0);
    }

    void hiddenPartsAreNotDrawn() {
        m_groom.partSettings.edit()[0].visible = false;
        m_offscreen->renderer().setGroom(m_groom, m_surface);
        const Picture hidden = draw({});
        ViewSettings settings;
        settings.showMesh = false;
        QVERIFY(pixelsThatDiffer(hidden, draw(settings), 2) == 0);
    }

    void picksTheGuideUnderThePointer() {
        const Bounds bounds = m_surface->bounds;
        int found = 0;
        for (std::size_t i = 0; i < m_groom.guides.count(); ++i) {
            const auto points = m_groom.guides.points(i);
            const StrokeView view = m_camera.strokeView(glm::vec2(side), bounds);
            const auto pixel = view.pixelFromGroom(points.back());
            QVERIFY(pixel.has_value());
            const auto picked = m_offscreen->renderer().pickGuide(m_camera, *pixel, 1.0f, glm::ivec2(side));
            if (points[0].z > 0.05f) {
                QVERIFY(picked.has_value());
                ++found;
            }
            if (picked && *picked != i) {
                // Another one may be as near; it must not be a hidden one.
                QVERIFY(m_groom.guides.points(*picked).back().z > -0.15f);
            }
        }
        QVERIFY(found > 20);
        QVERIFY(!m_offscreen->renderer().pickGuide(m_camera, glm::vec2(1, 1), 1.0f, glm::ivec2(side)));
        // A guide behind the ball is hidden even right under the pointer.
        Groom back = m_groom;
        back.guides.clear();
        const glm::vec3 hidden[] = {glm::vec3(0, 0, -0.1f), glm::vec3(0, 0.01f, -0.15f)};
        back.guides.append(SurfacePoint{}, 0, hidden);
        m_offscreen->renderer().setGroom(back, m_surface);
        QVERIFY(!m_offscreen->renderer().pickGuide(m_camera, glm::vec2(side * 0.5f), 20.0f, glm::ivec2(side)));
    }

    void shaderFaultsNameFileAndLine() {
        const Result<void> fault = gl::tryCompile("broken.glsl", "void main() {\n  float x = 1.0;\n  oops;\n}\n");
        QVERIFY(!fault);
        QVERIFY2(fault.error().message.find("broken.glsl, line 3") != std::string::npos, fault.error().message.c_str());
        const Result<void> included =
            gl::tryCompile("outer.glsl", "#include \"scene.glsl\"\nvoid main() {\n  oops;\n}\n");
        QVERIFY(!included);
        QVERIFY2(included.error().message.find("outer.glsl, line 3") != std::string::npos,
                 included.error().message.c_str());
    }

    void manyRenderersInTurn() {
        for (int i = 0; i < 100; ++i) {
            Result<OffscreenRenderer> offscreen = OffscreenRenderer::create();
            QVERIFY2(offscreen.ok(), offscreen.ok() ? "" : offscreen.error().message.c_str());
            if (i % 20 != 0) continue;
            offscreen->renderer().setGroom(m_groom, m_surface);
            QVERIFY(meanLight(offscreen->draw(m_camera, {}, {}, 16, 16)) > 1.0);
        }
        // The first one still works.
        QVERIFY(meanLight(draw({})) > 1.0);
    }

    void oddSizes() {
        m_offscreen->renderer().setStrands(ballHair(m_groom, 50));
        for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 200), glm::ivec2(0, -5), glm::ivec2(333, 77)}) {
            const Picture picture = m_offscreen->draw(m_camera, {}, {}, size.x, size.y);
            QCOMPARE(picture.pixels.size(),
                     static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4);
        }
    }
};

}  // namespace whorl

QTEST_APPLESS_MAIN(whorl::RendererTest)
#include "renderer_test.moc"
