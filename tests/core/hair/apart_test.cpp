// SPDX-License-Identifier: Apache-2.0
// What hair is kept apart by: sides of partings and groups, up to as many as a groom may have.
#include "core/base/random.h"
#include "core/commands/modifier_edits.h"
#include "core/commands/partings.h"
#include "core/hair/generate.h"
#include "core/hair/reference.h"
#include "core/io/document.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>

using namespace whorl;

namespace {

float dice(std::uint32_t seed, std::uint64_t i, std::uint32_t channel) {
    return randomFloat(seed, i, channel);
}

/// Guides that go every way, on a ball.
Groom bentBall(std::uint32_t seed, int guides, int segments) {
    Groom groom = testing::groomOn(testing::sphere(24, 48), guides, segments);
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        const glm::vec3 way(dice(seed, g, 0) - 0.5f, dice(seed, g, 1) - 0.5f, dice(seed, g, 2) - 0.5f);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size() - 1);
            points[v] += along * along * 0.05f * way;
        }
    }
    groom.groups.edit()[0].params.general.segments = segments;
    return groom;
}

/// Every stage and every kind of modifier, locks around scattered places and around guides.
void switchOnEverything(Groom& groom, std::uint32_t seed) {
    HairParams& params = groom.groups.edit()[0].params;
    params.general.samples = 3 + static_cast<int>(seed % 6);
    params.general.guidesFrom.index = static_cast<int>(seed % 2);
    params.general.cut.value = 0.8f;
    params.general.randomScale.value = 0.3f;
    params.frizz.tip.value = 0.004f;
    params.frizz.animation.value = 0.5f;
    params.kink.tip.value = 0.002f;
    params.strands.hairs = seed % 3 == 0 ? 3 : 0;
    params.general.skipThreshold = seed % 3 == 1 ? 0.02f : 0.0f;
    for (const BlockInfo& kind : modifierKinds()) QVERIFY(addModifier(groom, 0, kind.id).ok());
    QVERIFY(addModifier(groom, 0, "clump").ok());
    std::vector<Modifier>& list = groom.groups.edit()[0].params.modifiers;
    std::get<ClumpParams>(list.back().params).centres.index = 1;
    std::get<ClumpParams>(list.front().params).count = 80;
    std::get<ClumpParams>(list.front().params).noise.value = 0.005f;
}

Strands grown(const Groom& groom, std::uint32_t hairs = 1500) {
    GenerateOptions options;
    options.hairCount = hairs;
    options.time = 0.4f;
    return testing::grown(groom, options);
}

}  // namespace

class ApartTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void hairOfASideHearsNothingOfTheOther_data() {
        QTest::addColumn<bool>("parted");
        QTest::addColumn<int>("seed");
        for (int seed = 1; seed <= 6; ++seed) QTest::addRow("parted, %d", seed) << true << seed;
        QTest::newRow("not parted") << false << 1;
    }
    // A parting all around a ball: guides on one side of it move, hair on the other keeps its bytes.
    void hairOfASideHearsNothingOfTheOther() {
        QFETCH(bool, parted);
        QFETCH(int, seed);
        const auto number = static_cast<std::uint32_t>(seed);
        Groom groom = bentBall(number, 150, 9);
        switchOnEverything(groom, number);
        if (parted) {
            std::vector<glm::vec3> ring;
            for (int k = 0; k <= 32; ++k) {
                const float turn = 6.2831853f * static_cast<float>(k % 32) / 32.0f;
                ring.emplace_back(0.0031f, 0.1f * std::cos(turn), 0.1f * std::sin(turn));
            }
            const Surface surface(groom.mesh);
            QVERIFY(addParting(groom, surface, ring).ok());
        }
        // Guides and roots right next to the line may be on either side of it: flat triangles put it a little off.
        constexpr float line = 0.0031f, beside = 2e-3f;
        const Strands before = grown(groom);
        for (const float moved : {-1.0f, 1.0f}) {
            Groom other = groom;
            for (std::size_t g = 0; g < other.guides.count(); ++g) {
                if ((other.guides.points(g)[0].x - line) * moved <= beside) continue;
                for (glm::vec3& p : other.guides.editPoints(g).subspan(1)) p += glm::vec3(0.012f, 0.004f, -0.006f);
            }
            const Strands after = grown(other);
            QCOMPARE(after.ids, before.ids);
            std::size_t kept = 0, changed = 0, crossed = 0;
            for (std::size_t i = 0; i < before.count(); ++i) {
                const glm::vec3 root = positionAt(*groom.mesh, before.roots[i]);
                const bool same = testing::sameShape(before, i, after, i);
                if ((root.x - line) * moved > beside) {
                    changed += !same;
                } else if ((root.x - line) * moved < -beside) {
                    ++kept;
                    crossed += !same;
                }
            }
            QVERIFY(kept > 300 && changed > 300);
            QVERIFY2(parted ? crossed == 0 : crossed > 50, qPrintable(QString("%1 of %2").arg(crossed).arg(kept)));
        }
    }

    // Thirty groups with as many numbers of segments, each with its own guides and a stage or a modifier of its own.
    void thirtyGroupsEachWithItsOwnSegments() {
        Groom groom = bentBall(3, 600, 30);
        std::vector<Group>& groups = groom.groups.edit();
        while (groups.size() < 30) {
            groups.push_back(groups.front());
            groups.back().name = "group" + std::to_string(groups.size());
        }
        for (std::size_t g = 0; g < groups.size(); ++g) {
            HairParams& params = groups[g].params;
            params.general.segments = static_cast<int>(g) + 1;
            params.general.keepOutside = g % 7 == 0;
            params.general.guidesFrom.index = g % 4 == 1 ? 1 : 0;
            params.kink.tip.value = g % 3 == 0 ? 0.002f : 0.0f;
            params.frizz.tip.value = g % 3 == 1 ? 0.004f : 0.0f;
            params.strands.hairs = g % 5 == 2 ? 3 : 0;
            params.colour.tip.value = {static_cast<float>(g) / 30.0f, 0.5f, 0.1f};
            if (g % 4 == 3) continue;
            Modifier modifier{"one"};
            modifier.params = defaultModifierParams(g % modifierKindCount);
            params.modifiers = {modifier};
        }
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            groom.guides.setGroup(i, static_cast<std::uint8_t>(i % 30));
            const auto points = groom.guides.points(i);
            groom.guides.setPoints(i, resampled(points, static_cast<int>(i % 30) + 1));
        }
        // Thirty stripes.
        Map numbers(90, 4, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 90; ++x) numbers.setTexel(x, y, 0, static_cast<float>(x / 3) / 255.0f);
        groom.maps.set("numbers", numbers);
        groom.counts.edit().groupMap.name = "numbers";
        QVERIFY(checkGroom(groom).empty());

        GenerateOptions options;
        options.hairCount = 3000;
        Progress progress;
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        const Result<Strands> fast = Generator().generate(groom, options, progress);
        const Result<Strands> slow = generateReference(groom, surface, options, progress);
        QVERIFY(fast.ok() && slow.ok());
        QCOMPARE(fast->ids, slow->ids);
        QCOMPARE(fast->groups, slow->groups);
        QCOMPARE(fast->firstVertex, slow->firstVertex);
        std::array<std::size_t, 30> found{};
        for (std::size_t i = 0; i < fast->count(); ++i) {
            const std::uint8_t group = fast->groups[i];
            ++found.at(group);
            QCOMPARE(fast->firstVertex[i + 1] - fast->firstVertex[i], std::uint32_t{group} + 2);
            QCOMPARE(static_cast<int>(group), static_cast<int>(fast->rootUvs[i].x * 30.0f));
            for (std::uint32_t v = fast->firstVertex[i]; v < fast->firstVertex[i + 1]; ++v) {
                const float apart = glm::distance(fast->positions[v], slow->positions[v]);
                QVERIFY2(apart < 3e-6f, qPrintable(QString("group %1: %2").arg(group).arg(apart)));
                QVERIFY(std::abs(fast->widths[v] - slow->widths[v]) < 1e-7f);
            }
            QVERIFY(std::abs(fast->colours[fast->firstVertex[i + 1] - 1].x - static_cast<float>(group) / 30.0f) <
                    1e-6f);
        }
        for (const std::size_t hairs : found) QVERIFY2(hairs > 30, qPrintable(QString::number(hairs)));
        // However it is split, and from a document.
        const std::uint64_t digest = *hairDigest(groom, 1, 3000, progress);
        QCOMPARE(*hairDigest(groom, 7, 3000, progress), digest);
        const Result<OpenedDocument> opened = documentFromBytes(documentBytes(groom), "memory");
        QVERIFY(opened.ok() && opened->problems.empty());
        QCOMPARE(*hairDigest(opened->groom, 1, 3000, progress), digest);
    }
};

QTEST_APPLESS_MAIN(ApartTest)
#include "apart_test.moc"
