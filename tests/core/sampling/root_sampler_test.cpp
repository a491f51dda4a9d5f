// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/root_sampler.h"

#include "core/base/parallel.h"
#include "core/base/simd.h"
#include "core/hair/roots.h"
#include "core/sampling/density_total.h"
#include "core/surface/surface_point.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

using namespace whorl;
using testing::densityGroom;
using testing::Paint;
using testing::painted;
using testing::samplerOf;

namespace {

struct Root {
    std::uint32_t id;
    SurfacePoint point;
    bool operator==(const Root&) const = default;
};

std::vector<Root> rootsOf(const RootSampler& sampler, RootRequest request, RootRange range = {}) {
    RootList list;
    sampler.sample(request, range, list);
    std::vector<Root> roots;
    for (std::size_t i = 0; i < list.count(); ++i) roots.push_back({list.id(i), list.point(i)});
    return roots;
}

std::vector<Root> hairs(const RootSampler& sampler, double count, std::uint32_t seed = 1) {
    return rootsOf(sampler, {count / sampler.weight(), seed});
}

std::vector<Root> byId(std::vector<Root> roots) {
    std::sort(roots.begin(), roots.end(), [](const Root& a, const Root& b) { return a.id < b.id; });
    return roots;
}

// The plane's square in cells x cells boxes: variance of the count over mean, averaged over the boxes, over 12 seeds.
double spreadOfCounts(const Groom& groom, const RootSampler& sampler, double count, int cells) {
    constexpr int seeds = 12;
    std::vector<std::array<double, seeds>> found(static_cast<std::size_t>(cells * cells));
    for (auto& of : found) of.fill(0.0);
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        for (const Root& root : hairs(sampler, count, seed + 1)) {
            const glm::vec2 uv = uvAt(*groom.mesh, root.point);
            const auto cell = [&](float x) {
                return std::clamp(static_cast<int>(x * static_cast<float>(cells)), 0, cells - 1);
            };
            found[static_cast<std::size_t>(cell(uv.y) * cells + cell(uv.x))][seed] += 1.0;
        }
    }
    double sum = 0.0;
    int boxes = 0;
    for (const auto& of : found) {
        double mean = 0.0, squares = 0.0;
        for (const double n : of) mean += n / seeds;
        for (const double n : of) squares += (n - mean) * (n - mean) / (seeds - 1);
        if (mean < 8.0) continue;
        sum += squares / mean;
        ++boxes;
    }
    return sum / boxes;
}

}  // namespace

class RootSamplerTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void anyAlignedRunHasOneCandidateAStratum() {
        for (const std::uint32_t seed : {0u, 1u, 77u}) {
            const CandidateKeys keys = candidateKeys(seed);
            for (const unsigned level : {1u, 4u, 9u, 13u}) {
                for (const std::uint32_t run : {0u, 1u, 5u}) {
                    std::vector<bool> seen(std::size_t{1} << level, false);
                    for (std::uint32_t i = 0; i < (1u << level); ++i) {
                        const std::uint32_t stratum = unitOf(stratumOf(keys, (run << level) + i)) >> (32u - level);
                        QVERIFY(!seen[stratum]);
                        seen[stratum] = true;
                    }
                }
            }
            for (std::uint32_t i = 0; i < 100000; ++i) {
                const std::uint32_t any = i * 2654435761u;
                QCOMPARE(candidateIn(keys, stratumOf(keys, any)), any);
            }
        }
    }

    void theCurveInATriangleIsUnbrokenAndFillsIt() {
        // Cells of depth 7: each is entered where the one before was left.
        std::set<std::pair<int, int>> cells;
        std::int32_t endU = 0, endV = 0;
        for (std::uint32_t cell = 0; cell < (1u << 14); ++cell) {
            std::int32_t u = 0, v = 0;
            placeInTriangle(cell << 18, u, v);
            QVERIFY(u > 0 && v > 0 && u + v < 196608);
            if (cell > 0) QVERIFY(std::abs(u - endU) <= 4 && std::abs(v - endV) <= 4);
            placeInTriangle(cell << 18 | 0x3ffffu, endU, endV);
            // The middle names the piece.
            placeInTriangle(cell << 18 | 0xaaaaaaaau >> 14, u, v);
            QVERIFY(cells.insert({u, v}).second);
        }
        QVERIFY(endU < 8 && endV > 196600);
    }

    void theSweepFindsWhatPlainArithmeticSays() {
        for (const Paint paint : {Paint::White, Paint::Noise, Paint::Blot}) {
            const Groom groom = densityGroom(testing::sphere(9, 14), painted(paint, 64));
            const RootSampler sampler = samplerOf(groom);
            for (const double count : {1.0, 30.0, 2000.0, 50000.0}) {
                const RootRequest request{count / sampler.weight(), 3};
                std::vector<Root> expected;
                const std::uint32_t most = sampler.limitOf(255, request.rate);
                for (std::uint32_t i = 0; i < most; ++i) {
                    const RootSampler::Candidate candidate = sampler.candidate(3, i);
                    if (i < sampler.limitOf(candidate.code, request.rate)) expected.push_back({i, candidate.point});
                }
                const std::vector<Root> roots = rootsOf(sampler, request);
                QVERIFY(byId(roots) == expected);
                std::uint32_t before = 0;
                for (const Root& root : roots) {
                    QVERIFY(sampler.candidate(3, root.id).unit >= before);
                    before = sampler.candidate(3, root.id).unit;
                }
            }
        }
    }

    void rootsFollowTheDensity_data() {
        QTest::addColumn<int>("paint");
        QTest::newRow("white") << static_cast<int>(Paint::White);
        QTest::newRow("noise") << static_cast<int>(Paint::Noise);
        QTest::newRow("ramp") << static_cast<int>(Paint::Ramp);
        QTest::newRow("checks") << static_cast<int>(Paint::Checks);
    }
    void rootsFollowTheDensity() {
        QFETCH(int, paint);
        const Groom groom = densityGroom(testing::sphere(30, 40), painted(static_cast<Paint>(paint), 128));
        const RootSampler sampler = samplerOf(groom);
        testing::FineBins bins(groom);
        // One byte a piece: a two-hundredth of what the density is.
        QVERIFY(std::abs(sampler.weight() * [&] {
                    double area = 0.0;
                    for (std::uint32_t t = 0; t < groom.mesh->triangleCount(); ++t)
                        area += triangleArea(*groom.mesh, t);
                    return area;
                }() - bins.total()) < 5e-3 * bins.total());
        const std::vector<Root> roots = hairs(sampler, 400000.0);
        QVERIFY(std::abs(static_cast<double>(roots.size()) - 400000.0) < 1500.0);
        for (const Root& root : roots) bins.add(root.point);
        // More even than chance, never less.
        QVERIFY2(bins.chiSquareExcess() < 4.5, qPrintable(QString::number(bins.chiSquareExcess())));
    }

    void countsVaryLessThanChance() {
        for (const Paint paint : {Paint::White, Paint::Ramp}) {
            const Groom groom = densityGroom(testing::plane(12), painted(paint, 64));
            const RootSampler sampler = samplerOf(groom);
            for (const double count : {1024.0, 4096.0, 16384.0, 65536.0}) {
                for (const double perBox : {16.0, 32.0, 64.0}) {
                    const double spread =
                        spreadOfCounts(groom, sampler, count, static_cast<int>(std::lround(std::sqrt(count / perBox))));
                    QVERIFY2(spread <= 0.25, qPrintable(QString("%1 of %2: %3").arg(perBox).arg(count).arg(spread)));
                }
            }
        }
        // Noise finer than hairs are apart stays chance in part.
        const Groom groom = densityGroom(testing::plane(12), painted(Paint::Noise, 256));
        const double spread = spreadOfCounts(groom, samplerOf(groom), 16384.0, 22);
        QVERIFY2(spread < 0.45, qPrintable(QString::number(spread)));
    }

    void fewerAreAnExactSubsetOfMore() {
        const Groom groom = densityGroom(testing::sphere(20, 30), painted(Paint::Noise, 128));
        const RootSampler sampler = samplerOf(groom);
        std::map<std::uint32_t, SurfacePoint> more;
        for (const Root& root : hairs(sampler, 40000.0)) more[root.id] = root.point;
        for (const double count : {39999.0, 20000.0, 5000.0, 625.0, 1.0, 0.0}) {
            std::map<std::uint32_t, SurfacePoint> fewer;
            for (const Root& root : hairs(sampler, count)) {
                const auto found = more.find(root.id);
                QVERIFY(found != more.end() && found->second == root.point);
                fewer[root.id] = root.point;
            }
            QVERIFY(fewer.size() <= more.size());
            more = fewer;
        }
    }

    void evenDensityGivesTheExactNumber() {
        for (const float density : {1.0f, 0.37f, 12.5f}) {
            Groom groom = makeGroom(testing::sphere(7, 9));
            groom.groups.edit()[0].params.general.density.value = density;
            const RootSampler sampler = samplerOf(groom);
            for (const int count : {0, 1, 2, 17, 1000, 99999}) {
                groom.counts.edit().seed = count;
                groom.counts.edit().hairs = count;
                const RootRequest request = requestFor(*groom.counts, sampler, count);
                QCOMPARE(rootsOf(sampler, request).size(), static_cast<std::size_t>(count));
            }
        }
    }

    void theNumberIsExactWhereItIsCounted() {
        for (const Paint paint : {Paint::Noise, Paint::Ramp, Paint::Checks, Paint::Blot}) {
            Groom groom = densityGroom(testing::sphere(20, 30), painted(paint, 128));
            const RootSampler sampler = samplerOf(groom);
            std::vector<Root> fewer;
            for (const int count : {0, 1, 2, 5, 100, 2500, 10000, 60000}) {
                groom.counts.edit().hairs = count;
                const std::vector<Root> roots = byId(rootsOf(sampler, requestFor(*groom.counts, sampler, count)));
                QVERIFY2(std::abs(static_cast<int>(roots.size()) - count) <= (count > 100 ? 1 : 0),
                         qPrintable(QString("%1 of %2").arg(roots.size()).arg(count)));
                QVERIFY(std::includes(roots.begin(), roots.end(), fewer.begin(), fewer.end(),
                                      [](const Root& a, const Root& b) { return a.id < b.id; }));
                fewer = roots;
            }
            // Pinned it stays the same, for any number of shown ones.
            const std::vector<double> shown{0.0, 1.0, 7.0, 300.0, 9999.0, 60000.0, 80000.0};
            std::vector<std::vector<Root>> before;
            for (const double some : shown)
                before.push_back(rootsOf(sampler, requestFor(*groom.counts, sampler, some)));
            QVERIFY(byId(before[5]) == fewer);
            groom.counts.edit().densityTotal = densityTotalOf(groom);
            for (std::size_t i = 0; i < shown.size(); ++i)
                QVERIFY(rootsOf(sampler, requestFor(*groom.counts, sampler, shown[i])) == before[i]);
        }
    }

    void aDabMovesNothingOutside() {
        for (const TexelFormat format : {TexelFormat::U8, TexelFormat::U16, TexelFormat::F32}) {
            // Triangles far larger than the dab: the same triangle is inside and outside.
            Map map(256, 256, 1, format, 0.4f);
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 256; ++x)
                    map.setTexel(x, y, 0,
                                 painted(Paint::Noise, 1).texel(0, 0) * 0.1f + 0.3f +
                                     0.001f * static_cast<float>((x * 7 + y * 13) % 97));
            Groom before = densityGroom(testing::plane(2), map);
            before.counts.edit().hairs = 30000;
            for (const float paint : {0.0f, 1.0f}) {
                Groom after = before;
                const auto inside = [](glm::vec2 uv) {
                    return std::abs(uv.x * 256.0f - 100.0f) < 22.0f && std::abs((1.0f - uv.y) * 256.0f - 90.0f) < 22.0f;
                };
                for (int y = 70; y < 110; ++y)
                    for (int x = 80; x < 120; ++x) after.maps.edit("density")->setTexel(x, y, 0, paint);
                after.counts.edit().densityTotal = densityTotalOf(before);
                const RootSampler a = samplerOf(before), b = samplerOf(after);
                const auto outside = [&](const Groom& groom, const RootSampler& sampler) {
                    std::vector<Root> roots = rootsOf(sampler, requestFor(*groom.counts, sampler, 30000.0));
                    std::erase_if(roots, [&](const Root& root) { return inside(uvAt(*groom.mesh, root.point)); });
                    return roots;
                };
                const std::vector<Root> all = outside(before, a);
                QVERIFY(all.size() > 20000);
                QVERIFY(all == outside(after, b));
                QVERIFY(rootsOf(a, requestFor(*before.counts, a, 30000.0)).size() !=
                        rootsOf(b, requestFor(*after.counts, b, 30000.0)).size());
            }
        }
    }

    void nothingGrowsInTheBlack() {
        QVERIFY(samplerOf(densityGroom(testing::plane(2), Map(8, 8, 1, TexelFormat::U8, 0.0f))).empty());
        QVERIFY(samplerOf(densityGroom(testing::plane(2), Map(8, 8, 1, TexelFormat::F32, -1.0f))).empty());
        QVERIFY(samplerOf(densityGroom(testing::plane(2), Map(8, 8, 1, TexelFormat::F32, std::nanf("")))).empty());
        QVERIFY(samplerOf(makeGroom(SurfaceMesh{})).empty());
        Groom closed = makeGroom(testing::plane(2));
        closed.partSettings.edit()[0].growsHair = false;
        QVERIFY(samplerOf(closed).empty());
        const Groom groom = densityGroom(testing::sphere(20, 30), painted(Paint::Blot, 256));
        const RootSampler sampler = samplerOf(groom);
        const DensityLookup density(groom);
        const std::vector<Root> roots = hairs(sampler, 50000.0);
        QVERIFY(roots.size() > 45000);
        std::size_t dark = 0;
        for (const Root& root : roots) {
            QVERIFY(sampler.candidate(1, root.id).code > 0);
            dark += density.growsAt(*groom.mesh, root.point) ? 0 : 1;
        }
        // Only pieces at the edge have texels without hair in them; the generator leaves those roots out.
        QVERIFY(dark < 500);
        Progress progress;
        const RootSource source{*groom.mesh, sampler, density, {50000.0 / sampler.weight(), 1}};
        for (const HairRoot& root : makeRoots(source, {}, progress))
            QVERIFY(density.at(root.point.triangle, root.uv) > 0.0f);
        // Paint so thin that a byte would round it away still grows.
        const RootSampler thin = samplerOf(densityGroom(testing::plane(2), Map(8, 8, 1, TexelFormat::F32, 1e-7f)));
        QVERIFY(!thin.empty() && hairs(thin, 1000.0).size() == 1000);
    }

    void rootsStayOnTheirTriangles() {
        for (const float size : {1e-12f, 1e-3f, 1e6f, 1e15f, 1e30f}) {
            const Groom groom = densityGroom(testing::plane(2, size), painted(Paint::Noise, 32));
            const std::vector<Root> roots = hairs(samplerOf(groom), 5000.0);
            QVERIFY(roots.size() > 4800);
            for (const Root& root : roots) {
                const SurfacePoint& p = root.point;
                QVERIFY(p.triangle < 8 && p.u >= 0.0f && p.v >= 0.0f && p.u + p.v <= 1.0f);
            }
        }
    }

    void sameBytesOnEveryLevelThreadAndSplit() {
        const Groom groom = densityGroom(testing::sphere(25, 40), painted(Paint::Noise, 256));
        setSimdLevel(SimdLevel::Plain);
        const RootSampler plain = samplerOf(groom);
        const std::vector<Root> expected = hairs(plain, 30000.0);
        for (const SimdLevel level : {SimdLevel::Avx2, SimdLevel::Avx512}) {
            setSimdLevel(level);
            const ThreadLimit limit(level == SimdLevel::Avx2 ? 1 : 2);
            const RootSampler sampler = samplerOf(groom);
            QCOMPARE(sampler.weight(), plain.weight());
            QVERIFY(hairs(sampler, 30000.0) == expected);
        }
        setSimdLevel(bestSimdLevel());
        for (const std::uint32_t parts : {2u, 3u, 17u, 1000u}) {
            std::vector<Root> all;
            std::uint32_t next = 0;
            for (std::uint32_t part = 0; part < parts; ++part) {
                const RootRange range = plain.part(part, parts);
                QCOMPARE(range.first, next);
                next = range.last;
                const auto some = rootsOf(plain, {30000.0 / plain.weight(), 1}, range);
                // Within five standard deviations of chance, of which there is less.
                const double share = 30000.0 / parts;
                QVERIFY(std::abs(static_cast<double>(some.size()) - share) < 5.0 * std::sqrt(share));
                all.insert(all.end(), some.begin(), some.end());
            }
            QCOMPARE(next, SurfaceCurve::end);
            QVERIFY(all == expected);
        }
    }

    void aLargeFloorLeavesTheHeadItsHair() {
        SurfaceMesh mesh = testing::sphere(12, 20);
        const std::uint32_t head = mesh.triangleCount();
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : {glm::vec3(-100, 0, -100), glm::vec3(100, 0, -100), glm::vec3(0, 0, 100)}) {
            mesh.positions.push_back(p);
            mesh.normals.emplace_back(0, 1, 0);
            mesh.cornerUvs.emplace_back(0.0f, 0.0f);
        }
        mesh.triangles.emplace_back(first, first + 2, first + 1);
        mesh.parts = {{"head", 0, head}, {"floor", head, 1}};
        Groom groom = makeGroom(std::move(mesh));
        groom.partSettings.edit()[1].growsHair = false;
        const std::vector<Root> roots = hairs(samplerOf(groom), 100000.0);
        QCOMPARE(roots.size(), std::size_t{100000});
        for (const Root& root : roots) QVERIFY(root.point.triangle < head);
    }

    void aPartThatGrowsNothingChangesNoOther() {
        SurfaceMesh mesh = testing::plane(4);
        mesh.parts = {{"skin", 0, 20}, {"eyes", 20, 12}};
        Groom groom = makeGroom(std::move(mesh));
        const RootRequest request{4000.0, 1};
        std::vector<Root> all = rootsOf(samplerOf(groom), request);
        groom.partSettings.edit()[1].growsHair = false;
        std::erase_if(all, [](const Root& root) { return root.point.triangle >= 20; });
        QVERIFY(rootsOf(samplerOf(groom), request) == all);
    }

    void cancelledWorkSaysSo() {
        Progress progress;
        progress.cancel();
        const Groom groom = densityGroom(testing::plane(4), painted(Paint::Noise, 64));
        const auto sampler = RootSampler::build(groom, DensityLookup(groom), progress);
        QVERIFY(!sampler.ok() && sampler.error().cancelled);
    }
};

QTEST_APPLESS_MAIN(RootSamplerTest)
#include "root_sampler_test.moc"
