// SPDX-License-Identifier: Apache-2.0
// What decides which way a groom's hair lies: strokes, guides, or gravity.
#include "core/field/groom_field.h"

#include "core/base/random.h"
#include "core/field/grow_guides.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>

using namespace whorl;

namespace {

FieldStroke stroke(const Surface& surface, std::uint32_t id, const std::vector<glm::vec3>& points) {
    FieldStroke made;
    made.id = id;
    made.points = *tracedParting(surface, points);
    return made;
}

/// Mean direction over the vertices of a plane.
glm::vec3 meanOf(const Groom& groom, const std::shared_ptr<const Surface>& surface) {
    Progress progress;
    const auto field = groomField(groom, surface, progress);
    if (!field) return glm::vec3(0.0f);
    glm::vec3 sum(0.0f);
    for (const glm::vec3& direction : field->vertices()) sum += direction;
    return sum / static_cast<float>(field->vertices().size());
}

}  // namespace

class GroomFieldTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void strokesThenGuidesThenGravity() {
        Groom groom = testing::groomOn(testing::plane(8), 60, 8, 0.1f);
        groom.field.edit().gravity.value = {0, 0, 1};
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        // Guides that stand say nothing.
        QVERIFY(leadingStrokes(groom, *surface).empty());
        QVERIFY(glm::distance(meanOf(groom, surface), {0, 0, 1}) < 0.02f);
        Progress progress;
        const auto solver = groomFieldSolver(groom, surface, progress);
        const auto sideways =
            solver->solve(std::vector<FieldStroke>{stroke(*surface, 1, {{-0.2f, 0, 0}, {0.2f, 0, 0}})}, {}, progress);
        QVERIFY(growGuidesAlong(groom, *surface, *sideways, {.lift = 0.1f}, progress).ok());
        QCOMPARE(leadingStrokes(groom, *surface).size(), groom.guides.count());
        QVERIFY(glm::distance(meanOf(groom, surface), {1, 0, 0}) < 0.02f);
        groom.strokes.edit().push_back(stroke(*surface, 1, {{0, 0, 0.2f}, {0, 0, -0.2f}}));
        QCOMPARE(leadingStrokes(groom, *surface), *groom.strokes);
        QVERIFY(glm::distance(meanOf(groom, surface), {0, 0, -1}) < 0.02f);
        groom.field.edit().follow = true;
        QVERIFY(glm::distance(meanOf(groom, surface), {1, 0, 0}) < 0.02f);
        progress.cancel();
        QVERIFY(!groomField(groom, surface, progress).ok());
    }

    // Guides that lie over each other, each turned its own way by up to 60 degrees: hair lies as they do on the whole,
    // and so do the strokes that are made of them.
    void guidesThatDisagreeAreEvenedOut() {
        Groom groom = testing::groomOn(testing::plane(60), 1500, 8, 0.15f);
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const float turn = (randomFloat(9, i, 0) - 0.5f) * 2.1f;
            std::vector<glm::vec3> points(groom.guides.points(i).begin(), groom.guides.points(i).end());
            for (std::size_t k = 1; k < points.size(); ++k) {
                points[k] =
                    points[0] + glm::vec3(std::cos(turn), 0.01f, std::sin(turn)) * (0.02f * static_cast<float>(k));
            }
            groom.guides.setPoints(i, points);
        }
        Progress progress;
        // Root mean square, degrees; that of the guides is 35.
        const auto off = [&](const DirectionField& field) {
            double sum = 0.0;
            int counted = 0;
            for (std::size_t i = 0; i < field.vertices().size(); ++i) {
                const glm::vec3 place = groom.mesh->positions[i];
                if (std::max(std::abs(place.x), std::abs(place.z)) > 0.4f) continue;
                const glm::vec3 way = field.vertices()[i];
                const auto angle = static_cast<double>(std::atan2(way.z, way.x)) * 57.3;
                sum += angle * angle;
                ++counted;
            }
            return std::sqrt(sum / counted);
        };
        const double led = off(*groomField(groom, surface, progress));
        QVERIFY2(led < 12.0, qPrintable(QString::number(led)));
        const auto strokes = agreedStrokes(groom, surface, -1, progress);
        QVERIFY(strokes.ok());
        QVERIFY(strokes->size() > groom.guides.count() / 2);
        groom.strokes.edit() = *strokes;
        const double drawn = off(*groomField(groom, surface, progress));
        QVERIFY2(drawn < 12.0, qPrintable(QString::number(drawn)));
        // A stroke is as long as its guide, off the rim.
        for (const FieldStroke& stroke : *strokes) {
            const glm::vec3 from = positionAt(*groom.mesh, stroke.points.front());
            const glm::vec3 to = positionAt(*groom.mesh, stroke.points.back());
            if (std::max(std::abs(from.x), std::abs(from.z)) > 0.3f) continue;
            // Guides are 0.16 long; strokes bend.
            QVERIFY(glm::distance(from, to) > 0.14f);
            QVERIFY(glm::distance(from, to) < 0.1605f);
        }
        progress.cancel();
        QVERIFY(!agreedStrokes(groom, surface, -1, progress).ok());
    }

    void parametersOfTheGroomCount() {
        Groom groom = testing::groomOn(testing::plane(40), 47, 6, 0.1f);
        groom.field.edit().gravity.value = {0, 0, 2};
        groom.field.edit().reach = 0.05f;
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        groom.strokes.edit().push_back(stroke(*surface, 1, {{-0.4f, 0, -0.4f}, {-0.3f, 0, -0.4f}}));
        Progress progress;
        const DirectionField field = *groomField(groom, surface, progress);
        QVERIFY(field.at(surface->query.nearest({-0.35f, 0, -0.4f})->point).x > 0.999f);
        QVERIFY(field.at(surface->query.nearest({0.4f, 0, 0.4f})->point).z > 0.999f);

        FieldParams& params = groom.field.edit();
        params.bend = 0.5f;
        params.lift = 0.7f;
        params.length.value = 0.03f;
        params.length.map = "length";
        const GrowAlong how = growAlong(params);
        QCOMPARE(how.down, glm::vec3(0, 0, 1));
        QCOMPARE(how.bend, 0.5f);
        QCOMPARE(how.lift, 0.7f);
        // Half as long on one side.
        Map map(4, 1, 1, TexelFormat::F32, 1.0f);
        for (const int x : {0, 1}) map.setTexel(x, 0, 0, 0.5f);
        groom.maps.set("length", map);
        QVERIFY(growGuidesAlong(groom, *surface, field, how, progress).ok());
        int checked = 0;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const auto points = groom.guides.points(i);
            if (std::abs(std::abs(points[0].x) - 0.25f) > 0.12f) continue;  // between texels
            float length = 0.0f;
            for (std::size_t k = 1; k < points.size(); ++k) length += glm::distance(points[k - 1], points[k]);
            QVERIFY(std::abs(length - (points[0].x < 0.0f ? 0.015f : 0.03f)) < 1e-4f);
            ++checked;
        }
        QVERIFY(checked > 5);
    }
};

QTEST_GUILESS_MAIN(GroomFieldTest)
#include "groom_field_test.moc"
