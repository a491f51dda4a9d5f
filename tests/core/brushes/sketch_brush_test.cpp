// SPDX-License-Identifier: Apache-2.0
// Drawing, erasing, moving and aligning strokes of the direction field.
#include "core/brushes/brush.h"
#include "core/brushes/orbit_view.h"
#include "core/commands/strokes.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <array>

using namespace whorl;
using namespace whorl::testing;

namespace {

using Path = std::vector<StrokePoint>;

// A ball of guides seen from the front; x goes right, 800 x 600 pixels.
struct Scene {
    Groom groom = groomOn(sphere(24, 48), 40);
    std::shared_ptr<const Surface> surface = std::make_shared<Surface>(groom.mesh);
    StrokeView view = orbitView(boundsOf(*groom.mesh), 0.0f, 0.0f, {800.0f, 600.0f});
    BrushSettings settings{.radiusPixels = 40.0f};

    Groom stroked(const char* brush, const Path& path) const {
        auto stroke = Stroke::begin(*findBrush(brush), groom, surface, view, settings);
        if (!stroke) qFatal("%s", stroke.error().message.c_str());
        for (const StrokePoint& point : path) stroke->moveTo(point);
        return stroke->finish();
    }
    glm::vec2 pixelOf(const SurfacePoint& point) const {
        return view.pixelFromGroom(positionAt(surface->mesh(), point)).value_or(glm::vec2(-1.0f));
    }
};

const Path down{{{400.0f, 220.0f}, 1.0f}, {{400.0f, 300.0f}, 1.0f}, {{400.0f, 380.0f}, 1.0f}};

}  // namespace

class SketchBrushTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void drawsOneStrokeFromFirstToLast() {
        const Scene scene;
        const Groom after = scene.stroked("sketch", down);
        QCOMPARE(after.strokes->size(), std::size_t{1});
        const FieldStroke& stroke = after.strokes->front();
        QCOMPARE(stroke.kind, StrokeKind::Along);
        QCOMPARE(stroke.radius, 0.0f);
        QVERIFY(checkGroom(after).empty());
        QVERIFY(glm::distance(scene.pixelOf(stroke.points.front()), glm::vec2(400, 220)) < 1.0f);
        QVERIFY(glm::distance(scene.pixelOf(stroke.points.back()), glm::vec2(400, 380)) < 6.0f);
        QVERIFY(after.guides.sameAs(scene.groom.guides) && after.partings.sameAs(scene.groom.partings));
    }

    void aClickIsEnoughForPlaces_data() {
        QTest::addColumn<QString>("brush");
        QTest::addColumn<int>("kind");
        QTest::addColumn<bool>("turns");
        QTest::newRow("attract") << "attract" << int(StrokeKind::Attract) << false;
        QTest::newRow("repel") << "repel" << int(StrokeKind::Repel) << false;
        QTest::newRow("whorl") << "whorl" << int(StrokeKind::Whorl) << true;
    }
    void aClickIsEnoughForPlaces() {
        QFETCH(QString, brush);
        QFETCH(int, kind);
        QFETCH(bool, turns);
        const Scene scene;
        const Groom clicked = scene.stroked(qPrintable(brush), {down.front()});
        QCOMPARE(clicked.strokes->size(), std::size_t{1});
        QCOMPARE(int(clicked.strokes->front().kind), kind);
        QCOMPARE(clicked.strokes->front().points.size(), std::size_t{1});
        const glm::vec3 place = positionAt(*clicked.mesh, clicked.strokes->front().points.front());
        const float radius = 40.0f * scene.view.metresPerPixel(place);
        QVERIFY(std::abs(clicked.strokes->front().radius - radius) < 0.02f * radius);
        const Groom drawn = scene.stroked(qPrintable(brush), down);
        QCOMPARE(drawn.strokes->size(), std::size_t{1});
        QCOMPARE(drawn.strokes->front().points.size() == 1, turns);
        QVERIFY(glm::distance(scene.pixelOf(drawn.strokes->front().points.back()), glm::vec2(400, 380)) < 6.0f);
        QVERIFY(scene.stroked("sketch", {down.front()}).sameAs(scene.groom));
    }

    void erasesWhatItMeets() {
        Scene scene;
        scene.groom = scene.stroked("sketch", down);
        scene.groom = scene.stroked("whorl", {{{300.0f, 300.0f}, 1.0f}});
        scene.settings.invert = true;
        scene.settings.radiusPixels = 30.0f;
        QCOMPARE(scene.stroked("sketch", {{{410.0f, 300.0f}, 1.0f}}).strokes->size(), std::size_t{1});
        QVERIFY(scene.stroked("attract", {{{350.0f, 300.0f}, 1.0f}}).sameAs(scene.groom));
    }

    void carriesTheNearest() {
        Scene scene;
        scene.groom = scene.stroked("sketch", down);
        scene.groom = scene.stroked("sketch", {{{300.0f, 260.0f}, 1.0f}, {{300.0f, 340.0f}, 1.0f}});
        const Groom after = scene.stroked("move_stroke", {{{304.0f, 300.0f}, 1.0f}, {{344.0f, 310.0f}, 1.0f}});
        QCOMPARE(after.strokes->size(), std::size_t{2});
        QVERIFY((*after.strokes)[0] == (*scene.groom.strokes)[0]);
        const FieldStroke &was = (*scene.groom.strokes)[1], &now = (*after.strokes)[1];
        QVERIFY(checkGroom(after).empty());
        const glm::vec2 shift = scene.pixelOf(now.points.front()) - scene.pixelOf(was.points.front());
        QVERIFY2(glm::distance(shift, glm::vec2(40, 10)) < 8.0f, qPrintable(QString::number(shift.x)));
        scene.settings.invert = true;
        const Groom copied = scene.stroked("move_stroke", {{{304.0f, 300.0f}, 1.0f}, {{344.0f, 310.0f}, 1.0f}});
        QCOMPARE(copied.strokes->size(), std::size_t{3});
        QVERIFY((*copied.strokes)[1] == was);
        QVERIFY(copied.strokes->back().id != was.id);
    }

    void alignsStrokesThatDisagree() {
        Scene scene;
        scene.groom = scene.stroked("sketch", {{{380.0f, 290.0f}, 1.0f}, {{420.0f, 310.0f}, 1.0f}});
        scene.groom = scene.stroked("sketch", {{{380.0f, 330.0f}, 1.0f}, {{420.0f, 300.0f}, 1.0f}});
        const auto angle = [&](const Groom& groom) {
            glm::vec3 way[2];
            for (std::size_t i = 0; i < 2; ++i) {
                const FieldStroke& stroke = (*groom.strokes)[i];
                way[i] = glm::normalize(positionAt(*groom.mesh, stroke.points.back()) -
                                        positionAt(*groom.mesh, stroke.points.front()));
            }
            return std::acos(glm::dot(way[0], way[1]));
        };
        const Groom after = scene.stroked("align_strokes", {{{395.0f, 305.0f}, 1.0f}, {{405.0f, 305.0f}, 1.0f}});
        QVERIFY(checkGroom(after).empty());
        QVERIFY2(angle(after) < 0.6f * angle(scene.groom), qPrintable(QString::number(angle(after))));
    }
};

QTEST_GUILESS_MAIN(SketchBrushTest)
#include "sketch_brush_test.moc"
