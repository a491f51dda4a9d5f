// SPDX-License-Identifier: Apache-2.0
// Groups and maps come and go; everything that refers to them follows.
#include "core/commands/group_edits.h"

#include "core/param/path.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>

using namespace whorl;

class GroupEditsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void addingKeepsTheLaws() {
        Groom groom = testing::groomOn(testing::sphere(6, 8), 10);
        QVERIFY(setGroomValue(groom, "groups/hair/frizz/tip", 0.01).ok());
        const Result<int> added = addGroup(groom, "brows", 0);
        QVERIFY(added.ok());
        QCOMPARE(*added, 1);
        QVERIFY((*groom.groups)[1].params == (*groom.groups)[0].params);
        QVERIFY(checkGroom(groom).empty());
    }

    void guidesFollowTheGroupMap() {
        Groom groom = testing::groomOn(testing::plane(4, 1.0f), 40);
        QVERIFY(addGroup(groom, "right", 0).ok());
        QVERIFY(setGroomValue(groom, "groups/right/general/segments", 3.0).ok());
        Map halves(64, 64, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 64; ++y) {
            for (int x = 32; x < 64; ++x) halves.setTexel(x, y, 0, 1.0f / 255.0f);
        }
        groom.maps.set("halves", std::move(halves));
        QCOMPARE(regroupGuides(groom), std::size_t{0});
        groom.counts.edit().groupMap.name = "halves";
        std::size_t right = 0;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            right += uvAt(*groom.mesh, groom.guides.root(i)).x >= 0.5f;
        }
        QVERIFY(right > 5 && right < 35);
        QCOMPARE(regroupGuides(groom), right);
        QVERIFY(checkGroom(groom).empty());
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const bool onRight = uvAt(*groom.mesh, groom.guides.root(i)).x >= 0.5f;
            QCOMPARE(groom.guides.group(i), onRight ? 1 : 0);
            if (onRight) QCOMPARE(groom.guides.points(i).size(), std::size_t{4});
        }
        QCOMPARE(regroupGuides(groom), std::size_t{0});
    }

    void namesAreUniqueAndPlain() {
        Groom groom = testing::groomOn(testing::sphere(6, 8), 4);
        QVERIFY(!addGroup(groom, "hair", 0));
        QVERIFY(!addGroup(groom, "", 0));
        QVERIFY(!addGroup(groom, "a/b", 0));
        QVERIFY(!renameGroup(groom, 0, "a b"));
        QVERIFY(!renameGroup(groom, 7, "x"));
        QVERIFY(!renameGroup(groom, -1, "x"));
        QVERIFY(renameGroup(groom, 0, "hair").ok());
        QVERIFY(renameGroup(groom, 0, "Crown_2").ok());
        QCOMPARE((*groom.groups)[0].name, std::string("Crown_2"));
        QCOMPARE(freeGroupName(groom, "Crown_2"), std::string("Crown_22"));
        QCOMPARE(freeGroupName(groom, "a b/c"), std::string("a-b-c"));
        QCOMPARE(freeGroupName(groom, ""), std::string("group"));
    }

    void groupsAreLimited() {
        Groom groom = testing::groomOn(testing::sphere(6, 8), 4);
        for (std::size_t i = 1; i < Groom::maxGroups; ++i) QVERIFY(addGroup(groom, freeGroupName(groom, "g"), 0).ok());
        QVERIFY(!addGroup(groom, "one-more", 0));
        QVERIFY(checkGroom(groom).empty());
    }

    void removedGroupsLeaveTheirGuidesToANeighbour() {
        for (int gone = 0; gone < 3; ++gone) {
            Groom groom = testing::groomOn(testing::sphere(8, 12), 30);
            QVERIFY(addGroup(groom, "b", 0).ok());
            QVERIFY(addGroup(groom, "c", 0).ok());
            for (std::size_t i = 0; i < groom.guides.count(); ++i)
                groom.guides.setGroup(i, static_cast<std::uint8_t>(i % 3));
            QVERIFY(setGroomValue(groom, "groups/b/general/segments", 7.0).ok());
            QVERIFY(setGroomValue(groom, "groups/c/general/segments", 23.0).ok());
            QVERIFY(checkGroom(groom).empty());
            std::vector<glm::vec3> tips;
            for (std::size_t i = 0; i < groom.guides.count(); ++i) tips.push_back(groom.guides.points(i).back());
            QVERIFY(removeGroup(groom, gone).ok());
            QCOMPARE(groom.groups->size(), std::size_t{2});
            QVERIFY2(checkGroom(groom).empty(), checkGroom(groom).empty() ? "" : checkGroom(groom).front().c_str());
            for (std::size_t i = 0; i < groom.guides.count(); ++i) {
                QVERIFY(glm::distance(groom.guides.points(i).back(), tips[i]) < 1e-6f);
            }
        }
    }

    void theLastGroupStays() {
        Groom groom = testing::groomOn(testing::sphere(6, 8), 4);
        QVERIFY(!removeGroup(groom, 0));
        QVERIFY(!removeGroup(groom, 1));
        QCOMPARE(groom.groups->size(), std::size_t{1});
    }

    void referencesFollowMaps() {
        Groom groom = testing::groomOn(testing::sphere(6, 8), 4);
        groom.maps.set("a", Map(8, 8, 1, TexelFormat::U8, 1.0f));
        groom.maps.set("b", Map(8, 8, 1, TexelFormat::U8, 1.0f));
        QVERIFY(setGroomValue(groom, "groups/hair/general/density/map", std::string("a")).ok());
        QVERIFY(setGroomValue(groom, "counts/group_map", std::string("a")).ok());
        const Groom before = groom;
        QVERIFY(!renameMap(groom, "a", "b"));
        QVERIFY(!renameMap(groom, "x", "y"));
        QVERIFY(!renameMap(groom, "a", "no good"));
        QVERIFY(groom.sameAs(before));
        QVERIFY(renameMap(groom, "a", "scalp").ok());
        QCOMPARE(groom.groups->front().params.general.density.map, std::string("scalp"));
        QCOMPARE(groom.counts->groupMap.name, std::string("scalp"));
        QCOMPARE(groom.maps.entries().front().name, std::string("scalp"));
        QVERIFY(checkGroom(groom).empty());
        QVERIFY(groom.guides.sameAs(before.guides));
        QVERIFY(groom.mesh.sameAs(before.mesh));
        QVERIFY(removeMap(groom, "scalp").ok());
        QVERIFY(groom.groups->front().params.general.density.map.empty());
        QVERIFY(groom.counts->groupMap.name.empty());
        QVERIFY(!removeMap(groom, "scalp"));
        QVERIFY(checkGroom(groom).empty());
    }
};

QTEST_APPLESS_MAIN(GroupEditsTest)
#include "group_edits_test.moc"
