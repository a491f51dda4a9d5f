// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/sub_triangle_sampler.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/sub_triangle_positions.h"
#include "core/surface/surface_point.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

using namespace whorl;
using testing::chiSquareExcess;
using testing::FineBins;
using testing::Paint;
using testing::painted;

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// Triangles of very different sizes; UVs that repeat and are mirrored.
SurfaceMesh uneven() {
    SurfaceMesh mesh = testing::plane(4);
    for (glm::vec3& p : mesh.positions) {
        p.x = std::pow(p.x + 0.6f, 4.0f);
        p.y = 0.3f * p.x * p.z;
    }
    for (glm::vec2& uv : mesh.cornerUvs) uv = glm::vec2(1.0f - 2.3f * uv.x, 0.7f * uv.y - 0.2f * uv.x);
    return mesh;
}

Groom groomWith(SurfaceMesh mesh, Map map) {
    Groom groom = makeGroom(std::move(mesh));
    groom.maps.set("density", std::move(map));
    groom.groups.edit()[0].params.general.density = {1.0f, "density"};
    return groom;
}

SubTriangleSampler build(const Groom& groom, const SubTriangleSampler::Options& options = {}) {
    Progress progress;
    const DensityLookup density(groom);
    auto sampler = SubTriangleSampler::build(*groom.mesh, density, options, progress);
    if (!sampler) qFatal("not built");
    return std::move(*sampler);
}

bool sameBytes(const SubTriangleSampler& a, const SubTriangleSampler& b) {
    return a.subTriangles().size() == b.subTriangles().size() &&
           std::memcmp(a.subTriangles().data(), b.subTriangles().data(), a.subTriangles().size_bytes()) == 0;
}

}  // namespace

class SubTriangleSamplerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void rootsFollowAreaTimesDensity_data() {
        QTest::addColumn<int>("shape");
        QTest::addColumn<int>("paint");
        for (int shape = 0; shape < 3; ++shape) {
            for (int paint = 0; paint < 5; ++paint) QTest::addRow("shape %d, paint %d", shape, paint) << shape << paint;
        }
    }

    // The law of the paper. Bins and what belongs into each come from the mesh and the map alone.
    void rootsFollowAreaTimesDensity() {
        QFETCH(int, shape);
        QFETCH(int, paint);
        const Groom groom = groomWith(shape == 0   ? testing::plane(3)
                                      : shape == 1 ? testing::sphere(12, 17)
                                                   : uneven(),
                                      painted(static_cast<Paint>(paint), 64));
        const SubTriangleSampler sampler = build(groom);
        FineBins bins(groom);
        QVERIFY(std::abs(sampler.total() - bins.total()) < 1e-5 * bins.total());
        const std::uint64_t count = 500000;
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t inside = randomBits(5, i, 1);
            bins.add(sampler.sample(unitDouble(randomBits(5, i, 0)), unitFloat(inside), unitFloat(inside << 24)));
        }
        QCOMPARE(bins.foundWhereNothingGrows(), std::uint64_t{0});
        const double excess = bins.chiSquareExcess();
        QVERIFY2(std::abs(excess) < 4.5, qPrintable(QString::number(excess)));
    }

    void stratifiedRootsFollowItEvenCloser() {
        const Groom groom = groomWith(testing::sphere(12, 17), painted(Paint::Noise, 64));
        const SubTriangleSampler sampler = build(groom);
        // Any run of sub-triangles gets its share, but for the two strata that lie across its ends.
        const std::uint64_t count = 20000;
        FineBins bins(groom);
        for (std::uint64_t i = 0; i < count; ++i) bins.add(sampler.stratifiedRoot(i, count, 3));
        QCOMPARE(bins.foundWhereNothingGrows(), std::uint64_t{0});
        const std::size_t triangles = groom.mesh->triangles.size();
        std::vector<double> expected(triangles, 0.0);
        for (const auto& sub : sampler.subTriangles())
            expected[sub.triangle] += static_cast<double>(sub.weight) / sampler.total() * static_cast<double>(count);
        for (std::size_t t = 0; t < triangles; ++t)
            QVERIFY(std::abs(static_cast<double>(bins.foundOn(t)) - expected[t]) < 2.0);
    }

    void gridEqualsBisectionExactly() {
        for (const Paint paint : {Paint::White, Paint::Noise, Paint::Blot}) {
            const Groom groom = groomWith(testing::sphere(9, 13), painted(paint, 64));
            for (const float percent : {0.0f, 0.01f, 13.0f, 25.0f, 50.0f, 100.0f, 200.0f, 400.0f, 1e9f}) {
                const SubTriangleSampler sampler = build(groom, {.gridPercent = percent});
                const auto check = [&](double selection) {
                    const SurfacePoint a = sampler.sample(selection, 0.3f, 0.6f);
                    return a == sampler.sampleByBisection(selection, 0.3f, 0.6f);
                };
                for (std::uint64_t i = 0; i < 20000; ++i) QVERIFY(check(unitDouble(randomBits(6, i, 0))));
                // Right at the borders between sub-triangles, and a hair before and after.
                double sum = 0.0;
                for (const auto& sub : sampler.subTriangles()) {
                    sum += static_cast<double>(sub.weight);
                    const double at = sum / sampler.total();
                    for (const double selection : {std::nextafter(at, 0.0), at, std::nextafter(at, 2.0)})
                        if (selection < 1.0) QVERIFY(check(selection));
                }
                QVERIFY(check(0.0) && check(std::nextafter(1.0, 0.0)));
            }
        }
    }

    void mergingLeavesNoFourEqualSiblings() {
        const Groom groom = groomWith(testing::plane(2), painted(Paint::Checks, 64));
        const SubTriangleSampler sampler = build(groom);
        QVERIFY(sampler.subTriangles().size() < 64u * 64u * 2u);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<float>> siblings;
        for (const auto& sub : sampler.subTriangles()) {
            if (sub.position != wholeTriangle) siblings[{sub.triangle, sub.position / 4 - 1}].push_back(sub.weight);
        }
        for (const auto& [parent, weights] : siblings) {
            if (weights.size() == 4) QVERIFY(std::set<float>(weights.begin(), weights.end()).size() > 1);
        }
        // A constant map needs no subdivision at all.
        const Groom plain = groomWith(testing::plane(2), Map(512, 512, 1, TexelFormat::U8, 1.0f));
        const SubTriangleSampler whole = build(plain);
        QCOMPARE(whole.subTriangles().size(), std::size_t{8});
        for (const auto& sub : whole.subTriangles()) {
            QCOMPARE(sub.position, wholeTriangle);
            QCOMPARE(sub.weight, 0.125f);
        }
    }

    void positionTableIsThePapers() {
        static_assert(sizeof(SubTriangleSampler::SubTriangle) == 12);
        QCOMPARE(childPosition(wholeTriangle, 3), 3u);
        QCOMPARE(childPosition(0, 0), 4u);
        QCOMPARE(childPosition(3, 3), 19u);
        QCOMPARE(childPosition(4, 2), 22u);
        QCOMPARE(depthOfPosition(wholeTriangle), 0);
        QCOMPARE(depthOfPosition(3), 1);
        QCOMPARE(depthOfPosition(4), 2);
        QCOMPARE(depthOfPosition(20), 3);
        const auto& table = subTrianglePlaces(6);
        QCOMPARE(table.size(), std::size_t{4 + 16 + 64 + 256 + 1024 + 4096});
        std::vector<double> areaOfDepth(7, 0.0);
        for (std::uint32_t i = 0; i < table.size(); ++i) {
            areaOfDepth[static_cast<std::size_t>(depthOfPosition(i))] +=
                static_cast<double>(table[i].size) * static_cast<double>(table[i].size);
            QVERIFY(table[i].u >= 0.0f && table[i].v >= 0.0f && table[i].u + table[i].v <= 1.0f);
            if (childPosition(i, 3) >= table.size()) continue;
            for (unsigned j = 0; j < 4; ++j) {
                const SubTrianglePlace child = table[childPosition(i, j)];
                QVERIFY(child.u == table[i].child(j).u && child.v == table[i].child(j).v);
                QCOMPARE(std::abs(child.size), 0.5f * std::abs(table[i].size));
            }
        }
        for (std::size_t depth = 1; depth <= 6; ++depth) QCOMPARE(areaOfDepth[depth], 1.0);
        // Tables of other depths are beginnings of it.
        QCOMPARE(std::memcmp(subTrianglePlaces(3).data(), table.data(), 84 * sizeof(SubTrianglePlace)), 0);
    }

    void atMostOneTexelASubTriangle() {
        const Groom groom = groomWith(testing::plane(2), painted(Paint::Noise, 64));
        // 512 texels a triangle: five subdivisions, none merged.
        QCOMPARE(build(groom).subTriangles().size(), std::size_t{8 * 1024});
        QCOMPARE(build(groom, {.maxDepth = 2}).subTriangles().size(), std::size_t{8 * 16});
        QCOMPARE(build(groom, {.maxSubTriangles = 600}).subTriangles().size(), std::size_t{8 * 64});
        QCOMPARE(build(groom, {.maxSubTriangles = 3}).subTriangles().size(), std::size_t{8});
    }

    void sameForAnyNumberOfThreads() {
        const Groom groom = groomWith(testing::sphere(40, 50), painted(Paint::Noise, 256));
        const SubTriangleSampler many = build(groom);
        const ThreadLimit one(1);
        QVERIFY(sameBytes(many, build(groom)));
    }

    void partsAreCompact() {
        const Groom groom = groomWith(testing::sphere(60, 80), painted(Paint::Noise, 128));
        const SubTriangleSampler sampler = build(groom);
        const std::uint64_t count = 16000;
        const std::uint64_t parts = 16;
        for (std::uint64_t part = 0; part < parts; ++part) {
            glm::vec3 mean(0.0f);
            std::vector<glm::vec3> places;
            for (std::uint64_t i = part * count / parts; i < (part + 1) * count / parts; ++i) {
                places.push_back(positionAt(*groom.mesh, sampler.stratifiedRoot(i, count, 1)));
                mean += places.back();
            }
            mean /= static_cast<float>(places.size());
            double spread = 0.0;
            for (const glm::vec3& p : places) spread += static_cast<double>(glm::dot(p - mean, p - mean));
            // The whole sphere has a root mean square of 0.1 (its radius); a sixteenth as a round patch has 0.035.
            QVERIFY(std::sqrt(spread / static_cast<double>(places.size())) < 0.06);
        }
    }

    void zeroDensityGrowsNothing() {
        QVERIFY(build(groomWith(testing::plane(2), Map(8, 8, 1, TexelFormat::U8, 0.0f))).empty());
        QVERIFY(build(groomWith(testing::plane(2), Map(8, 8, 1, TexelFormat::F32, -1.0f))).empty());
        QVERIFY(build(groomWith(testing::plane(2), Map(8, 8, 1, TexelFormat::F32, notANumber))).empty());
        QVERIFY(build(groomWith(testing::plane(2), Map(8, 8, 1, TexelFormat::F32, infinity))).empty());
        QVERIFY(build(makeGroom(SurfaceMesh{})).empty());
        Groom none = makeGroom(testing::plane(2));
        none.groups.edit()[0].params.general.density.value = 0.0f;
        QVERIFY(build(none).empty());
        Groom closed = makeGroom(testing::plane(2));
        closed.partSettings.edit()[0].growsHair = false;
        QVERIFY(build(closed).empty());
        const DensityLookup lookup(none);
        QVERIFY(rejectionSample(*none.mesh, lookup, 100, 1).empty());
    }

    void partsThatGrowNothingGetNothing() {
        SurfaceMesh mesh = testing::plane(4);
        mesh.parts = {{.name = "skin", .firstTriangle = 0, .triangleCount = 12},
                      {.name = "eyes", .firstTriangle = 12, .triangleCount = 8},
                      {.name = "neck", .firstTriangle = 20, .triangleCount = 12}};
        Groom groom = makeGroom(std::move(mesh));
        groom.partSettings.edit()[1].growsHair = false;
        const SubTriangleSampler sampler = build(groom);
        QVERIFY(std::abs(sampler.total() - 0.75) < 1e-6);
        for (std::uint64_t i = 0; i < 3000; ++i) {
            const std::uint32_t t = sampler.stratifiedRoot(i, 3000, 1).triangle;
            QVERIFY(t < 12 || t >= 20);
        }
    }

    void badTexelsAmongGoodOnes() {
        Map map(16, 16, 1, TexelFormat::F32, 1.0f);
        map.setTexel(3, 3, 0, notANumber);
        map.setTexel(9, 5, 0, infinity);
        map.setTexel(12, 12, 0, -5.0f);
        const Groom groom = groomWith(testing::plane(3), std::move(map));
        const SubTriangleSampler sampler = build(groom);
        QVERIFY(sampler.total() > 0.8 && sampler.total() < 1.0);
        for (const auto& sub : sampler.subTriangles()) QVERIFY(sub.weight > 0.0f && std::isfinite(sub.weight));
    }

    void hostileUvsAndTriangles() {
        SurfaceMesh mesh = testing::plane(6);
        const auto setUvs = [&](std::uint32_t t, glm::vec2 a, glm::vec2 b, glm::vec2 c) {
            mesh.cornerUvs[3 * t] = a;
            mesh.cornerUvs[3 * t + 1] = b;
            mesh.cornerUvs[3 * t + 2] = c;
        };
        setUvs(0, {0.0f, 0.0f}, {1e9f, 0.0f}, {0.0f, 1e9f});
        setUvs(1, {0.0f, 0.0f}, {1e38f, 0.0f}, {0.0f, -1e38f});
        setUvs(2, {notANumber, 0.0f}, {1.0f, notANumber}, {0.0f, 0.0f});
        setUvs(3, {infinity, 0.0f}, {1.0f, -infinity}, {0.0f, 0.0f});
        setUvs(4, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f});
        setUvs(5, {0.0f, 0.0f}, {0.5f, 0.5f}, {1.0f, 1.0f});
        mesh.triangles[6] = glm::uvec3(0, 0, 0);
        mesh.triangles[7] = glm::uvec3(0, 1, 0);
        const Groom groom = groomWith(mesh, painted(Paint::Noise, 1024));
        const SubTriangleSampler sampler = build(groom);
        QVERIFY(std::isfinite(sampler.total()) && sampler.total() > 0.0);
        for (const auto& sub : sampler.subTriangles()) {
            QVERIFY(sub.weight > 0.0f && std::isfinite(sub.weight));
            QVERIFY(sub.triangle != 6 && sub.triangle != 7);
        }
        // The sliver in UV follows the map along its length.
        const auto slices = std::count_if(sampler.subTriangles().begin(), sampler.subTriangles().end(),
                                          [](const auto& sub) { return sub.triangle == 5; });
        QVERIFY(slices > 100);
    }

    void meshesOfAllScales() {
        for (const float size : {1e-12f, 1e-3f, 1e6f, 1e15f, 1e30f}) {
            const Groom groom = groomWith(testing::plane(2, size), painted(Paint::Noise, 32));
            const SubTriangleSampler sampler = build(groom);
            QVERIFY(sampler.total() > 0.0 && std::isfinite(sampler.total()));
            const SurfacePoint root = sampler.stratifiedRoot(7, 10, 1);
            QVERIFY(root.triangle < 8 && root.u >= 0.0f && root.v >= 0.0f && root.u + root.v <= 1.0f);
        }
    }

    void rootsStayOnTheirTriangles() {
        const Groom groom = groomWith(testing::sphere(5, 7), painted(Paint::Noise, 512));
        const SubTriangleSampler sampler = build(groom);
        const float edges[] = {0.0f, 0x1p-24f, 0.25f, 0.5f, 1.0f - 0x1p-24f};
        for (std::size_t i = 0; i < sampler.subTriangles().size(); ++i) {
            for (const float a : edges) {
                for (const float b : edges) {
                    const SurfacePoint p = sampler.place(i, a, b);
                    QVERIFY(p.u >= 0.0f && p.v >= 0.0f && p.u + p.v <= 1.0f);
                }
            }
        }
    }

    void cancelledWorkSaysSo() {
        Progress progress;
        progress.cancel();
        const Groom groom = groomWith(testing::plane(4), painted(Paint::Noise, 64));
        const DensityLookup density(groom);
        const auto sampler = SubTriangleSampler::build(*groom.mesh, density, {}, progress);
        QVERIFY(!sampler.ok());
        QVERIFY(sampler.error().cancelled);
    }

    void rejectionFollowsTheDensityToo() {
        const Groom groom = groomWith(testing::plane(6), painted(Paint::Ramp, 256));
        const SubTriangleSampler sampler = build(groom);
        const DensityLookup density(groom);
        const std::size_t count = 100000;
        const auto points = rejectionSample(*groom.mesh, density, count, 3);
        QCOMPARE(points.size(), count);
        std::vector<double> expected(groom.mesh->triangles.size(), 0.0);
        std::vector<double> found(expected.size(), 0.0);
        for (const auto& sub : sampler.subTriangles())
            expected[sub.triangle] += static_cast<double>(sub.weight) / sampler.total() * static_cast<double>(count);
        for (const SurfacePoint& p : points) found[p.triangle] += 1.0;
        QVERIFY(std::abs(chiSquareExcess(expected, found)) < 4.5);
    }

    void groupMapPicksTheDensity() {
        Groom groom = makeGroom(testing::plane(8));
        groom.groups.edit().push_back({"thin", {}});
        groom.groups.edit()[1].params.general.density.value = 0.25f;
        Map pick(64, 64, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 64; ++y) {
            for (int x = 32; x < 64; ++x) pick.setTexel(x, y, 0, 1.0f / 255.0f);
        }
        groom.maps.set("groups", std::move(pick));
        groom.counts.edit().groupMap = {"groups"};
        const DensityLookup density(groom);
        QCOMPARE(density.groupAt({0.25f, 0.5f}), 0);
        QCOMPARE(density.groupAt({0.75f, 0.5f}), 1);
        QCOMPARE(density.at(0, {0.75f, 0.5f}), 0.25f);
        QCOMPARE(density.mapWidth(), 64);
        QVERIFY(std::abs(build(groom).total() - 0.625) < 1e-3);
    }
};

QTEST_APPLESS_MAIN(SubTriangleSamplerTest)
#include "sub_triangle_sampler_test.moc"
