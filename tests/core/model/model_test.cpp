// SPDX-License-Identifier: Apache-2.0
#include "core/model/groom.h"

#include <QtTest>

using namespace whorl;

namespace {

const std::vector<glm::vec3> straight{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};

GuideSet manyGuides(std::size_t count) {
    GuideSet guides;
    for (std::size_t i = 0; i < count; ++i) {
        auto points = straight;
        points[2].x = static_cast<float>(i);
        guides.append({static_cast<std::uint32_t>(i), 0.25f, 0.5f}, 0, points);
    }
    return guides;
}

}  // namespace

class ModelTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void editingACopyLeavesTheOriginal() {
        const GuideSet original = manyGuides(200);
        GuideSet copy = original;
        QVERIFY(copy.sameAs(original));
        copy.editPoints(70)[1] = {9, 9, 9};
        QCOMPARE(original.points(70)[1], glm::vec3(0, 1, 0));
        QCOMPARE(copy.points(70)[1], glm::vec3(9, 9, 9));
        QVERIFY(!copy.sameAs(original));
    }

    void anEditUnsharesOneBlockOnly() {
        const GuideSet original = manyGuides(64 * 10);
        GuideSet copy = original;
        copy.editPoints(200)[1] = {9, 9, 9};
        for (std::size_t block = 0; block < copy.blockCount(); ++block) {
            QCOMPARE(copy.blockSameAs(block, original), block != 200 / GuideBlock::capacity);
        }
        QVERIFY(copy.bytesNotSharedWith(original) < original.bytesNotSharedWith(GuideSet()) / 5);
    }

    void erasingKeepsTheOthersAndTheirNumbers() {
        GuideSet guides = manyGuides(300);
        std::vector<std::size_t> doomed;
        for (std::size_t i = 0; i < 300; i += 3) doomed.push_back(i);
        for (std::size_t i = 129; i < 190; ++i) {
            if (i % 3 != 0) doomed.push_back(i);
        }
        std::sort(doomed.begin(), doomed.end());
        guides.erase(doomed);
        QCOMPARE(guides.count(), 300 - doomed.size());
        std::size_t place = 0;
        for (std::size_t i = 0; i < 300; ++i) {
            if (std::binary_search(doomed.begin(), doomed.end(), i)) continue;
            QCOMPARE(guides.id(place), static_cast<std::uint32_t>(i + 1));
            QCOMPARE(guides.points(place)[2].x, static_cast<float>(i));
            QCOMPARE(guides.root(place).triangle, static_cast<std::uint32_t>(i));
            ++place;
        }
        QCOMPARE(guides.append({}, 0, straight), 301u);
    }

    void setPointsMayChangeTheirNumber() {
        GuideSet guides = manyGuides(10);
        guides.setPoints(3, resampled(guides.points(3), 7));
        guides.setPoints(4, resampled(guides.points(4), 1));
        QCOMPARE(guides.points(3).size(), std::size_t{8});
        QCOMPARE(guides.points(4).size(), std::size_t{2});
        for (std::size_t i = 0; i < 10; ++i) {
            QCOMPARE(guides.points(i).front(), straight.front());
            QCOMPARE(guides.points(i).back(), glm::vec3(i, 2, 0));
        }
    }

    void resamplingKeepsEndsAndEqualPieces() {
        const std::vector<glm::vec3> bent{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}};
        const auto points = resampled(bent, 8);
        QCOMPARE(points.size(), std::size_t{9});
        QCOMPARE(points.front(), bent.front());
        QCOMPARE(points.back(), bent.back());
        QCOMPARE(points[6], glm::vec3(3, 0, 0));
        QCOMPARE(points[3], glm::vec3(1.5f, 0, 0));
        const auto collapsed = resampled(std::vector<glm::vec3>(4, {1, 1, 1}), 5);
        for (const auto& p : collapsed) QCOMPARE(p, glm::vec3(1));
    }

    void texelsComeBackInEveryFormat() {
        for (const auto format : {TexelFormat::U8, TexelFormat::U16, TexelFormat::F32}) {
            for (const int channels : {1, 3}) {
                Map map(130, 65, channels, format, 0.0f);
                map.setTexel(129, 64, channels - 1, 1.0f);
                map.setTexel(64, 63, 0, 0.4f);
                QCOMPARE(map.texel(129, 64, channels - 1), 1.0f);
                QVERIFY(std::abs(map.texel(64, 63, 0) - 0.4f) < 0.003f);
                QCOMPARE(map.texel(0, 0), 0.0f);
            }
        }
    }

    void aDabUnsharesOneTile() {
        const Map before(1024, 1024, 1, TexelFormat::U16, 0.5f);
        Map after = before;
        after.setTexel(100, 700, 0, 1.0f);
        int changed = 0;
        for (int row = 0; row < after.tileRows(); ++row) {
            for (int column = 0; column < after.tileColumns(); ++column) {
                if (!after.tileSameAs(column, row, before)) ++changed;
            }
        }
        QCOMPARE(changed, 1);
        QCOMPARE(before.texel(100, 700), before.texel(0, 0));
    }

    void samplingIsBilinearAndRepeats() {
        Map map(2, 1, 1, TexelFormat::F32, 0.0f);
        map.setTexel(1, 0, 0, 1.0f);
        QCOMPARE(map.sample({0.25f, 0.5f}), 0.0f);
        QCOMPARE(map.sample({0.75f, 0.5f}), 1.0f);
        QCOMPARE(map.sample({0.5f, 0.1f}), 0.5f);
        QCOMPARE(map.sample({3.75f, -2.5f}), 1.0f);
        QVERIFY(std::isfinite(map.sample({1e9f, std::nanf("")})));
        QCOMPARE(map.sampleNearest({0.6f, 0.5f}), 1.0f);
    }

    void theFirstRowIsTheTopUnlessFlipped() {
        Map map(1, 4, 1, TexelFormat::F32, 0.0f);
        map.setTexel(0, 0, 0, 1.0f);
        QCOMPARE(map.sample({0.5f, 0.875f}), 1.0f);
        QCOMPARE(map.sample({0.5f, 0.125f}), 0.0f);
        map.flipV = true;
        QCOMPARE(map.sample({0.5f, 0.875f}), 0.0f);
        QCOMPARE(map.sample({0.5f, 0.125f}), 1.0f);
    }

    void colourMapsDecodeSrgb() {
        Map map(1, 1, 3, TexelFormat::U8, 0.5f);
        map.srgb = true;
        QVERIFY(std::abs(map.sampleColour({0.5f, 0.5f}).x - 0.2158f) < 0.002f);
        map.srgb = false;
        QVERIFY(std::abs(map.sampleColour({0.5f, 0.5f}).x - 0.502f) < 0.001f);
    }

    void mapsKeepTheirOrderAndNames() {
        MapSet maps;
        maps.set("density", Map(4, 4, 1, TexelFormat::U8, 1.0f));
        maps.set("length", Map(8, 8, 1, TexelFormat::U8, 1.0f));
        const MapSet before = maps;
        maps.set("density", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        QCOMPARE(maps.entries().size(), std::size_t{2});
        QCOMPARE(maps.find("density")->width(), 16);
        QCOMPARE(before.find("density")->width(), 4);
        QVERIFY(!maps.sameAs(before));
        QVERIFY(maps.erase("density"));
        QVERIFY(!maps.erase("density"));
        QVERIFY(maps.find("density") == nullptr);
    }

    void aNewGroomHoldsItsLaws() {
        SurfaceMesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}};
        mesh.normals.assign(3, {0, 1, 0});
        mesh.triangles = {{0, 1, 2}};
        mesh.cornerUvs = {{0, 0}, {1, 0}, {0, 1}};
        mesh.parts = {{"all", 0, 1}};
        Groom groom = makeGroom(mesh);
        QVERIFY(checkGroom(groom).empty());
        QCOMPARE(groom.groups->size(), std::size_t{1});
        QCOMPARE(groom.groupIndex("hair"), 0);

        groom.guides.append({7, 0, 0}, 3, straight);
        groom.groups.edit()[0].params.frizz.tip.map = "gone";
        QCOMPARE(checkGroom(groom).size(), std::size_t{3});
    }

    void hairFitsTheSizeOfTheMesh() {
        const auto thickness = [](float size) {
            SurfaceMesh mesh;
            mesh.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
            return (*makeGroom(mesh).groups)[0].params.general.rootThickness.value;
        };
        const float usual = GeneralParams().rootThickness.value;
        QCOMPARE(thickness(0.25f), usual);
        QCOMPARE(thickness(3.5f), usual * 10.0f);
        QCOMPARE(thickness(0.035f), usual * 0.1f);
        QCOMPARE(thickness(1e9f), 0.1f);
    }

    void equalEmptyGroomsShareEverything() { QVERIFY(Groom().maps.sameAs(Groom().maps)); }
};

QTEST_APPLESS_MAIN(ModelTest)
#include "model_test.moc"
