// SPDX-License-Identifier: Apache-2.0
#include "core/hair/generate.h"

#include "core/base/parallel.h"
#include "core/base/simd.h"
#include "core/hair/curve.h"
#include "core/hair/reference.h"
#include "core/sampling/density.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>

using namespace whorl;

namespace {

SurfaceCache& surfaces() {
    static SurfaceCache cache;
    return cache;
}

Strands grown(const Groom& groom, GenerateOptions options = {}) {
    Generator generator;
    generator.setSurface(surfaces().get(groom.mesh));
    Progress progress;
    Result<Strands> strands = generator.generate(groom, options, progress);
    return strands ? std::move(*strands) : Strands{};
}

GeneralParams& general(Groom& groom, std::size_t group = 0) {
    return groom.groups.edit()[group].params.general;
}

// A sphere with bent guides in two groups that a map divides, and every modifier at work.
Groom busyGroom() {
    Groom groom = testing::groomOn(testing::sphere(20, 40), 150, 12);
    groom.groups.edit().push_back({"other"});
    Map halves(64, 64, 1, TexelFormat::U8, 0.0f), ramp(32, 32, 1, TexelFormat::F32, 1.0f);
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x) halves.setTexel(x, y, 0, 1.0f / 255.0f);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) ramp.setTexel(x, y, 0, static_cast<float>(y) / 31.0f);
    groom.maps.set("halves", halves);
    groom.maps.set("ramp", ramp);
    groom.counts.edit().groupMap.name = "halves";
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        if (g % 2) groom.guides.setGroup(g, 1);
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size());
            points[v] += along * along * glm::vec3(0.02f * std::sin(static_cast<float>(g)), -0.06f, 0.01f);
        }
    }
    for (Group& group : groom.groups.edit()) {
        HairParams& p = group.params;
        p.general.segments = 12;
        p.general.keepOutside = false;
        p.general.cut = {1.0f, "ramp"};
        p.general.randomScale = {0.4f, "ramp"};
        p.colour.hueVariation.value = 0.3f;
        p.colour.valueVariation.value = 0.3f;
        p.colour.mutants.value = 0.1f;
        p.frizz.root.value = 0.001f;
        p.frizz.tip.value = 0.01f;
        p.kink.tip.value = 0.003f;
    }
    groom.groups.edit()[1].params.general.samples = 5;
    return groom;
}

float steepness(float amplitude, const glm::vec3& frequency, float octaves = 1.0f) {
    return 1.0f + 4.0f * octaves * amplitude * (std::abs(frequency.x) + std::abs(frequency.y) + std::abs(frequency.z));
}

// What noise makes of rounding: it stretches it by its amplitude and frequency, one noise after another.
float steepness(const HairParams& params) {
    float steep = steepness(std::max(params.kink.root.value, params.kink.tip.value), params.kink.frequency.value);
    for (const Modifier& modifier : params.modifiers) {
        if (const auto* noise = std::get_if<NoiseParams>(&modifier.params))
            steep *= steepness(std::max(noise->rootAmplitude.value, noise->tipAmplitude.value), noise->frequency.value,
                               static_cast<float>(noise->octaves));
        if (const auto* clump = std::get_if<ClumpParams>(&modifier.params))
            steep *= steepness(clump->noise.value, glm::vec3(clump->noiseFrequency.value));
    }
    return steep;
}

// How far members of a strand are from their base hair.
float memberReach(const StrandParams& strands) {
    if (strands.hairs == 0) return 0.0f;
    return std::abs(strands.offset.value) +
           std::max({strands.rootSplay.value, strands.centreSplay.value, strands.tipSplay.value}) *
               std::max(strands.aspect.value, 1.0f);
}

// The most that frames of one hair differ.
float framesApart(const Strands& a, const Strands& b, std::size_t hair) {
    float most = 0.0f;
    for (std::uint32_t v = a.firstVertex[hair]; v < a.firstVertex[hair + 1]; ++v)
        most = std::max(most, glm::distance(a.normals[v], b.normals[v]));
    return most;
}

}  // namespace

class GenerateTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void partsCoverEveryHairOnce() {
        const Groom groom = busyGroom();
        const Strands all = grown(groom, {3000u});
        for (const std::uint32_t parts : {1u, 2u, 3u, 7u, 64u}) {
            std::vector<std::uint32_t> ids;
            for (std::uint32_t part = 0; part < parts; ++part) {
                const Strands strands = grown(groom, {3000u, part, parts});
                // Equal shares, but for hairs that are cut away and chance at the borders.
                const double share = static_cast<double>(all.count()) / parts;
                QVERIFY(std::abs(static_cast<double>(strands.count()) - share) < 0.2 * share + 8.0);
                ids.insert(ids.end(), strands.ids.begin(), strands.ids.end());
            }
            QCOMPARE(ids, all.ids);
        }
        QCOMPARE(grown(groom, {3000u, 5, 3}).count(), std::size_t{0});
        QCOMPARE(grown(groom, {3000u, 0, 0}).count(), std::size_t{0});
        std::vector<std::uint32_t> sorted = all.ids;
        std::sort(sorted.begin(), sorted.end());
        QVERIFY(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
    }

    void aLevelOfDetailIsASubsetThatCoversAsMuch() {
        Groom groom = busyGroom();
        for (Group& group : groom.groups.edit()) group.params.general.cut = {1.0f, ""};
        const Strands all = grown(groom, {4000u});
        std::map<std::uint32_t, std::size_t> places;
        for (std::size_t i = 0; i < all.count(); ++i) places[all.ids[i]] = i;
        std::vector<std::uint32_t> before = all.ids;
        for (const float lod : {0.5f, 0.25f, 0.1f}) {
            const Strands fewer = grown(groom, {4000u, 0, 1, lod});
            QVERIFY(std::abs(static_cast<float>(fewer.count()) - 4000.0f * lod) < 10.0f);
            for (std::size_t i = 0; i < fewer.count(); ++i) {
                QVERIFY(std::find(before.begin(), before.end(), fewer.ids[i]) != before.end());
                const std::size_t j = places.at(fewer.ids[i]);
                QVERIFY(fewer.roots[i] == all.roots[j]);
                const std::size_t v = fewer.firstVertex[i], w = all.firstVertex[j];
                QCOMPARE(fewer.firstVertex[i + 1] - v, all.firstVertex[j + 1] - w);
                QVERIFY(fewer.positions[v + 3] == all.positions[w + 3]);
                QVERIFY(fewer.colours[v + 3] == all.colours[w + 3]);
                QVERIFY(std::abs(fewer.widths[v] * lod - all.widths[w]) < 1e-6f * all.widths[w]);
            }
            // And so is that of fewer hairs.
            QVERIFY(grown(groom, {static_cast<std::uint32_t>(4000.0f * lod)}).ids == fewer.ids);
            before = fewer.ids;
        }
        QCOMPARE(grown(groom, {4000u, 0, 1, 0.0f}).count(), std::size_t{0});
    }

    void theDigestIsTheSameForAnyPartsThreadsAndLevel() {
        const Groom groom = busyGroom();
        Progress progress;
        const std::uint32_t count = 3000;
        const std::uint64_t expected = *hairDigest(groom, 1, count, progress);
        for (const std::uint32_t parts : {2u, 3u, 7u}) QCOMPARE(*hairDigest(groom, parts, count, progress), expected);
        for (const unsigned threads : {1u, 2u}) {
            const ThreadLimit limit(threads);
            QCOMPARE(*hairDigest(groom, 1, count, progress), expected);
        }
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            setSimdLevel(level);
            QCOMPARE(*hairDigest(groom, 1, count, progress), expected);
        }
        setSimdLevel(bestSimdLevel());
        GenerateOptions options;
        options.hairCount = count;
        QCOMPARE(testing::digestOf(grown(groom, options)), expected);
        Groom other = groom;
        other.counts.edit().seed += 1;
        QVERIFY(*hairDigest(other, 1, count, progress) != expected);
    }

    void streamingGivesTheSameInAnyBlockSize() {
        const Groom groom = busyGroom();
        GenerateOptions options{2000u, 1, 3};
        const std::uint64_t expected = testing::digestOf(grown(groom, options));
        for (const std::uint32_t size : {1u, 17u, 5000u}) {
            Generator generator;
            Progress progress;
            Hasher hasher;
            std::size_t most = 0;
            QVERIFY(generator.stream(
                groom, options, size,
                [&](const Strands& block) {
                    block.addTo(hasher);
                    most = std::max(most, block.count());
                    return true;
                },
                progress));
            QCOMPARE(hasher.digest(), expected);
            QVERIFY(most <= size);
        }
    }

    void rootsStayOnTheSkin() {
        const Groom groom = busyGroom();
        const Strands strands = grown(groom, {2000u});
        QVERIFY(strands.count() > 1000);
        for (std::size_t i = 0; i < strands.count(); ++i) {
            const glm::vec3 root = positionAt(*groom.mesh, strands.roots[i]);
            QVERIFY(glm::distance(strands.positions[strands.firstVertex[i]], root) < 1e-7f);
            QVERIFY(strands.roots[i].u >= 0.0f && strands.roots[i].v >= 0.0f);
            QVERIFY(strands.roots[i].u + strands.roots[i].v <= 1.0f);
        }
    }

    void equalsTheReferenceForRandomGrooms() {
        std::size_t hairs = 0, calm = 0;
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            const Groom groom = testing::randomGroom(seed);
            Progress progress;
            const Strands fast = grown(groom, {400u});
            const Result<Strands> made = generateReference(groom, surfaces().get(groom.mesh), {400u}, progress);
            QVERIFY(made);
            const Strands& slow = *made;
            QCOMPARE(fast.ids, slow.ids);
            QCOMPARE(fast.firstVertex, slow.firstVertex);
            for (std::size_t i = 0; i < fast.count(); ++i) {
                float length = 0;
                for (std::uint32_t v = fast.firstVertex[i]; v + 1 < fast.firstVertex[i + 1]; ++v)
                    length += glm::distance(slow.positions[v], slow.positions[v + 1]);
                const HairParams& params = (*groom.groups)[fast.groups[i]].params;
                const float steep = steepness(params);
                // Members stand on the frames of their base hair, which multiply rounding where vertices nearly
                // coincide.
                const float turned = framesApart(fast, slow, i), reach = memberReach(params.strands) * turned;
                if (turned < 1e-2f) ++calm;
                for (std::uint32_t v = fast.firstVertex[i]; v < fast.firstVertex[i + 1]; ++v) {
                    const float apart = glm::distance(fast.positions[v], slow.positions[v]);
                    QVERIFY2(apart <= 1e-5f * length + 2e-7f * steep + reach,
                             qPrintable(QString("seed %1 hair %2: %3 of %4").arg(seed).arg(i).arg(apart).arg(length)));
                    QVERIFY(std::abs(fast.widths[v] - slow.widths[v]) < 1e-7f);
                    QVERIFY(glm::distance(fast.colours[v], slow.colours[v]) < 1e-5f);
                }
            }
            hairs += fast.count();
        }
        QVERIFY(hairs > 500);
        QVERIFY2(calm * 10 > hairs * 9, qPrintable(QString("%1 of %2").arg(calm).arg(hairs)));
    }

    void normalsAreUnitAndAcross() {
        const Groom groom = busyGroom();
        const Strands strands = grown(groom, {3000u});
        for (std::size_t i = 0; i < strands.count(); ++i) {
            const std::size_t first = strands.firstVertex[i], count = strands.firstVertex[i + 1] - first;
            const std::span<const glm::vec3> points{&strands.positions[first], count};
            const std::vector<glm::vec3> expected = referenceNormals(points, normalAt(*groom.mesh, strands.roots[i]));
            for (std::size_t v = 0; v < count; ++v) {
                const glm::vec3& normal = strands.normals[first + v];
                QVERIFY(std::abs(glm::length(normal) - 1.0f) < 1e-5f);
                QVERIFY(std::abs(glm::dot(normal, strandTangent(points, v, normal))) < 1e-4f);
                QVERIFY(glm::distance(normal, expected[v]) < 1e-2f);
            }
        }
    }

    void zeroNoiseChangesNothing() {
        Groom groom = busyGroom();
        for (Group& group : groom.groups.edit()) group.params.frizz.root.value = group.params.frizz.tip.value = 0.0f;
        for (Group& group : groom.groups.edit()) group.params.kink.tip.value = 0.0f;
        const std::uint64_t expected = testing::digestOf(grown(groom, {1000u}));
        for (Group& group : groom.groups.edit()) {
            group.params.frizz.frequency.value = glm::vec3(700.0f);
            group.params.kink.frequency.value = glm::vec3(900.0f);
        }
        QCOMPARE(testing::digestOf(grown(groom, {1000u})), expected);
        groom.maps.set("black", Map(4, 4, 1, TexelFormat::U8, 0.0f));
        for (Group& group : groom.groups.edit()) group.params.frizz.tip = {0.5f, "black"};
        QCOMPARE(testing::digestOf(grown(groom, {1000u})), expected);
        for (Group& group : groom.groups.edit()) group.params.frizz.tip = {0.5f, ""};
        QVERIFY(testing::digestOf(grown(groom, {1000u})) != expected);
    }

    void aHairNeverDrawsOnAnotherGroup() {
        Groom groom = busyGroom();
        const Strands before = grown(groom, {2000u});
        for (std::size_t g = 0; g < groom.guides.count(); ++g) {
            if (groom.guides.group(g) != 1) continue;
            for (glm::vec3& p : groom.guides.editPoints(g).subspan(1)) p += glm::vec3(0.05f, 0.02f, 0.0f);
        }
        const Strands after = grown(groom, {2000u});
        QCOMPARE(before.ids, after.ids);
        std::size_t moved = 0, kept = 0;
        for (std::size_t i = 0; i < before.count(); ++i) {
            const std::uint32_t tip = before.firstVertex[i + 1] - 1;
            const bool same = before.positions[tip] == after.positions[tip];
            QCOMPARE(same, before.groups[i] == 0);
            ++(same ? kept : moved);
        }
        QVERIFY(moved > 100 && kept > 100);
    }

    void groupsAndDensityFollowTheirMaps() {
        Groom groom = busyGroom();
        general(groom).density = {1.0f, "ramp"};
        const DensityLookup density(groom);
        const Strands strands = grown(groom, {3000u});
        QVERIFY(strands.count() > 1000);
        for (std::size_t i = 0; i < strands.count(); ++i) {
            QCOMPARE(static_cast<int>(strands.groups[i]), density.groupAt(strands.rootUvs[i]));
            QVERIFY(density.at(strands.roots[i].triangle, strands.rootUvs[i]) > 0.0f);
        }
    }

    void cuttingEndsTheCurveEarlier() {
        Groom groom = testing::groomOn(testing::sphere(12, 24), 40, 10);
        general(groom).keepOutside = false;
        general(groom).segments = 10;
        groom.groups.edit()[0].params.frizz.tip.value = 0.02f;
        const Strands whole = grown(groom, {300u});
        general(groom).cut.value = 0.55f;
        const Strands cut = grown(groom, {300u});
        QCOMPARE(whole.ids, cut.ids);
        for (std::size_t i = 0; i < cut.count(); ++i) {
            const std::size_t first = whole.firstVertex[i], second = cut.firstVertex[i];
            QCOMPARE(cut.firstVertex[i + 1] - cut.firstVertex[i], 7u);
            for (std::size_t v = 0; v < 6; ++v) QCOMPARE(cut.positions[second + v], whole.positions[first + v]);
            const std::span<const glm::vec3> points{&whole.positions[first], 11};
            QVERIFY(glm::distance(cut.positions[second + 6], strandPoint(points, 5.5f)) < 1e-6f);
            QVERIFY(std::abs(cut.widths[second + 6] - (0.00009f + 0.55f * (0.00003f - 0.00009f))) < 1e-9f);
        }
        general(groom).cut.value = 0.0f;
        QCOMPARE(grown(groom, {300u}).count(), std::size_t{0});
    }

    void nothingGrowsFromNothing() {
        Groom groom = testing::groomOn(testing::sphere(12, 24), 0);
        QCOMPARE(grown(groom).count(), std::size_t{0});
        groom = testing::groomOn(testing::sphere(12, 24), 10);
        QCOMPARE(grown(groom, {0u}).count(), std::size_t{0});
        QVERIFY(grown(groom, {100u}).count() == 100);
        general(groom).density.value = 0.0f;
        QCOMPARE(grown(groom, {100u}).count(), std::size_t{0});
        general(groom).density.value = 1.0f;
        general(groom).scale.value = 0.0f;
        QCOMPARE(grown(groom, {100u}).count(), std::size_t{0});
    }

    void cancelledWorkSaysSo() {
        const Groom groom = busyGroom();
        Generator generator;
        Progress stopped;
        stopped.cancel();
        const Result<Strands> none = generator.generate(groom, {1000u}, stopped);
        QVERIFY(!none && none.error().cancelled);
        Progress progress;
        QVERIFY(!generator.stream(
            groom, {1000u}, 10, [](const Strands&) { return false; }, progress));
        const Result<Strands> all = generator.generate(groom, {1000u}, progress);
        QVERIFY(all);
        QCOMPARE(testing::digestOf(*all), testing::digestOf(grown(groom, {1000u})));
    }

    void aKnownHair() {
        // One straight guide on a plane: every hair is the guide moved to its root.
        Groom groom = testing::groomOn(testing::plane(2), 1, 4, 0.2f);
        general(groom).segments = 4;
        general(groom).rootThickness.value = 0.00009f;
        const Strands strands = grown(groom, {50u});
        QCOMPARE(strands.count(), std::size_t{50});
        for (std::size_t i = 0; i < strands.count(); ++i) {
            const glm::vec3 root = positionAt(*groom.mesh, strands.roots[i]);
            for (std::uint32_t v = 0; v < 5; ++v) {
                const glm::vec3 expected = root + glm::vec3(0, 0.05f * static_cast<float>(v), 0);
                QVERIFY(glm::distance(strands.positions[strands.firstVertex[i] + v], expected) < 1e-6f);
            }
            QCOMPARE(strands.widths[strands.firstVertex[i]], 0.00009f);
            QCOMPARE(strands.colours[strands.firstVertex[i]].w, 1.0f);
        }
    }
};

QTEST_APPLESS_MAIN(GenerateTest)
#include "generate_test.moc"
