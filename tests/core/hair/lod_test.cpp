// SPDX-License-Identifier: Apache-2.0
#include "core/hair/lod.h"

#include "core/hair/generate.h"
#include "tests/support/shapes.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace whorl;

class LodTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void allHairsCloseByAndFewerFartherAway() {
        SeenCoat coat{.radius = 0.15f, .distance = 0.1f};
        QCOMPARE(lodForScreen(coat, 100000), 1.0f);
        float before = 1.0f;
        bool fell = false;
        for (coat.distance = 0.16f; coat.distance < 2000.0f; coat.distance *= 1.1f) {
            const float lod = lodForScreen(coat, 100000);
            QVERIFY(lod > 0.0f && lod <= before);
            fell = fell || lod < before;
            before = lod;
        }
        QVERIFY(fell);
        // No coat vanishes.
        QCOMPARE(before, 64.0f / 100000.0f);
        QCOMPARE(lodForScreen(coat, 50), 1.0f);
    }

    void largerImagesAndNarrowerViewsNeedMore() {
        const SeenCoat coat{.radius = 0.15f, .distance = 20.0f, .fieldOfView = 0.7f, .imageHeight = 1080.0f};
        const float lod = lodForScreen(coat, 100000);
        QVERIFY(lod < 1.0f && lod > 64.0f / 100000.0f);
        SeenCoat larger = coat, narrower = coat;
        larger.imageHeight = 2160.0f;
        narrower.fieldOfView = 0.35f;
        QVERIFY(std::abs(lodForScreen(larger, 100000) - 4.0f * lod) < 1e-6f);
        QVERIFY(lodForScreen(narrower, 100000) > 4.0f * lod);
        QVERIFY(std::abs(lodForScreen(coat, 100000, 4.0f) - 2.0f * lod) < 1e-6f);
        // The same number of hairs, however many there are.
        QVERIFY(std::abs(lodForScreen(coat, 1000000) * 10.0f - lod) < 1e-6f);
    }

    void aKnownSize() {
        // A ball of 1 m, 10 m away, in 1000 pixels over a right angle: tan(a) = 1 / sqrt(99).
        const SeenCoat coat{.radius = 1.0f, .distance = 10.0f, .fieldOfView = 1.57079633f, .imageHeight = 1000.0f};
        QVERIFY(std::abs(diameterOnScreen(coat) - 100.50378f) < 1e-3f);
        QVERIFY(std::abs(lodForScreen(coat, 1000000) - 0.015866f) < 1e-5f);
    }

    void whatIsNoViewShowsNothing() {
        QCOMPARE(diameterOnScreen({.fieldOfView = 0.0f}), 0.0f);
        QCOMPARE(diameterOnScreen({.fieldOfView = 4.0f}), 0.0f);
        QCOMPARE(diameterOnScreen({.imageHeight = 0.0f}), 0.0f);
        QCOMPARE(diameterOnScreen({.radius = std::numeric_limits<float>::quiet_NaN()}), 0.0f);
        QVERIFY(std::isinf(diameterOnScreen({.distance = 0.0f})));
        QCOMPARE(lodForScreen({}, 0), 1.0f);
    }

    void byCount() {
        QCOMPARE(lodForCount(100, 200), 1.0f);
        QCOMPARE(lodForCount(100, 25), 0.25f);
        QCOMPARE(lodForCount(0, 0), 1.0f);
        QCOMPARE(lodForCount(10, 0), 0.0f);
    }

    void aGroomAtADetailHasFewerAndWiderHairs() {
        Groom groom = testing::groomOn(testing::sphere(20, 40), 100, 8);
        groom.counts.edit().hairs = 4000;
        groom.groups.edit()[0].params.general.tipThickness.value = 0.04f;
        Generator generator;
        Progress progress;
        const Strands all = *generator.generate(groom, {}, progress);
        const Groom quarter = atDetail(groom, 0.25f);
        const Strands some = *generator.generate(quarter, {}, progress);
        QVERIFY(std::abs(static_cast<int>(some.count()) - 1000) < 12);
        std::map<std::uint32_t, std::size_t> places;
        for (std::size_t i = 0; i < all.count(); ++i) places[all.ids[i]] = i;
        for (std::size_t i = 0; i < some.count(); ++i) {
            QVERIFY(places.contains(some.ids[i]));
            const std::size_t a = some.firstVertex[i], b = all.firstVertex[places[some.ids[i]]];
            QVERIFY(some.roots[i] == all.roots[places[some.ids[i]]] && some.positions[a + 5] == all.positions[b + 5]);
            QVERIFY(std::abs(some.widths[a] - 4.0f * all.widths[b]) < 1e-6f * some.widths[a]);
        }
        // Not wider than a groom may have them; all of it is the groom as it is.
        QCOMPARE((*quarter.groups)[0].params.general.tipThickness.value, 0.1f);
        QVERIFY(checkGroom(quarter).empty());
        QVERIFY(atDetail(groom, 1.0f).groups.sameAs(groom.groups));
    }

    void farHairIsASubsetOfNearHair() {
        const Groom groom = testing::groomOn(testing::sphere(20, 40), 100, 8);
        Generator generator;
        Progress progress;
        std::vector<std::uint32_t> before;
        for (const float distance : {0.1f, 12.0f, 30.0f, 80.0f}) {
            const float lod = lodForScreen({.radius = 0.1f, .distance = distance}, 4000);
            const Result<Strands> hair = generator.generate(groom, {4000u, 0, 1, lod}, progress);
            QVERIFY(hair);
            QVERIFY(std::abs(static_cast<float>(hair->count()) - 4000.0f * lod) < 12.0f);
            std::vector<std::uint32_t> ids = hair->ids;
            std::sort(ids.begin(), ids.end());
            QVERIFY(before.empty() || (ids.size() < before.size() &&
                                       std::includes(before.begin(), before.end(), ids.begin(), ids.end())));
            before = ids;
        }
    }
};

QTEST_APPLESS_MAIN(LodTest)
#include "lod_test.moc"
