// SPDX-License-Identifier: Apache-2.0
// Painting on the model: seams, borders, piling up, formats.
#include "core/brushes/brush.h"
#include "core/brushes/orbit_view.h"
#include "core/brushes/paint_canvas.h"
#include "core/commands/command.h"
#include "core/hair/generate.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;
using namespace whorl::testing;

namespace {

/// A square in the plane of x and y, cut into two UV charts that lie far apart: the left half's chart is turned by a
/// right angle. The seam runs along x = 0.
SurfaceMesh twoCharts() {
    SurfaceMesh mesh;
    mesh.positions = {{-0.1f, -0.1f, 0.0f}, {0.0f, -0.1f, 0.0f}, {0.1f, -0.1f, 0.0f},
                      {-0.1f, 0.1f, 0.0f},  {0.0f, 0.1f, 0.0f},  {0.1f, 0.1f, 0.0f}};
    mesh.normals.assign(6, {0.0f, 0.0f, 1.0f});
    mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
    const auto left = [](float x, float y) { return glm::vec2(0.05f + 2.0f * (y + 0.1f), 0.05f + 2.0f * (x + 0.1f)); };
    const auto right = [](float x, float y) { return glm::vec2(0.7f + 2.0f * x, 0.5f + 2.0f * (y + 0.1f)); };
    for (std::size_t t = 0; t < 4; ++t) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions[mesh.triangles[t][k]];
            mesh.cornerUvs.push_back(t < 2 ? left(p.x, p.y) : right(p.x, p.y));
        }
    }
    mesh.parts.push_back({.name = "square", .firstTriangle = 0, .triangleCount = 4});
    return mesh;
}

Groom paintable(SurfaceMesh mesh, Map map) {
    Groom groom = makeGroom(std::move(mesh));
    groom.maps.set("paint", std::move(map));
    return groom;
}

Groom painted(const Groom& groom, BrushSettings settings, const std::vector<glm::vec2>& path) {
    settings.map = "paint";
    const auto surface = std::make_shared<const Surface>(groom.mesh);
    const StrokeView view = orbitView(surface->bounds, 0.0f, 0.0f, {800.0f, 600.0f});
    auto stroke = Stroke::begin(*findBrush("paint"), groom, surface, view, settings);
    if (!stroke) qFatal("%s", stroke.error().message.c_str());
    for (const glm::vec2& pixel : path) stroke->moveTo({pixel, 1.0f});
    return stroke->finish();
}

float valueAt(const Groom& groom, std::uint32_t triangle, float u, float v) {
    return groom.maps.find("paint")->sample(uvAt(*groom.mesh, {triangle, u, v}));
}

}  // namespace

class PaintTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theSeamDoesNotShow() {
        for (const bool flip : {false, true}) {
            Map map(256, 192, 1, TexelFormat::U16, 0.0f);
            map.flipV = flip;
            const Groom groom = paintable(twoCharts(), map);
            BrushSettings settings;
            settings.strength = 1.0f;
            settings.radiusPixels = 120.0f;
            const Groom after = painted(groom, settings, {{400.0f, 300.0f}});
            // Both sides of x = 0 at the same heights: edge 1-4 of triangle 0 and edge 4-1 of triangle 3.
            int seen = 0;
            for (int i = 1; i < 40; ++i) {
                const float t = static_cast<float>(i) / 40.0f;
                const float left = valueAt(after, 0, 1.0f - t, t), right = valueAt(after, 3, 0.0f, t);
                QVERIFY2(std::abs(left - right) < 0.03f, qPrintable(QString("%1 %2").arg(left).arg(right)));
                seen += left > 0.3f ? 1 : 0;
            }
            QVERIFY(seen > 5);
            QVERIFY(valueAt(after, 0, 0.5f, 0.5f) > 0.97f);  // the middle
        }
    }

    void texelsBeyondTheBorderTakePartIn() {
        const Groom groom = paintable(twoCharts(), Map(256, 256, 1, TexelFormat::F32, 0.0f));
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 2000.0f;
        const Groom after = painted(groom, settings, {{400.0f, 300.0f}});
        const Map& map = *after.maps.find("paint");
        // The right chart covers u 0.7 to 0.9, v 0.5 to 0.9: columns 179.2 to 230.4, rows 25.6 to 128.
        for (int beyond = 0; beyond < 4; ++beyond) {
            for (int along = 30; along < 120; ++along) {
                QVERIFY(map.texel(231 + beyond, along) > 0.9f);
                QVERIFY(map.texel(178 - beyond, along) > 0.9f);
            }
            for (int along = 182; along < 228; ++along) {
                QVERIFY(map.texel(along, 24 - beyond) > 0.9f);
                QVERIFY(map.texel(along, 128 + beyond) > 0.9f);
            }
        }
        QCOMPARE(map.texel(245, 70), 0.0f);
        QCOMPARE(map.texel(200, 150), 0.0f);
    }

    void everyCoveredTexelIsReached() {
        const Groom groom = paintable(sphere(24, 48, 0.1f), Map(300, 200, 1, TexelFormat::U8, 0.0f));
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 2000.0f;
        settings.frontOnly = false;
        const Groom after = painted(groom, settings, {{400.0f, 300.0f}});
        for (std::uint32_t t = 0; t < after.mesh->triangleCount(); ++t) QVERIFY(valueAt(after, t, 0.33f, 0.33f) > 0.5f);
    }

    void aStrokeDoesNotPileUp() {
        const Groom groom = paintable(twoCharts(), Map(128, 128, 1, TexelFormat::F32, 0.2f));
        BrushSettings settings;
        settings.strength = 0.5f;
        settings.value = 0.8f;
        settings.radiusPixels = 100.0f;
        std::vector<glm::vec2> scribble;
        for (int i = 0; i < 12; ++i) scribble.push_back({i % 2 == 0 ? 350.0f : 450.0f, 300.0f});
        const Groom after = painted(groom, settings, scribble);
        float largest = 0.0f;
        const Map& map = *after.maps.find("paint");
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 128; ++x) {
                QVERIFY(map.texel(x, y) >= 0.2f - 1e-6f);
                largest = std::max(largest, map.texel(x, y));
            }
        }
        QVERIFY(std::abs(largest - 0.5f) < 0.01f);  // half of the way from 0.2 to 0.8
        // A second stroke goes on from there.
        const Groom more = painted(after, settings, scribble);
        QVERIFY(valueAt(more, 0, 0.5f, 0.5f) > valueAt(after, 0, 0.5f, 0.5f) + 0.1f);
    }

    void aLaterStrokeFindsWhatTheFirstOneMade() {
        // Big triangles and a map that is no multiple of the tile size, so that every way to list a tile is taken.
        const SurfaceMesh mesh = testing::plane(2);
        const Surface used((Cow<SurfaceMesh>(SurfaceMesh(mesh))));
        const auto painted = [&](const Surface& surface, const Map& map, float x) {
            MapSet maps;
            maps.set("paint", map);
            PaintCanvas canvas(surface, map);
            for (int i = 0; i < 4; ++i) {
                PaintDab dab{.centre = {x + 0.05f * static_cast<float>(i), 0.0f, 0.1f}, .radius = 0.2f};
                dab.eye = {0.0f, 5.0f, 0.0f};
                canvas.paint(maps, "paint", dab, 1.0f);
            }
            std::vector<float> texels;
            for (int row = 0; row < map.height(); ++row)
                for (int column = 0; column < map.width(); ++column)
                    texels.push_back(maps.find("paint")->texel(column, row));
            return texels;
        };
        for (const int size : {100, 640, 100}) {
            const Map map(size, size + 30, 1, TexelFormat::U16, 0.0f);
            for (const float x : {-0.3f, 0.2f, -0.3f}) {
                const Surface fresh((Cow<SurfaceMesh>(SurfaceMesh(mesh))));
                const std::vector<float> expected = painted(fresh, map, x);
                QVERIFY(painted(used, map, x) == expected);
                QVERIFY(*std::max_element(expected.begin(), expected.end()) > 0.9f);
            }
            QVERIFY(PaintPlaces::of(used, map) == PaintPlaces::of(used, map));
            Map turned = map;
            turned.flipV = true;
            QVERIFY(PaintPlaces::of(used, map) != PaintPlaces::of(used, turned));
        }
    }

    void invertErases() {
        const Groom groom = paintable(twoCharts(), Map(128, 128, 1, TexelFormat::U8, 0.6f));
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 100.0f;
        settings.invert = true;
        const Groom after = painted(groom, settings, {{400.0f, 300.0f}});
        QVERIFY(valueAt(after, 0, 0.5f, 0.5f) < 0.02f);
        QCOMPARE(valueAt(after, 0, 0.02f, 0.02f), valueAt(groom, 0, 0.02f, 0.02f));
    }

    // Before there are guides strokes say where the hairs that were asked for grow; afterwards they add some.
    void theNumberOfHairsStandsForAllThatWasPaintedFirst() {
        Groom groom = paintable(sphere(24, 48, 0.1f), Map(256, 256, 1, TexelFormat::U8, 0.0f));
        groom.groups.edit()[0].params.general.density.map = "paint";
        groom.setHairs(2000);
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 40.0f;
        Progress progress;
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        const auto addGuides = [&](Groom& to) {
            for (std::uint32_t t = 0; t < to.mesh->triangleCount(); t += 40)
                addGuide(to, *surface, {t, 0.3f, 0.3f}, 0, 0.02f);
        };
        const auto hairs = [&](const Groom& of) {
            Groom haired = of;
            if (haired.guides.empty()) addGuides(haired);
            Generator generator;
            generator.setSurface(surface);
            const auto strands = generator.generate(haired, {}, progress);
            return strands ? strands->count() : 0;
        };
        for (const float y : {200.0f, 260.0f, 320.0f, 380.0f})
            groom = painted(groom, settings, {{340.0f, y}, {460.0f, y}});
        QCOMPARE(groom.counts->densityTotal, 0.0f);
        const std::size_t first = hairs(groom);
        QVERIFY2(first > 1800 && first < 2200, qPrintable(QString::number(first)));
        addGuides(groom);
        groom = painted(groom, settings, {{300.0f, 300.0f}, {500.0f, 300.0f}});
        QVERIFY(groom.counts->densityTotal > 0.0f);
        QVERIFY(hairs(groom) > first + 100);
    }

    void theBackStaysClean() {
        const Groom groom = paintable(sphere(24, 48, 0.1f), Map(256, 256, 1, TexelFormat::U8, 0.0f));
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 2000.0f;
        const Groom after = painted(groom, settings, {{400.0f, 300.0f}});
        for (std::uint32_t t = 0; t < after.mesh->triangleCount(); ++t) {
            const glm::vec3 normal = triangleNormal(*after.mesh, t);
            if (normal.z > 0.5f) QVERIFY(valueAt(after, t, 0.33f, 0.33f) > 0.5f);
            if (normal.z < -0.3f) QCOMPARE(valueAt(after, t, 0.33f, 0.33f), 0.0f);
        }
    }

    void oneStepCopiesFewTiles() {
        const Groom groom = paintable(sphere(24, 48, 0.1f), Map(2048, 2048, 1, TexelFormat::U8, 0.0f));
        BrushSettings settings;
        settings.radiusPixels = 20.0f;
        const Groom after = painted(groom, settings, {{400.0f, 300.0f}});
        const std::size_t bytes = after.maps.find("paint")->bytesNotSharedWith(*groom.maps.find("paint"));
        QVERIFY2(bytes > 0 && bytes < 60 * 4096, qPrintable(QString::number(bytes)));
    }

    void wildUvsAreSurvived() {
        SurfaceMesh mesh = twoCharts();
        mesh.cornerUvs[0] = {1e9f, -1e9f};
        mesh.cornerUvs[3] = {std::nanf(""), 0.0f};
        for (std::size_t i = 6; i < 12; ++i) mesh.cornerUvs[i] += glm::vec2(-7.0f, 3.0f);  // repeats of the map
        const Groom groom = paintable(std::move(mesh), Map(64, 100, 1, TexelFormat::U8, 0.0f));
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 150.0f;
        const Groom after = painted(groom, settings, {{420.0f, 300.0f}});
        QVERIFY(valueAt(after, 2, 0.1f, 0.4f) > 0.2f);
        for (int y = 0; y < 100; ++y) {
            for (int x = 0; x < 64; ++x) QVERIFY(std::isfinite(after.maps.find("paint")->texel(x, y)));
        }
    }

    void mapsThatCanNotBePaintedAreRefused() {
        Groom groom = paintable(twoCharts(), Map(8, 8, 3, TexelFormat::U8, 0.0f));
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        for (const char* name : {"", "missing", "paint"}) {
            BrushSettings settings;
            settings.map = name;
            const auto stroke = Stroke::begin(*findBrush("paint"), groom, surface, {}, settings);
            QVERIFY(!stroke.ok() && stroke.error().message.ends_with("."));
        }
    }
};

QTEST_APPLESS_MAIN(PaintTest)
#include "paint_test.moc"
