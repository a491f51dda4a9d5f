// SPDX-License-Identifier: Apache-2.0
// Asked against placed roots: sums, agreement of the sampler with what it is asked for, what smoothing keeps.
#include "core/sampling/heat_map.h"

#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <numeric>

using namespace whorl;

namespace {

double sum(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Hair on the left half only, twice as dense at the bottom.
Groom halfPlane(int cells) {
    Groom groom = makeGroom(testing::plane(cells));
    Map map(64, 64, 1, TexelFormat::U16, 0.0f);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 32; ++x) map.setTexel(x, y, 0, y < 32 ? 0.5f : 1.0f);
    }
    groom.maps.set("density", std::move(map));
    groom.groups.edit()[0].params.general.density.map = "density";
    return groom;
}

RootSampler samplerOf(const Groom& groom) {
    Progress progress;
    return *RootSampler::build(groom, DensityLookup(groom), progress);
}

// As hair grows, `count` of them.
std::vector<SurfacePoint> rootsOf(const RootSampler& sampler, std::size_t count) {
    RootList list;
    sampler.sample({1.2 * static_cast<double>(count) / sampler.weight(), 1}, {}, list);
    std::vector<std::size_t> places(list.count());
    std::iota(places.begin(), places.end(), 0u);
    std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
        // The order in which more roots come.
        const auto rank = [&](std::size_t i) {
            return list.id(i) / sampler.densityOf(sampler.candidate(1, list.id(i)).code);
        };
        return rank(a) < rank(b);
    });
    std::vector<SurfacePoint> roots;
    for (std::size_t i = 0; i < count; ++i) roots.push_back(list.point(places[i]));
    return roots;
}

}  // namespace

class HeatMapTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sumsAreTheRoots() {
        const Groom groom = halfPlane(8);
        const RootSampler sampler = samplerOf(groom);
        Progress progress;
        for (const int passes : {0, 1, 7}) {
            const Result<HeatMap> heat = heatMap(*groom.mesh, sampler, rootsOf(sampler, 5000), passes, progress);
            QVERIFY(heat.ok());
            QCOMPARE(heat->asked.size(), std::size_t{groom.mesh->triangleCount()});
            QVERIFY(std::abs(sum(heat->asked) - 5000.0) < 0.5);
            QVERIFY(std::abs(sum(heat->placed) - 5000.0) < 0.5);
        }
    }

    void theSamplerPlacesWhatIsAsked() {
        const Groom groom = halfPlane(8);
        const RootSampler sampler = samplerOf(groom);
        Progress progress;
        const Result<HeatMap> heat = heatMap(*groom.mesh, sampler, rootsOf(sampler, 20000), 1, progress);
        QVERIFY(heat.ok());
        for (std::size_t i = 0; i < heat->asked.size(); ++i) {
            if (heat->asked[i] < 50.0f) continue;
            QVERIFY(std::abs(heat->placed[i] / heat->asked[i] - 1.0f) < 0.15f);
        }
    }

    void askedIsWhatTheDensityAsks() {
        // Against the density itself. Pieces are a texel wide: the edges of the paint are half a texel uncertain.
        const Groom groom = halfPlane(8);
        const RootSampler sampler = samplerOf(groom);
        const DensityLookup density(groom);
        const std::vector<double> shares = sampler.sharesByTriangle(groom.mesh->triangleCount());
        std::vector<double> expected(shares.size(), 0.0);
        double total = 0.0;
        for (std::uint32_t t = 0; t < shares.size(); ++t) {
            constexpr int n = 60;
            for (int i = 0; i < n; ++i) {
                for (int j = 0; i + j < n; ++j) {
                    const float u = (static_cast<float>(i) + 0.33f) / n, v = (static_cast<float>(j) + 0.33f) / n;
                    expected[t] += static_cast<double>(density.at(t, uvAt(*groom.mesh, {t, u, v})));
                }
            }
            total += expected[t];
        }
        for (std::size_t t = 0; t < shares.size(); ++t)
            QVERIFY2(std::abs(shares[t] - expected[t] / total) <
                         0.05 / static_cast<double>(shares.size()) + 0.03 * shares[t],
                     qPrintable(QString("%1: %2 %3").arg(t).arg(shares[t]).arg(expected[t] / total)));
    }

    void rootsInTheWrongPlaceShow() {
        const Groom groom = halfPlane(8);
        const RootSampler sampler = samplerOf(groom);
        // All roots on the triangle that is asked for least and has something to ask for.
        Progress progress;
        std::vector<SurfacePoint> roots = rootsOf(sampler, 2000);
        const HeatMap right = *heatMap(*groom.mesh, sampler, roots, 0, progress);
        std::uint32_t poor = 0;
        for (std::uint32_t i = 0; i < right.asked.size(); ++i) {
            if (right.asked[i] > 0.0f && (right.asked[poor] <= 0.0f || right.asked[i] < right.asked[poor])) poor = i;
        }
        for (SurfacePoint& root : roots) root.triangle = poor;
        const HeatMap wrong = *heatMap(*groom.mesh, sampler, roots, 0, progress);
        QCOMPARE(wrong.placed[poor], 2000.0f);
        for (std::size_t i = 0; i < wrong.asked.size(); ++i) {
            const glm::vec3 colour = heatColour(wrong.asked[i], wrong.placed[i]);
            if (i == poor) {
                QVERIFY(colour.x > 2 * colour.z);
            } else if (wrong.asked[i] > 1.0f) {
                QVERIFY(colour.z > 2 * colour.x);
            }
        }
    }

    void smoothingSpreadsToNeighbours() {
        const Groom groom = makeGroom(testing::plane(6));
        const RootSampler sampler = samplerOf(groom);
        const std::vector<SurfacePoint> roots(600, SurfacePoint{30, 0.3f, 0.3f});
        Progress progress;
        const HeatMap none = *heatMap(*groom.mesh, sampler, roots, 0, progress);
        const HeatMap one = *heatMap(*groom.mesh, sampler, roots, 1, progress);
        QCOMPARE(none.placed[30], 600.0f);
        int others = 0;
        for (std::size_t i = 0; i < one.placed.size(); ++i) others += i != 30 && one.placed[i] > 0.0f;
        QVERIFY(others >= 1 && others <= 3);
        QVERIFY(std::abs(one.placed[30] - 600.0f * (0.5f + static_cast<float>(3 - others) / 6.0f)) < 0.1f);
    }

    void oddInputs() {
        const Groom groom = makeGroom(testing::plane(2));
        const RootSampler sampler = samplerOf(groom);
        Progress progress;
        const HeatMap empty = *heatMap(*groom.mesh, sampler, {}, 3, progress);
        QCOMPARE(sum(empty.placed), 0.0);
        QCOMPARE(sum(empty.asked), 0.0);
        const std::vector<SurfacePoint> outside{SurfacePoint{4000, 0.0f, 0.0f}};
        QCOMPARE(sum(heatMap(*groom.mesh, sampler, outside, 1, progress)->placed), 0.0);
        Progress stopped;
        stopped.cancel();
        const Result<HeatMap> cancelled = heatMap(*groom.mesh, sampler, {}, 1, stopped);
        QVERIFY(!cancelled.ok());
        QVERIFY(cancelled.error().cancelled);
        QCOMPARE(heatColour(0, 0), glm::vec3(0.18f));
        QCOMPARE(heatColour(5, 5), glm::vec3(0.85f));
    }
};

QTEST_GUILESS_MAIN(HeatMapTest)
#include "heat_map_test.moc"
