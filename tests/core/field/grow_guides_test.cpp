// SPDX-License-Identifier: Apache-2.0
// A few strokes comb a coat: guides grown along the field of the sample bust.
#include "core/field/grow_guides.h"

#include "core/field/groom_field.h"
#include "core/field/growing_area.h"
#include "core/io/open.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <set>

using namespace whorl;

namespace {

constexpr float degree = 0.01745329f;

float degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

struct Bust {
    Groom groom;
    std::shared_ptr<const Surface> surface;

    /// False when the sample is not there.
    bool open() {
        Progress progress;
        auto opened = openGroom(WHORL_SAMPLES "/bust.whorl", progress);
        if (!opened) return false;
        groom = std::move(opened->groom);
        surface = std::make_shared<const Surface>(groom.mesh);
        return true;
    }
    /// On the skull, in degrees: 0 is the face, 90 the left ear; up from the ears to the crown.
    glm::vec3 at(float around, float up) const {
        const glm::vec3 middle(0.0f, surface->bounds.max.y - 0.11f, -0.005f);
        const glm::vec3 out(std::cos(up * degree) * std::sin(around * degree), std::sin(up * degree),
                            std::cos(up * degree) * std::cos(around * degree));
        const auto hit = surface->query.raycast(middle + out * 0.5f, -out);
        return hit ? hit->position : middle;
    }
    std::vector<SurfacePoint> line(const std::vector<glm::vec2>& places) const {
        std::vector<glm::vec3> points;
        for (std::size_t i = 1; i < places.size(); ++i) {
            for (int k = 0; k <= 16; ++k) {
                const glm::vec2 place = glm::mix(places[i - 1], places[i], static_cast<float>(k) / 16.0f);
                points.push_back(at(place.x, place.y));
            }
        }
        return *tracedParting(*surface, points);
    }
    void stroke(const std::vector<glm::vec2>& places) {
        FieldStroke made;
        made.id = static_cast<std::uint32_t>(groom.strokes->size()) + 1;
        made.points = line(places);
        groom.strokes.edit().push_back(std::move(made));
    }
    /// Away from a parting in the middle.
    void sketch() {
        groom.partings.edit().push_back({1, {}, line({{0, 40}, {0, 89.5f}})});
        groom.partings.edit().push_back({2, {}, line({{180, 89.5f}, {180, 60}})});
        for (const float side : {-1.0f, 1.0f}) {
            stroke({{side * 15, 58}, {side * 60, 30}});
            stroke({{side * 40, 70}, {side * 80, 20}});
            stroke({{side * 90, 75}, {side * 100, 15}});
            stroke({{side * 150, 60}, {side * 150, 10}});
        }
    }
    bool grow() {
        Progress progress;
        const auto field = groomField(groom, surface, progress);
        GrowAlong how = growAlong(*groom.field);
        how.group = groom.groupIndex("scalp");
        return field.ok() && growGuidesAlong(groom, *surface, *field, how, progress).ok();
    }
    /// Segments have the same length, no hair is in the skin, and none is bent much more tightly than asked.
    QString broken() const {
        std::set<std::size_t> kinked;
        const std::vector<std::uint8_t> growing = growingTriangles(groom);
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            if (groom.guides.group(i) != groom.groupIndex("scalp")) continue;
            const auto points = groom.guides.points(i);
            const float step = groom.field->length.value / static_cast<float>(points.size() - 1);
            for (std::size_t k = 1; k < points.size(); ++k) {
                const glm::vec3 way = points[k] - points[k - 1];
                if (!(std::abs(glm::length(way) - step) < 1e-5f)) return QString("guide %1: a segment's length").arg(i);
                if (surface->skin().distance(points[k]) < -1e-4f) return QString("guide %1: in the skin").arg(i);
                // A fifteenth of the length around a circle of a quarter of it: 15 degrees; the skin and the lift add.
                // Behind the ears, where nothing grows, hair slides off them; right before them it may be pushed aside.
                bool grows = k > 1;
                for (std::size_t j = k - std::min<std::size_t>(k, 3); j <= k; ++j)
                    grows = grows && growing[surface->query.nearest(points[j])->point.triangle];
                if (!grows) continue;
                const float turn = degreesBetween(way, points[k - 1] - points[k - 2]);
                if (turn > 50.0f) kinked.insert(i);
                if (turn > 90.0f) return QString("guide %1: a kink at %2").arg(i).arg(k);
            }
        }
        if (kinked.size() > groom.guides.count() / 100) return QString("%1 guides with kinks").arg(kinked.size());
        return {};
    }
};

/// Angles between guides and the strokes under them, both along the skin; one a segment that lies over a stroke.
std::vector<float> offStrokes(const Bust& bust) {
    struct Piece {
        glm::vec3 middle, way;
    };
    std::vector<Piece> pieces;
    const SurfaceMesh& mesh = bust.surface->mesh();
    for (const FieldStroke& stroke : *bust.groom.strokes) {
        for (std::size_t i = 2; i < stroke.points.size(); ++i) {
            const glm::vec3 a = positionAt(mesh, stroke.points[i - 2]), b = positionAt(mesh, stroke.points[i]);
            pieces.push_back({positionAt(mesh, stroke.points[i - 1]), b - a});
        }
    }
    std::vector<float> angles;
    for (std::size_t i = 0; i < bust.groom.guides.count(); ++i) {
        if (bust.groom.guides.group(i) != bust.groom.groupIndex("scalp")) continue;
        const auto points = bust.groom.guides.points(i);
        for (std::size_t k = 1; k < points.size(); ++k) {
            const auto under = bust.surface->query.nearest((points[k - 1] + points[k]) * 0.5f);
            const auto near = std::ranges::min_element(
                pieces, {}, [&](const Piece& piece) { return glm::distance(piece.middle, under->position); });
            if (glm::distance(near->middle, under->position) > 0.005f) continue;
            const glm::vec3 normal = normalAt(mesh, under->point);
            const auto flat = [&](const glm::vec3& v) { return v - normal * glm::dot(normal, v); };
            angles.push_back(degreesBetween(flat(points[k] - points[k - 1]), flat(near->way)));
        }
    }
    return angles;
}

}  // namespace

class GrowGuidesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void guidesFollowTheStrokes_data() {
        QTest::addColumn<float>("lift");
        QTest::addColumn<float>("length");
        QTest::addColumn<float>("bend");
        QTest::newRow("as it comes") << 0.25f << 0.06f << 0.0f;
        QTest::newRow("short and flat") << 0.0f << 0.02f << 0.0f;
        QTest::newRow("longer, lifted, with some gravity") << 0.5f << 0.08f << 0.2f;
    }
    void guidesFollowTheStrokes() {
        QFETCH(float, lift);
        QFETCH(float, length);
        QFETCH(float, bend);
        Bust bust;
        QVERIFY(bust.open());
        bust.sketch();
        QCOMPARE(bust.groom.strokes->size(), std::size_t{8});
        FieldParams& params = bust.groom.field.edit();
        params.lift = lift;
        params.length.value = length;
        params.bend = bend;
        QVERIFY(bust.grow());
        const std::vector<float> angles = offStrokes(bust);
        double sum = 0.0;
        for (const float angle : angles) sum += static_cast<double>(angle);
        const double mean = sum / static_cast<double>(angles.size());
        qInfo("%.2f degrees on average over %zu segments", mean, angles.size());
        QVERIFY(angles.size() > 300);
        QVERIFY2(mean < 10.0, qPrintable(QString::number(mean)));
        const QString broken = bust.broken();
        QVERIFY2(broken.isEmpty(), qPrintable(broken));
    }

    void noGuideCrossesTheParting() {
        Bust bust;
        QVERIFY(bust.open());
        bust.sketch();
        // Combed towards the parting from both sides.
        for (FieldStroke& stroke : bust.groom.strokes.edit()) std::ranges::reverse(stroke.points);
        QVERIFY(bust.grow());
        int near = 0;
        for (std::size_t i = 0; i < bust.groom.guides.count(); ++i) {
            if (bust.groom.guides.group(i) != bust.groom.groupIndex("scalp")) continue;
            const auto points = bust.groom.guides.points(i);
            // The parting lies in the plane x = 0, from the forehead to the back of the crown.
            if (std::abs(points[0].x) > 0.05f || points[0].y < bust.at(180, 70).y || std::abs(points[0].x) < 1e-3f)
                continue;
            ++near;
            for (const glm::vec3& p : points) {
                if (p.y < bust.at(180, 70).y || p.z > bust.at(0, 50).z) break;
                QVERIFY2(p.x * points[0].x > -1e-4f, qPrintable(QString("guide %1").arg(i)));
            }
        }
        QVERIFY2(near > 20, qPrintable(QString::number(near)));
    }

    void aroundSingularPlacesNothingExplodes_data() {
        QTest::addColumn<int>("kind");
        QTest::newRow("attract") << 1;
        QTest::newRow("repel") << 2;
        QTest::newRow("whorl") << 3;
    }
    void aroundSingularPlacesNothingExplodes() {
        QFETCH(int, kind);
        Bust bust;
        QVERIFY(bust.open());
        FieldStroke stroke;
        stroke.id = 1;
        stroke.kind = static_cast<StrokeKind>(kind);
        stroke.radius = 0.05f;
        stroke.points = {bust.surface->query.nearest(bust.at(180, 65))->point};
        bust.groom.strokes.edit().push_back(stroke);
        const glm::vec3 centre = positionAt(bust.surface->mesh(), stroke.points.front());
        QVERIFY(bust.grow());
        const QString broken = bust.broken();
        QVERIFY2(broken.isEmpty(), qPrintable(broken));
        // Hair of the middle of a whorl and of a star leaves it; no guide curls up in place.
        for (std::size_t i = 0; i < bust.groom.guides.count(); ++i) {
            const auto points = bust.groom.guides.points(i);
            if (glm::distance(points[0], centre) > 0.01f || kind == 1) continue;
            QVERIFY(glm::distance(points.back(), points[0]) > 0.4f * bust.groom.field->length.value);
        }
    }
};

QTEST_GUILESS_MAIN(GrowGuidesTest)
#include "grow_guides_test.moc"
