// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/hilbert.h"
#include "core/sampling/sub_triangle_sampler.h"
#include "core/surface/surface_point.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

using namespace whorl;
using testing::Paint;

namespace {

Groom groomWith(SurfaceMesh mesh, Map map) {
    Groom groom = makeGroom(std::move(mesh));
    groom.maps.set("density", std::move(map));
    groom.groups.edit()[0].params.general.density = {1.0f, "density"};
    return groom;
}

struct Made {
    Groom groom;
    SubTriangleSampler sampler;
};

Made make(Groom groom) {
    Progress progress;
    const DensityLookup density(groom);
    auto sampler = SubTriangleSampler::build(*groom.mesh, density, {}, progress);
    if (!sampler) qFatal("not built");
    return {groom, std::move(*sampler)};
}

std::vector<SurfacePoint> even(const Made& made, std::size_t count, std::uint32_t seed = 1) {
    Progress progress;
    auto roots = evenRoots(*made.groom.mesh, made.sampler, count, seed, progress);
    if (!roots) qFatal("cancelled");
    return std::move(*roots);
}

std::vector<SurfacePoint> randomRoots(const Made& made, std::size_t count) {
    std::vector<SurfacePoint> roots;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t inside = randomBits(8, i, 1);
        roots.push_back(
            made.sampler.sample(unitDouble(randomBits(8, i, 0)), unitFloat(inside), unitFloat(inside << 24)));
    }
    return roots;
}

// Distance from each root to the nearest other one, sorted.
std::vector<float> spacings(const Made& made, const std::vector<SurfacePoint>& roots) {
    std::vector<glm::vec3> places;
    for (const SurfacePoint& root : roots) places.push_back(positionAt(*made.groom.mesh, root));
    std::vector<float> result;
    for (std::size_t i = 0; i < places.size(); ++i) {
        float best = 1e30f;
        for (std::size_t j = 0; j < places.size(); ++j) {
            if (i != j) best = std::min(best, glm::distance(places[i], places[j]));
        }
        result.push_back(best);
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

class EvenRootsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void rootsKeepTheirDistance() {
        const Made made = make(makeGroom(testing::sphere(40, 60)));
        const std::size_t count = 800;
        const auto roots = even(made, count);
        QCOMPARE(roots.size(), count);
        // The densest packing of `count` discs would have them this far apart.
        const double packed =
            2.0 * std::sqrt(made.sampler.total() / (2.0 * std::sqrt(3.0) * static_cast<double>(count)));
        const auto spread = spacings(made, roots);
        QVERIFY2(static_cast<double>(spread.front()) > 0.6 * packed,
                 qPrintable(QString::number(static_cast<double>(spread.front()) / packed)));
        QVERIFY(static_cast<double>(spread[count / 2]) > 0.7 * packed);
        // At random, the closest pair is hundreds of times nearer, and the median about half.
        const auto loose = spacings(made, randomRoots(made, count));
        QVERIFY(loose.front() * 10.0f < spread.front());
        QVERIFY(loose[count / 2] * 1.4f < spread[count / 2]);
    }

    void noHolesRemain() {
        // No place of the surface is farther from a root than a maximal set allows by much.
        const Made made = make(makeGroom(testing::sphere(40, 60)));
        const auto roots = even(made, 800);
        const double packed = 2.0 * std::sqrt(made.sampler.total() / (2.0 * std::sqrt(3.0) * 800.0));
        for (const SurfacePoint& place : randomRoots(made, 3000)) {
            float nearest = 1e30f;
            const glm::vec3 p = positionAt(*made.groom.mesh, place);
            for (const SurfacePoint& root : roots)
                nearest = std::min(nearest, glm::distance(p, positionAt(*made.groom.mesh, root)));
            QVERIFY(static_cast<double>(nearest) < packed);
        }
    }

    void theyFollowTheDensity() {
        const Made made = make(groomWith(testing::plane(40), testing::painted(Paint::Ramp, 256)));
        const std::size_t count = 2000;
        std::vector<double> found(8, 0.0);
        for (const SurfacePoint& root : even(made, count)) {
            const float x = uvAt(*made.groom.mesh, root).x;
            found[std::min<std::size_t>(7, static_cast<std::size_t>(x * 8.0f))] += 1.0;
        }
        for (std::size_t i = 0; i < 8; ++i) {
            const double expected = static_cast<double>(count) * (2.0 * static_cast<double>(i) + 1.0) / 64.0;
            QVERIFY2(std::abs(found[i] - expected) < 10.0 + 0.08 * expected, qPrintable(QString::number(found[i])));
        }
    }

    void noiseFinerThanTheSpacingDoesNotMatter() {
        const Made made = make(groomWith(testing::plane(20), testing::painted(Paint::Noise, 512)));
        const auto spread = spacings(made, even(made, 500));
        const double packed = 2.0 * std::sqrt(1.0 / (2.0 * std::sqrt(3.0) * 500.0));
        QVERIFY(static_cast<double>(spread.front()) > 0.5 * packed);
    }

    void nothingGrowsInTheBlack() {
        const Made made = make(groomWith(testing::plane(20), testing::painted(Paint::Blot, 256)));
        const auto roots = even(made, 300);
        QCOMPARE(roots.size(), std::size_t{300});
        for (const SurfacePoint& root : roots) {
            const glm::vec2 uv = uvAt(*made.groom.mesh, root);
            QVERIFY(std::hypot(uv.x - 0.5f, 1.0f - uv.y - 0.4f) < 0.21f);
        }
    }

    void twoSidesOfAThinSheetDoNotCrowdEachOther() {
        SurfaceMesh mesh = testing::plane(20);
        SurfaceMesh under = testing::plane(20);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : under.positions) mesh.positions.push_back(p - glm::vec3(0.0f, 1e-4f, 0.0f));
        for (std::size_t i = 0; i < under.positions.size(); ++i) mesh.normals.emplace_back(0.0f, -1.0f, 0.0f);
        for (const glm::uvec3& t : under.triangles) mesh.triangles.emplace_back(t.x + first, t.z + first, t.y + first);
        mesh.cornerUvs.insert(mesh.cornerUvs.end(), under.cornerUvs.begin(), under.cornerUvs.end());
        mesh.parts[0].triangleCount = mesh.triangleCount();
        const Made made = make(makeGroom(std::move(mesh)));
        const auto roots = even(made, 1000);
        const auto above =
            static_cast<std::size_t>(std::count_if(roots.begin(), roots.end(), [&](const SurfacePoint& root) {
                return root.triangle < under.triangleCount();
            }));
        QVERIFY(above > 470 && above < 530);
        std::vector<SurfacePoint> top(roots);
        std::erase_if(top, [&](const SurfacePoint& root) { return root.triangle >= under.triangleCount(); });
        const double packed = 2.0 * std::sqrt(2.0 / (2.0 * std::sqrt(3.0) * 1000.0));
        QVERIFY(static_cast<double>(spacings(made, top).front()) > 0.55 * packed);
    }

    void sameForAnyNumberOfThreadsOtherForOtherSeeds() {
        const Made made = make(groomWith(testing::sphere(20, 30), testing::painted(Paint::Noise, 64)));
        const auto many = even(made, 400);
        QVERIFY(many != even(made, 400, 2));
        const ThreadLimit one(1);
        QVERIFY(many == even(made, 400));
    }

    void anyCount() {
        const Made made = make(makeGroom(testing::plane(1)));
        for (const std::size_t count : {0u, 1u, 2u, 3u, 17u, 99u, 100u, 101u})
            QCOMPARE(even(made, count).size(), count);
        const Made empty = make(groomWith(testing::plane(1), Map(4, 4, 1, TexelFormat::U8, 0.0f)));
        QVERIFY(even(empty, 10).empty());
    }

    void cancelledWorkSaysSo() {
        const Made made = make(makeGroom(testing::plane(4)));
        Progress progress;
        progress.cancel();
        const auto roots = evenRoots(*made.groom.mesh, made.sampler, 1000, 1, progress);
        QVERIFY(!roots.ok());
        QVERIFY(roots.error().cancelled);
    }

    void hilbertCurveIsOne() {
        // Along the coarse curve, every step goes to a face neighbour and all cells come once.
        constexpr int bits = 3;
        constexpr std::uint32_t scale = 1u << (20 - bits);
        std::vector<std::pair<std::uint64_t, glm::ivec3>> cells;
        for (std::uint32_t x = 0; x < 8; ++x) {
            for (std::uint32_t y = 0; y < 8; ++y) {
                for (std::uint32_t z = 0; z < 8; ++z)
                    cells.emplace_back(hilbertIndex(x * scale, y * scale, z * scale) >> (3 * (20 - bits)),
                                       glm::ivec3(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)));
            }
        }
        std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::size_t i = 0; i < cells.size(); ++i) {
            QCOMPARE(cells[i].first, std::uint64_t{i});
            if (i == 0) continue;
            const glm::ivec3 step = glm::abs(cells[i].second - cells[i - 1].second);
            QCOMPARE(step.x + step.y + step.z, 1);
        }
    }
};

QTEST_APPLESS_MAIN(EvenRootsTest)
#include "even_roots_test.moc"
