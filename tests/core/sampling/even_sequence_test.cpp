// SPDX-License-Identifier: Apache-2.0
// Hairs that keep apart: distances, density, beginnings, paint, groups.
#include "core/sampling/even_sequence.h"

#include "core/base/parallel.h"
#include "core/hair/generate.h"
#include "core/hair/roots.h"
#include "core/sampling/density_total.h"
#include "core/surface/surface_point.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace whorl;
using testing::Paint;
using testing::painted;
using testing::samplerOf;

namespace {

Groom evenGroom(SurfaceMesh mesh, Map map, bool even = true) {
    Groom groom = testing::densityGroom(std::move(mesh), std::move(map));
    groom.groups.edit()[0].params.general.even = even;
    return groom;
}

std::vector<HairRoot> rootsOf(const Groom& groom, const RootSampler& sampler, double hairs) {
    Progress progress;
    return makeRoots({*groom.mesh, sampler, DensityLookup(groom), {hairs / sampler.weight(), 1}}, {}, progress);
}

// Distance of each root to its nearest neighbour, over that of the densest packing of as many on the area.
std::vector<double> nearest(const std::vector<HairRoot>& roots, double area) {
    const double most = std::sqrt(2.0 * area / (std::sqrt(3.0) * static_cast<double>(roots.size())));
    std::vector<const HairRoot*> byX;
    for (const HairRoot& root : roots) byX.push_back(&root);
    std::sort(byX.begin(), byX.end(), [](auto* a, auto* b) { return a->position.x < b->position.x; });
    std::vector<double> found(byX.size(), 1e30);
    for (std::size_t i = 0; i < byX.size(); ++i) {
        for (std::size_t j = i + 1; j < byX.size(); ++j) {
            const double dx = static_cast<double>(byX[j]->position.x - byX[i]->position.x);
            if (dx > 1.5 * most) break;
            const double d = static_cast<double>(glm::distance(byX[i]->position, byX[j]->position)) / most;
            found[i] = std::min(found[i], d);
            found[j] = std::min(found[j], d);
        }
    }
    return found;
}

double areaOf(const SurfaceMesh& mesh) {
    double area = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) area += triangleArea(mesh, t);
    return area;
}

}  // namespace

class EvenSequenceTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyBeginningKeepsApart() {
        const Groom even = evenGroom(testing::sphere(60, 90), Map(8, 8, 1, TexelFormat::U8, 1.0f));
        const Groom plain = evenGroom(testing::sphere(60, 90), Map(8, 8, 1, TexelFormat::U8, 1.0f), false);
        const RootSampler a = samplerOf(even), b = samplerOf(plain);
        const double area = areaOf(*even.mesh);
        for (const double count : {60.0, 300.0, 1234.0, 5000.0, 20000.0}) {
            const std::vector<HairRoot> roots = rootsOf(even, a, count);
            QCOMPARE(roots.size(), static_cast<std::size_t>(count));
            const std::vector<double> d = nearest(roots, area), other = nearest(rootsOf(plain, b, count), area);
            const double least = *std::min_element(d.begin(), d.end());
            double mean = 0.0, otherMean = 0.0;
            for (const double x : d) mean += std::min(x, 1.5) / static_cast<double>(d.size());
            for (const double x : other) otherMean += std::min(x, 1.5) / static_cast<double>(other.size());
            QVERIFY2(least > 0.5 && mean > 0.7 && otherMean < 0.62,
                     qPrintable(QString("%1: %2 %3 %4").arg(count).arg(least).arg(mean).arg(otherMean)));
        }
    }

    void theDensityIsKept_data() {
        QTest::addColumn<int>("paint");
        QTest::newRow("white") << static_cast<int>(Paint::White);
        QTest::newRow("noise") << static_cast<int>(Paint::Noise);
        QTest::newRow("ramp") << static_cast<int>(Paint::Ramp);
        QTest::newRow("checks") << static_cast<int>(Paint::Checks);
    }
    void theDensityIsKept() {
        QFETCH(int, paint);
        const Groom groom = evenGroom(testing::sphere(30, 40), painted(static_cast<Paint>(paint), 128));
        const RootSampler sampler = samplerOf(groom);
        testing::FineBins bins(groom);
        const std::vector<HairRoot> roots = rootsOf(groom, sampler, 100000.0);
        QVERIFY2(std::abs(static_cast<double>(roots.size()) - 100000.0) < 1000.0,
                 qPrintable(QString::number(roots.size())));
        const DensityLookup density(groom);
        for (const HairRoot& root : roots) {
            bins.add(root.point);
            QVERIFY(density.at(root.point.triangle, root.uv) > 0.0f);
        }
        QVERIFY2(bins.chiSquareExcess() < 4.5, qPrintable(QString::number(bins.chiSquareExcess())));
    }

    void countsVaryLittle() {
        // Boxes of 32 on a plane: variance over mean, for several beginnings.
        const Groom groom = evenGroom(testing::plane(12), Map(8, 8, 1, TexelFormat::U8, 1.0f));
        const RootSampler sampler = samplerOf(groom);
        for (const double count : {2048.0, 3000.0, 8192.0, 20000.0}) {
            const int cells = static_cast<int>(std::lround(std::sqrt(count / 32.0)));
            std::vector<double> boxes(static_cast<std::size_t>(cells * cells), 0.0);
            const std::vector<HairRoot> roots = rootsOf(groom, sampler, count);
            for (const HairRoot& root : roots) {
                const auto cell = [&](float x) {
                    return std::clamp(static_cast<int>(x * static_cast<float>(cells)), 0, cells - 1);
                };
                boxes[static_cast<std::size_t>(cell(root.uv.y) * cells + cell(root.uv.x))] += 1.0;
            }
            double mean = static_cast<double>(roots.size()) / static_cast<double>(boxes.size()), squares = 0.0;
            for (const double n : boxes) squares += (n - mean) * (n - mean);
            const double spread = squares / static_cast<double>(boxes.size()) / mean;
            QVERIFY2(spread <= 0.25, qPrintable(QString("%1: %2").arg(count).arg(spread)));
        }
    }

    void fewerAreASubsetAndPartsAreAPartition() {
        const Groom groom = evenGroom(testing::sphere(20, 30), painted(Paint::Ramp, 128));
        const RootSampler sampler = samplerOf(groom);
        const auto ids = [](const std::vector<HairRoot>& roots) {
            std::map<std::uint32_t, SurfacePoint> places;
            for (const HairRoot& root : roots) places[root.id] = root.point;
            return places;
        };
        const auto all = ids(rootsOf(groom, sampler, 9000.0));
        for (const double count : {8999.0, 3000.0, 100.0}) {
            for (const auto& [id, point] : ids(rootsOf(groom, samplerOf(groom), count))) {
                QVERIFY(all.contains(id) && all.at(id) == point);
                QVERIFY((id & evenId) != 0 && sampler.candidate(1, id).point == point);
            }
        }
        Progress progress;
        const RootSource source{*groom.mesh, sampler, DensityLookup(groom), {9000.0 / sampler.weight(), 1}};
        std::size_t sum = 0;
        std::uint32_t unit = 0;
        for (std::uint32_t part = 0; part < 7; ++part) {
            for (const HairRoot& root : makeRoots(source, sampler.part(part, 7), progress)) {
                QVERIFY(all.contains(root.id) && root.unit >= unit);
                unit = root.unit;
                ++sum;
            }
        }
        QCOMPARE(sum, all.size());
    }

    void theSequenceIsTheSameHoweverItIsMade() {
        const Groom groom = evenGroom(testing::sphere(20, 30), painted(Paint::White, 8));
        const RootSampler sampler = samplerOf(groom);
        Progress progress;
        const EvenSequence reference(*groom.mesh, sampler.curve(), 3, 5000, true, progress);
        QCOMPARE(reference.count(), 5000u);
        for (const unsigned threads : {1u, 2u}) {
            const ThreadLimit limit(threads);
            const EvenSequence longer(*groom.mesh, sampler.curve(), 3, 7000, false, progress);
            QCOMPARE(longer.count(), 7000u);
            std::size_t at = 0;
            for (const EvenSequence::Place& place : longer.places()) {
                if (place.rank >= 5000) continue;
                const EvenSequence::Place& same = reference.places()[at++];
                QVERIFY(place.rank == same.rank && place.unit == same.unit && place.share == same.share);
            }
            QCOMPARE(at, std::size_t{5000});
        }
        EvenSequences kept(groom.mesh.share(), std::make_shared<const SurfaceCurve>(sampler.curve()));
        const auto first = kept.get(3, 1000, false, progress);
        QVERIFY(kept.get(3, 1100, false, progress) == first && kept.get(3, 4000, false, progress) != first);
        progress.cancel();
        QVERIFY(kept.get(9, 100000, false, progress)->count() < 100000);
    }

    void groupsChooseForThemselves() {
        Groom groom = testing::groomOn(testing::sphere(24, 40), 100, 5);
        std::vector<Group>& groups = groom.groups.edit();
        groups.push_back(groups[0]);
        groups[1].name = "even";
        groups[1].params.general.even = true;
        Map numbers(64, 64, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 64; ++y)
            for (int x = 32; x < 64; ++x) numbers.setTexel(x, y, 0, 1.0f / 255.0f);
        groom.maps.set("numbers", numbers);
        groom.counts.edit().groupMap.name = "numbers";
        for (std::size_t i = 0; i < groom.guides.count(); ++i)
            groom.guides.setGroup(i, static_cast<std::uint8_t>(i % 2));
        groom.counts.edit().hairs = 6000;
        Progress progress;
        Generator generator;
        const Strands mixed = *generator.generate(groom, {}, progress);
        std::set<std::uint32_t> ids(mixed.ids.begin(), mixed.ids.end());
        QCOMPARE(ids.size(), mixed.count());
        std::size_t even = 0;
        for (std::size_t i = 0; i < mixed.count(); ++i) {
            QCOMPARE((mixed.ids[i] & evenId) != 0, mixed.groups[i] == 1);
            even += mixed.groups[i];
        }
        QVERIFY2(std::abs(static_cast<double>(mixed.count()) - 6000.0) < 60.0 &&
                     std::abs(static_cast<double>(even) - 3000.0) < 90.0,
                 qPrintable(QString("%1 %2").arg(mixed.count()).arg(even)));
        // The same for any split.
        const std::uint64_t whole = *hairDigest(groom, 1, std::nullopt, progress);
        for (const std::uint32_t parts : {2u, 5u}) QCOMPARE(*hairDigest(groom, parts, std::nullopt, progress), whole);
        // All even: as many as asked for.
        groom.groups.edit()[0].params.general.even = true;
        QCOMPARE(generator.generate(groom, {}, progress)->count(), std::size_t{6000});
        // Back: the hair of before.
        groom.groups.edit()[0].params.general.even = false;
        QVERIFY(generator.generate(groom, {}, progress)->positions == mixed.positions);
    }

    void paintMovesNothingElsewhere() {
        Groom before = evenGroom(testing::sphere(24, 40), painted(Paint::Ramp, 128));
        before.counts.edit().hairs = 20000;
        before.counts.edit().densityTotal = densityTotalOf(before);
        Groom after = before;
        for (int y = 30; y < 60; ++y)
            for (int x = 40; x < 70; ++x) after.maps.edit("density")->setTexel(x, y, 0, y < 45 ? 1.0f : 0.0f);
        const RootSampler a = samplerOf(before), b = samplerOf(after);
        Progress progress;
        const auto outside = [&](const Groom& groom, const RootSampler& sampler) {
            std::map<std::uint32_t, SurfacePoint> places;
            const RootRequest request = requestFor(*groom.counts, sampler, 20000.0);
            for (const HairRoot& root :
                 makeRoots({*groom.mesh, sampler, DensityLookup(groom), request}, {}, progress)) {
                const glm::vec2 texel(root.uv.x * 128.0f, (1.0f - root.uv.y) * 128.0f);
                if (texel.x < 38.0f || texel.x > 72.0f || texel.y < 28.0f || texel.y > 62.0f)
                    places[root.id] = root.point;
            }
            return places;
        };
        const auto all = outside(before, a);
        QVERIFY(all.size() > 10000 && all == outside(after, b));
    }
};

QTEST_APPLESS_MAIN(EvenSequenceTest)
#include "even_sequence_test.moc"
