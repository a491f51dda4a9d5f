// SPDX-License-Identifier: Apache-2.0
// Strands, skipped vertices, animated frizz.
#include "core/hair/changes.h"
#include "core/hair/curve.h"
#include "core/hair/generate.h"
#include "core/hair/prepared.h"
#include "core/hair/thin.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <cmath>

using namespace whorl;

namespace {

Groom ball(int segments = 12) {
    Groom groom = testing::groomOn(testing::sphere(20, 40), 150, segments, 0.06f);
    HairParams& p = groom.groups.edit()[0].params;
    p.general.segments = segments;
    p.general.keepOutside = false;
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size() - 1);
            points[v] += along * along * glm::vec3(0.02f, -0.04f, 0.01f);
        }
    }
    return groom;
}

HairParams& params(Groom& groom) {
    return groom.groups.edit()[0].params;
}

Strands grown(const Groom& groom, GenerateOptions options = {400u}) {
    return testing::grown(groom, options);
}

std::span<const glm::vec3> pointsOf(const Strands& strands, std::size_t i) {
    return {&strands.positions[strands.firstVertex[i]], strands.firstVertex[i + 1] - strands.firstVertex[i]};
}

}  // namespace

class MembersTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aStrandOfOneWithoutSplayIsTheHair() {
        Groom groom = ball();
        const Strands before = grown(groom);
        params(groom).strands = {.hairs = 1, .rootSplay{}, .centreSplay{}, .tipSplay{}};
        const Strands after = grown(groom);
        QCOMPARE(after.ids, before.ids);
        for (std::size_t v = 0; v < before.vertexCount(); ++v)
            QVERIFY(glm::distance(after.positions[v], before.positions[v]) < 1e-7f);
        QVERIFY(after.widths == before.widths && after.colours == before.colours);
    }

    void membersInheritFromTheirHair() {
        Groom groom = ball();
        params(groom).colour.hueVariation.value = 1.0f;
        params(groom).general.randomScale.value = 0.5f;
        params(groom).general.cut.value = 0.61f;
        const Strands single = grown(groom);
        params(groom).strands.hairs = 5;
        const Strands strands = grown(groom);
        QCOMPARE(strands.count(), single.count() * 5);
        for (std::size_t i = 0; i < strands.count(); ++i) {
            const std::size_t base = i / 5;
            QCOMPARE(strands.ids[i], single.ids[base]);
            QCOMPARE(static_cast<std::size_t>(strands.members[i]), i % 5);
            QCOMPARE(strands.groups[i], single.groups[base]);
            QCOMPARE(pointsOf(strands, i).size(), pointsOf(single, base).size());
            for (std::size_t v = 0; v < pointsOf(single, base).size(); ++v) {
                QCOMPARE(strands.widths[strands.firstVertex[i] + v], single.widths[single.firstVertex[base] + v]);
                QCOMPARE(strands.colours[strands.firstVertex[i] + v], single.colours[single.firstVertex[base] + v]);
            }
        }
    }

    void splayIsTheDistanceFromTheMiddle() {
        Groom groom = ball(20);
        const Strands single = grown(groom);
        params(groom).strands = {
            .hairs = 40, .rootSplay{0.001f}, .centreSplay{0.004f}, .tipSplay{0.002f}, .randomise{0.0f}};
        const Strands strands = grown(groom);
        for (std::size_t base = 0; base < single.count(); base += 9) {
            float root = 0, middle = 0, tip = 0;
            glm::vec3 mean(0.0f);
            for (std::size_t i = base * 40; i < base * 40 + 40; ++i) {
                root = std::max(root, glm::distance(pointsOf(strands, i)[0], pointsOf(single, base)[0]));
                middle = std::max(middle, glm::distance(pointsOf(strands, i)[10], pointsOf(single, base)[10]));
                tip = std::max(tip, glm::distance(pointsOf(strands, i)[20], pointsOf(single, base)[20]));
                mean += (pointsOf(strands, i)[10] - pointsOf(single, base)[10]) / 40.0f;
                // Roots stay on the skin.
                const glm::vec3 away = pointsOf(strands, i)[0] - pointsOf(single, base)[0];
                QVERIFY(std::abs(glm::dot(away, normalAt(*groom.mesh, strands.roots[i]))) < 1e-7f);
            }
            // The outermost of 40 stands at sqrt(39.5 / 40).
            QVERIFY2(root < 0.001f && root > 0.0005f, qPrintable(QString::number(static_cast<double>(root))));
            QVERIFY(std::abs(middle - 0.004f) < 0.0001f);
            QVERIFY(std::abs(tip - 0.002f) < 0.0001f);
            QVERIFY(glm::length(mean) < 0.0005f);
        }
    }

    void twistTurnsTipsAboutTheMiddle() {
        Groom groom = ball(20);
        params(groom).strands = {
            .hairs = 6, .rootSplay{0.002f}, .centreSplay{0.002f}, .tipSplay{0.002f}, .randomise{0.0f}};
        const Strands straight = grown(groom);
        params(groom).strands.twist.value = 3.14159265f;
        const Strands twisted = grown(groom);
        params(groom).strands.hairs = 0;
        const Strands single = grown(groom);
        for (std::size_t i = 0; i < straight.count(); i += 7) {
            const glm::vec3 middle = pointsOf(single, i / 6).back();
            const glm::vec3 a = pointsOf(straight, i).back() - middle, b = pointsOf(twisted, i).back() - middle;
            QVERIFY(glm::distance(a, -b) < 0.05f * glm::length(a) + 1e-6f);
            QVERIFY(glm::distance(pointsOf(straight, i)[0], pointsOf(twisted, i)[0]) < 1e-6f);
        }
    }

    void offsetLiftsTipsAndAspectBroadens() {
        Groom groom = ball(20);
        params(groom).strands = {.hairs = 8, .rootSplay{}, .centreSplay{}, .tipSplay{}, .randomise{0.0f}};
        const Strands flat = grown(groom);
        params(groom).strands.offset.value = 0.01f;
        const Strands lifted = grown(groom);
        for (std::size_t i = 0; i < flat.count(); ++i) {
            const float expected = 0.01f * (static_cast<float>(i % 8) + 0.5f) / 8.0f;
            const float is = glm::distance(pointsOf(flat, i).back(), pointsOf(lifted, i).back());
            QVERIFY(std::abs(is - expected) < 1e-5f);
            QCOMPARE(pointsOf(lifted, i)[0], pointsOf(flat, i)[0]);
        }
        params(groom).strands = {.hairs = 30, .centreSplay{0.002f}, .aspect{4.0f}, .randomise{0.0f}};
        const Strands broad = grown(groom);
        float most = 0;
        for (std::size_t i = 0; i < 30; ++i)
            most = std::max(most, glm::distance(pointsOf(broad, i)[10], pointsOf(flat, 0)[10]));
        QVERIFY(most > 0.006f && most < 0.0081f);
    }

    void normalsStandAcrossEveryMember() {
        Groom groom = ball();
        params(groom).strands = {.hairs = 4, .twist{20.0f}};
        params(groom).general.cut.value = 0.7f;
        const Strands strands = grown(groom);
        QVERIFY(strands.count() > 1000);
        for (std::size_t i = 0; i < strands.count(); ++i) {
            const auto points = pointsOf(strands, i);
            for (std::size_t v = 0; v < points.size(); ++v) {
                const glm::vec3& normal = strands.normals[strands.firstVertex[i] + v];
                QVERIFY(std::abs(glm::length(normal) - 1.0f) < 1e-5f);
                QVERIFY(std::abs(glm::dot(normal, strandTangent(points, v, normal))) < 1e-4f);
            }
        }
    }

    void theCutComesLast() {
        Groom groom = ball(10);
        params(groom).strands = {.hairs = 3, .twist{4.0f}, .offset{0.01f}};
        const Strands whole = grown(groom);
        params(groom).general.cut.value = 0.55f;
        const Strands cut = grown(groom);
        for (std::size_t i = 0; i < cut.count(); ++i) {
            QCOMPARE(pointsOf(cut, i).size(), std::size_t{7});
            for (std::size_t v = 0; v < 6; ++v) QCOMPARE(pointsOf(cut, i)[v], pointsOf(whole, i)[v]);
            QVERIFY(glm::distance(pointsOf(cut, i)[6], strandPoint(pointsOf(whole, i), 5.5f)) < 1e-6f);
        }
    }

    void strandsAreTheSameForAnySplit() {
        Groom groom = ball();
        params(groom).strands.hairs = 7;
        params(groom).general.skipThreshold = 0.03f;
        Progress progress;
        const std::uint64_t expected = *hairDigest(groom, 1, 500, progress);
        for (const std::uint32_t parts : {2u, 5u}) QCOMPARE(*hairDigest(groom, parts, 500, progress), expected);
        QCOMPARE(testing::digestOf(grown(groom, {500u})), expected);
    }

    void skippedVerticesWereNearlyStraight() {
        Groom groom = ball(30);
        const Strands all = grown(groom);
        std::size_t before = all.vertexCount();
        for (const float threshold : {0.001f, 0.01f, 0.1f, 1.0f}) {
            params(groom).general.skipThreshold = threshold;
            const Strands thin = grown(groom);
            QCOMPARE(thin.ids, all.ids);
            QVERIFY(thin.vertexCount() <= before);
            before = thin.vertexCount();
            for (std::size_t i = 0; i < all.count(); ++i) {
                const auto points = pointsOf(all, i), kept = pointsOf(thin, i);
                QCOMPARE(kept.front(), points.front());
                QCOMPARE(kept.back(), points.back());
                QVERIFY(kept.size() >= 2);
                std::size_t at = 0;
                for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
                    const glm::vec3 line = kept[k + 1] - kept[k];
                    for (; points[at] != kept[k + 1]; ++at) {
                        const float along =
                            std::clamp(glm::dot(points[at] - kept[k], line) / glm::dot(line, line), 0.0f, 1.0f);
                        QVERIFY(glm::distance(points[at], kept[k] + line * along) <=
                                threshold * glm::length(line) + 1e-7f);
                    }
                }
                for (std::size_t v = 0; v < kept.size(); ++v) {
                    const glm::vec3& normal = thin.normals[thin.firstVertex[i] + v];
                    QVERIFY(std::abs(glm::length(normal) - 1.0f) < 1e-5f);
                    QVERIFY(std::abs(glm::dot(normal, strandTangent(kept, v, normal))) < 1e-4f);
                }
            }
        }
        QVERIFY(before < all.vertexCount() / 2);
    }

    void aStraightHairKeepsItsEnds() {
        std::vector<glm::vec3> points;
        for (int v = 0; v < 9; ++v) points.emplace_back(0.0f, static_cast<float>(v), 0.0f);
        QCOMPARE(keptVertices(points, 1e-4f), (std::vector<std::uint32_t>{0, 8}));
        points[4].x = 1.0f;
        QCOMPARE(keptVertices(points, 1e-4f), (std::vector<std::uint32_t>{0, 3, 4, 5, 8}));
        QCOMPARE(keptVertices({points.data(), 2}, 1.0f), (std::vector<std::uint32_t>{0, 1}));
    }

    void frizzMovesWithTimeOnlyWhenItIsAsked() {
        Groom groom = ball();
        params(groom).frizz.tip.value = 0.02f;
        const auto at = [&](float time) {
            GenerateOptions options{400u};
            options.time = time;
            return grown(groom, options);
        };
        const std::uint64_t still = testing::digestOf(at(0.0f));
        QCOMPARE(testing::digestOf(at(3.0f)), still);
        params(groom).frizz.animation.value = 0.8f;
        QCOMPARE(testing::digestOf(at(0.0f)), still);
        const Strands start = at(0.0f), soon = at(0.02f), later = at(2.0f);
        QVERIFY(testing::digestOf(later) != still);
        // A little later is a little way off.
        float little = 0, far = 0;
        for (std::size_t v = 0; v < start.vertexCount(); ++v) {
            little = std::max(little, glm::distance(start.positions[v], soon.positions[v]));
            far = std::max(far, glm::distance(start.positions[v], later.positions[v]));
        }
        QVERIFY(little > 0.0f && little < 0.1f * far && far < 0.08f);
        // Hair with a frizz of its own moves as well.
        params(groom).frizz.frequency.value = glm::vec3(5000.0f);
        QVERIFY(testing::digestOf(at(0.0f)) != testing::digestOf(at(0.5f)));
        params(groom).frizz.speed.value = 0.0f;
        QCOMPARE(testing::digestOf(at(0.0f)), testing::digestOf(at(0.5f)));
    }

    void aUsedGeneratorFollowsTime() {
        Groom groom = ball();
        params(groom).frizz.tip.value = 0.02f;
        params(groom).frizz.animation.value = 0.5f;
        Generator used;
        Progress progress;
        const auto prepared = *PreparedGroom::make(groom, progress);
        for (const float time : {0.0f, 0.5f, 0.5f, 1.0f, 0.0f}) {
            GenerateOptions options{300u};
            options.time = time;
            const std::uint64_t expected = testing::digestOf(grown(groom, options));
            QCOMPARE(testing::digestOf(*used.generate(groom, options, progress)), expected);
            Hasher hasher;
            QVERIFY(prepared->stream(
                options, 100,
                [&](const Strands& block) {
                    block.addTo(hasher);
                    return true;
                },
                progress));
            QCOMPARE(hasher.digest(), expected);
        }
    }
};

QTEST_APPLESS_MAIN(MembersTest)
#include "members_test.moc"
