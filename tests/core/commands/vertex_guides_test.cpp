// SPDX-License-Identifier: Apache-2.0
#include "core/commands/vertex_guides.h"

#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <cmath>
#include <set>

using namespace whorl;

class VertexGuidesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void oneOnEachVertex() {
        Groom groom = testing::groomOn(testing::sphere(12, 24), 7);
        const Surface surface(groom.mesh);
        Progress progress;
        QVERIFY(placeGuidesOnVertices(groom, surface, {.length = 0.02f}, progress).ok());
        QVERIFY(checkGroom(groom).empty());
        std::set<std::uint32_t> used;
        for (const glm::uvec3& t : groom.mesh->triangles)
            for (int c = 0; c < 3; ++c) used.insert(t[c]);
        QCOMPARE(groom.guides.count(), used.size());
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const auto points = groom.guides.points(i);
            QCOMPARE(points[0], positionAt(*groom.mesh, groom.guides.root(i)));
            float length = 0.0f, before = 0.0f;
            for (std::size_t k = 1; k < points.size(); ++k) {
                const float piece = glm::distance(points[k - 1], points[k]);
                QVERIFY(piece > before);
                before = piece;
                length += piece;
            }
            QVERIFY(std::abs(length - 0.02f) < 1e-5f);
            QVERIFY(glm::dot(glm::normalize(points.back() - points[0]), normalAt(*groom.mesh, groom.guides.root(i))) >
                    0.99f);
        }
    }

    void largeTrianglesAreSplit() {
        Groom groom = testing::groomOn(testing::plane(2), 0);
        const Surface surface(groom.mesh);
        Progress progress;
        // Eight triangles of an eighth of a square metre; a piece is split while it is above 1 / 400.
        QVERIFY(placeGuidesOnVertices(groom, surface, {.length = 0.02f, .perSquareMetre = 400.0f}, progress).ok());
        QVERIFY2(groom.guides.count() > 209 && groom.guides.count() < 700,
                 qPrintable(QString::number(groom.guides.count())));
        QVERIFY(checkGroom(groom).empty());
        // Evenly enough: every ninth of the plane has some of them, and each is split for itself.
        int cells[3][3] = {};
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const glm::vec3 p = groom.guides.points(i)[0];
            ++cells[std::min(2, static_cast<int>((p.x + 0.5f) * 3))][std::min(2, static_cast<int>((p.z + 0.5f) * 3))];
        }
        for (const auto& row : cells)
            for (const int count : row) QVERIFY(count > static_cast<int>(groom.guides.count()) / 27);
        const std::size_t all = groom.guides.count();
        groom.groups.edit()[0].params.general.density.value = 0.25f;
        QVERIFY(placeGuidesOnVertices(groom, surface, {.length = 0.02f, .perSquareMetre = 400.0f}, progress).ok());
        QVERIFY(groom.guides.count() < all / 2);
    }

    void mapsSetLengthAndBlackGrowsNothing() {
        Groom groom = testing::groomOn(testing::plane(8), 0);
        Map half(64, 64, 1, TexelFormat::U8, 1.0f);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 32; ++x) half.setTexel(x, y, 0, 0.0f);
        groom.maps.set("length", half);
        const Surface surface(groom.mesh);
        Progress progress;
        QVERIFY(placeGuidesOnVertices(groom, surface, {.length = 0.02f, .lengthMap = "length"}, progress).ok());
        QVERIFY(groom.guides.count() >= 36 && groom.guides.count() <= 55);
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            // Maps repeat: the left border lies between black and the white on the right.
            const float x = groom.guides.points(i)[0].x;
            QVERIFY(x > -0.02f || x < -0.49f);
        }
        const Groom before = groom;
        QVERIFY(!placeGuidesOnVertices(groom, surface, {.lengthMap = "nothing"}, progress).ok());
        groom.partSettings.edit()[0].growsHair = false;
        QVERIFY(!placeGuidesOnVertices(groom, surface, {}, progress).ok());
        QVERIFY(!placeGuidesOnVertices(groom, surface, {.perSquareMetre = 1e12f}, progress).ok());
        QVERIFY(groom.guides.sameAs(before.guides));
    }

    void tessellatesSmoothly() {
        // Seven points on a quarter of a circle become 36 nearly on it, evenly apart.
        std::vector<glm::vec3> arc;
        for (int i = 0; i < 7; ++i) {
            const float a = static_cast<float>(i) / 6.0f * 1.5707963f;
            arc.push_back({std::sin(a), 1.0f - std::cos(a), 0.0f});
        }
        const auto fine = tessellated(arc, 35);
        QCOMPARE(fine.size(), std::size_t{36});
        QCOMPARE(fine.front(), arc.front());
        QCOMPARE(fine.back(), arc.back());
        for (std::size_t i = 1; i < fine.size(); ++i) {
            QVERIFY(std::abs(glm::distance(fine[i], {0, 1, 0}) - 1.0f) < 6e-3f);
            QVERIFY(std::abs(glm::distance(fine[i], fine[i - 1]) - 1.5707963f / 35.0f) < 3e-4f);
        }
        // A straight line and a point stay what they are.
        for (const glm::vec3& p : tessellated(std::vector<glm::vec3>{{0, 0, 0}, {3, 0, 0}}, 3)) QVERIFY(p.y == 0.0f);
        for (const glm::vec3& p : tessellated(std::vector<glm::vec3>{{1, 1, 1}, {1, 1, 1}}, 4))
            QCOMPARE(p, glm::vec3(1));

        Groom groom = testing::groomOn(testing::sphere(12, 24), 20, 6);
        QVERIFY(tessellateGuides(groom, 0, 35).ok());
        QVERIFY(checkGroom(groom).empty());
        QCOMPARE(groom.groups->front().params.general.segments, 35);
        QVERIFY(!tessellateGuides(groom, 3, 35).ok());
        QVERIFY(!tessellateGuides(groom, 0, 0).ok());
    }
};

QTEST_APPLESS_MAIN(VertexGuidesTest)
#include "vertex_guides_test.moc"
