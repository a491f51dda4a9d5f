// SPDX-License-Identifier: Apache-2.0
#include "core/hair/explain.h"

#include "core/commands/partings.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

class ExplainTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    // The last stage is the hair that is generated; what is left out there is said not to grow here.
    void endsWithTheHairThatIsGenerated() {
        for (std::uint32_t seed = 0; seed < 8; ++seed) {
            Groom groom = testing::randomGroom(seed);
            // One curve a root, whole.
            for (Group& group : groom.groups.edit()) {
                group.params.strands.hairs = 0;
                group.params.general.skipThreshold = 0.0f;
            }
            const auto surface = std::make_shared<const Surface>(groom.mesh);
            Progress progress;
            const auto strands = Generator().generate(groom, {}, progress);
            QVERIFY(strands.ok());
            int grown = 0;
            const bool even = DensityLookup(groom).anyEven();
            for (std::uint32_t number = 0; number < 120; ++number) {
                // Every second one of those that keep apart, where a group has such.
                const std::uint32_t id = number % 2 == 0 ? number / 2 : evenId | number / 2;
                const auto hair = explainHair(groom, surface, id, 0, progress);
                QCOMPARE(hair.ok(), number % 2 == 0 || even);
                if (!hair) continue;
                const auto found = std::find(strands->ids.begin(), strands->ids.end(), id);
                const bool there = found != strands->ids.end();
                const auto next = static_cast<std::size_t>(found - strands->ids.begin());
                QCOMPARE(hair->grows, there);
                QCOMPARE(hair->why.empty(), there);
                QVERIFY(!explanationText(*hair).empty());
                if (!there) continue;
                const std::size_t first = strands->firstVertex[next], last = strands->firstVertex[next + 1];
                const std::vector<glm::vec3>& points = hair->stages.back().points;
                QCOMPARE(points.size(), last - first);
                float length = 0.0f;
                for (std::size_t v = 1; v < points.size(); ++v) length += glm::distance(points[v - 1], points[v]);
                for (std::size_t v = 0; v < points.size(); ++v)
                    QVERIFY(glm::distance(points[v], strands->positions[first + v]) < 1e-5f * std::max(length, 1.0f));
                float weights = 0.0f;
                for (const ExplainedGuide& guide : hair->guides) {
                    weights += guide.weight;
                    QCOMPARE(groom.guides.id(guide.index), guide.id);
                }
                QVERIFY(std::abs(weights - 1.0f) < 1e-4f);
                ++grown;
            }
            QVERIFY(grown > 0 || strands->count() == 0);
        }
    }

    void namesGuidesBeyondPartings() {
        Groom groom = testing::groomOn(testing::sphere(24, 48), 300);
        const Surface surface(groom.mesh);
        const std::vector<glm::vec3> line{{0, -0.05f, 0.1f}, {0, 0.1f, 0}, {0, -0.05f, -0.1f}};
        QVERIFY(addParting(groom, surface, line).ok());
        const auto shared = std::make_shared<const Surface>(groom.mesh);
        Progress progress;
        int beside = 0;
        for (std::uint32_t id = 0; id < 400; ++id) {
            const auto hair = explainHair(groom, shared, id, 400, progress);
            QVERIFY(hair.ok());
            if (!hair->separated.empty()) ++beside;
            for (const ExplainedGuide& guide : hair->separated) {
                QVERIFY(groom.guides.points(guide.index)[0].x * hair->root.position.x <= 1e-6f);
                for (const ExplainedGuide& own : hair->guides) QVERIFY(own.id != guide.id);
            }
        }
        QVERIFY(beside > 5);
    }

    void saysWhyNothingGrows() {
        Groom groom = testing::groomOn(testing::sphere(12, 24), 30);
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        Progress progress;
        QVERIFY(!explainHair(groom, surface, 10000000, 0, progress).ok());
        const auto why = [&](const Groom& changed) { return explainHair(changed, surface, 5, 0, progress)->why; };
        QVERIFY(why(groom).empty());
        Groom cut = groom;
        cut.groups.edit()[0].params.general.cut.value = 0.0f;
        QVERIFY(why(cut).find("cut") != std::string::npos);
        Groom bald = groom;
        bald.guides.clear();
        QVERIFY(why(bald).find("no guides") != std::string::npos);
        groom.partSettings.edit()[0].growsHair = false;
        QVERIFY(!explainHair(groom, surface, 5, 0, progress).ok());
    }

    void namesMaps() {
        Groom groom = testing::groomOn(testing::sphere(12, 24), 30);
        groom.maps.set("half", Map(8, 8, 1, TexelFormat::F32, 0.5f));
        groom.groups.edit()[0].params.general.scale.map = "half";
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        Progress progress;
        const auto hair = explainHair(groom, surface, 3, 0, progress);
        QCOMPARE(hair->maps.size(), std::size_t{1});
        QCOMPARE(hair->maps[0].parameter, std::string("general/scale"));
        QCOMPARE(hair->maps[0].value, 0.5f);
        const std::string text = explanationText(*hair);
        for (const char* word : {"general/scale by half: 0.5", "after interpolation", "after cut", "guide: "})
            QVERIFY2(text.find(word) != std::string::npos, word);
    }
};

QTEST_APPLESS_MAIN(ExplainTest)
#include "explain_test.moc"
