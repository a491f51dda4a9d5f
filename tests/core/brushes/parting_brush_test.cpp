// SPDX-License-Identifier: Apache-2.0
// Drawing and erasing partings, and brushes that stay on their side of them.
#include "core/brushes/brush.h"
#include "core/brushes/guide_shape.h"
#include "core/brushes/orbit_view.h"
#include "core/commands/partings.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>

using namespace whorl;
using namespace whorl::testing;

namespace {

using Path = std::vector<StrokePoint>;

// A ball of guides seen from the front; x goes right, 800 x 600 pixels.
struct Scene {
    Groom groom = groomOn(sphere(24, 48), 400);
    std::shared_ptr<const Surface> surface = std::make_shared<Surface>(groom.mesh);
    StrokeView view = orbitView(boundsOf(*groom.mesh), 0.0f, 0.0f, {800.0f, 600.0f});
    BrushSettings settings{};

    Groom stroked(const char* brush, const Path& path) const {
        auto stroke = Stroke::begin(*findBrush(brush), groom, surface, view, settings);
        if (!stroke) qFatal("%s", stroke.error().message.c_str());
        for (const StrokePoint& point : path) stroke->moveTo(point);
        return stroke->finish();
    }
};

const Path down{{{400.0f, 220.0f}, 1.0f}, {{400.0f, 300.0f}, 1.0f}, {{400.0f, 380.0f}, 1.0f}};

}  // namespace

class PartingBrushTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void drawsOneLineOnTheSkin() {
        const Scene scene;
        const Groom after = scene.stroked("parting", down);
        QCOMPARE(after.partings->size(), std::size_t{1});
        QVERIFY(checkGroom(after).empty());
        const auto positions = partingPositions(*after.mesh, after.partings->front());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            QVERIFY(std::abs(positions[i].x) < 2e-3f);
            if (i > 0) QVERIFY(positions[i].y < positions[i - 1].y);
            if (i > 0) QVERIFY(glm::distance(positions[i], positions[i - 1]) < 1.01f * partingStep(*scene.surface));
        }
        const auto from = scene.view.pixelFromGroom(positions.front()),
                   to = scene.view.pixelFromGroom(positions.back());
        QVERIFY(glm::distance(*from, glm::vec2(400, 220)) < 1.0f && glm::distance(*to, glm::vec2(400, 380)) < 6.0f);
        QVERIFY(after.guides.sameAs(scene.groom.guides));
    }

    void aClickDrawsNothing() {
        const Scene scene;
        QVERIFY(scene.stroked("parting", {down.front()}).sameAs(scene.groom));
    }

    void erasesWhatItMeets() {
        Scene scene;
        scene.groom = scene.stroked("parting", down);
        scene.groom = scene.stroked("parting", {{{300.0f, 220.0f}, 1.0f}, {{300.0f, 380.0f}, 1.0f}});
        QCOMPARE(scene.groom.partings->size(), std::size_t{2});
        scene.settings.invert = true;
        scene.settings.radiusPixels = 30.0f;
        const Groom after = scene.stroked("parting", {{{410.0f, 300.0f}, 1.0f}});
        QCOMPARE(after.partings->size(), std::size_t{1});
        QCOMPARE(after.partings->front().id, 2u);
        QVERIFY(scene.stroked("parting", {{{350.0f, 300.0f}, 1.0f}}).sameAs(scene.groom));
    }

    void brushesStayOnTheirSide_data() {
        QTest::addColumn<QString>("brush");
        for (const char* brush : {"comb", "scissors", "grow", "puff"}) QTest::newRow(brush) << brush;
    }
    void brushesStayOnTheirSide() {
        QFETCH(QString, brush);
        Scene scene;
        scene.groom = scene.stroked("parting", {{{400.0f, 120.0f}, 1.0f}, {{400.0f, 480.0f}, 1.0f}});
        // Bent, so that puffing has something to do.
        for (std::size_t i = 0; i < scene.groom.guides.count(); ++i)
            for (glm::vec3& p : scene.groom.guides.editPoints(i).subspan(3)) p.y -= 0.01f;
        scene.settings.radiusPixels = 60.0f;
        const Path across{{{380.0f, 290.0f}, 1.0f}, {{430.0f, 310.0f}, 1.0f}};
        const auto touched = [&](const Groom& after) {
            std::pair<int, int> count;
            for (std::size_t i = 0; i < after.guides.count(); ++i) {
                const auto a = after.guides.points(i), b = scene.groom.guides.points(i);
                if (std::equal(a.begin(), a.end(), b.begin(), b.end())) continue;
                ++(a[0].x < 0.0f ? count.first : count.second);
            }
            return count;
        };
        const auto kept = touched(scene.stroked(qPrintable(brush), across));
        QVERIFY(kept.first > 2);
        QCOMPARE(kept.second, 0);
        scene.settings.respectPartings = false;
        const auto all = touched(scene.stroked(qPrintable(brush), across));
        QVERIFY(all.first >= kept.first && all.second > 2);
    }

    void newGuidesAreShapedLikeTheirSide() {
        Scene scene;
        for (std::size_t i = 0; i < scene.groom.guides.count(); ++i) {
            const float side = scene.groom.guides.points(i)[0].x < 0.0f ? -1.0f : 1.0f;
            for (glm::vec3& p : scene.groom.guides.editPoints(i).subspan(1)) p.x += side * 0.05f;
        }
        const auto place = scene.surface->query.nearest({0.002f, 0.0f, 0.1f});
        const auto leans = [&] {
            const auto points = guideShapeAt(scene.groom, *scene.surface, place->point, 0, 0.0f);
            return points.back().x - points.front().x;
        };
        const float mixed = leans();
        scene.groom = scene.stroked("parting", {{{400.0f, 120.0f}, 1.0f}, {{400.0f, 480.0f}, 1.0f}});
        QVERIFY(leans() > mixed + 0.005f && leans() > 0.035f);
    }
};

QTEST_APPLESS_MAIN(PartingBrushTest)
#include "parting_brush_test.moc"
