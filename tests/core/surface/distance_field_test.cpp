// SPDX-License-Identifier: Apache-2.0
#include "core/surface/distance_field.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/surface/band_search.h"
#include "core/surface/surface_query.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>
#include <limits>

using namespace whorl;

namespace {

glm::vec3 randomPoint(std::uint32_t seed, std::uint64_t i, float size) {
    return size * (glm::vec3(randomFloat(seed, i, 0), randomFloat(seed, i, 1), randomFloat(seed, i, 2)) - 0.5f);
}

void flip(SurfaceMesh& mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
}

SurfaceMesh joined(SurfaceMesh a, const SurfaceMesh& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
    a.cornerUvs.insert(a.cornerUvs.end(), b.cornerUvs.begin(), b.cornerUvs.end());
    for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
    a.parts = {{.name = "all", .firstTriangle = 0, .triangleCount = a.triangleCount()}};
    return a;
}

// The same triangles, no vertex shared.
SurfaceMesh split(const SurfaceMesh& mesh) {
    SurfaceMesh result = mesh;
    result.positions.clear();
    result.normals.clear();
    for (glm::uvec3& t : result.triangles) {
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        for (int k = 0; k < 3; ++k) {
            result.positions.push_back(mesh.positions[t[k]]);
            result.normals.push_back(mesh.normals[t[k]]);
        }
        t = {first, first + 1, first + 2};
    }
    return result;
}

}  // namespace

class DistanceFieldTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sphereHasItsDistances() {
        const float radius = 0.1f;
        const SurfaceQuery query{testing::sphere(96, 128, radius)};
        const DistanceField field = DistanceField::build(query.mesh(), 96);
        int inBand = 0;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const glm::vec3 p = randomPoint(1, i, 0.26f);
            const float exact = glm::length(p) - radius;
            const float found = field.distance(p);
            const float reach = field.band() - 2.0f * field.spacing();
            if (std::abs(exact) < reach) {
                ++inBand;
                QVERIFY(std::abs(found - exact) < 0.06f * field.spacing());
                QVERIFY(glm::dot(field.gradient(p), glm::normalize(p)) > 0.99f);
            } else {
                QVERIFY(found * exact > 0.0f);
                QVERIFY(std::abs(found) <= field.band() * 1.00001f);
            }
        }
        QVERIFY(inBand > 2000);
        QCOMPARE(field.distance(glm::vec3(0.0f)), -field.band());
        QCOMPARE(field.gradient(glm::vec3(0.0f)), glm::vec3(0.0f));
        QCOMPARE(field.distance(glm::vec3(10.0f)), field.band());
    }

    void aSampleSaysBothAndNeverJumps() {
        const SurfaceQuery ball{testing::sphere(40, 48, 0.1f)};
        const DistanceField field = DistanceField::build(ball.mesh(), 64);
        const float step = 0.01f * field.spacing();
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const glm::vec3 p = randomPoint(21, i, 0.3f);
            const DistanceField::Sample sample = field.sample(p);
            QCOMPARE(sample.distance(), field.distance(p));
            QCOMPARE(sample.gradient(), field.gradient(p));
            const glm::vec3 way = randomPoint(22, i, 2.0f * step);
            QVERIFY(std::abs(field.distance(p + way) - sample.distance()) < 2.0f * glm::length(way) + 1e-6f);
        }
    }

    void nodesAreExact() {
        // Sampled at the nodes, trilinear mixing takes no part. The corner of the grid is seven spacings off the box.
        const SurfaceMesh mesh = testing::sphere(9, 11);
        const SurfaceQuery query{SurfaceMesh(mesh)};
        const DistanceField field = DistanceField::build(query.mesh(), 32);
        const glm::vec3 origin = boundsOf(mesh).min - 7.0f * field.spacing();
        int negative = 0;
        for (int i = 0; i < 4000; ++i) {
            const glm::vec3 random = randomPoint(2, static_cast<std::uint64_t>(i), 1.0f) + 0.5f;
            const glm::vec3 p = origin + glm::floor(random * 44.0f) * field.spacing();
            const auto hit = query.nearest(p);
            const float expected = std::min(hit->distance, field.band());
            QVERIFY(std::abs(std::abs(field.distance(p)) - expected) < 0.02f * field.spacing());
            // A convex solid: inside is behind all faces.
            bool inside = true;
            for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
                inside = inside && glm::dot(p - mesh.positions[mesh.triangles[t].x], triangleNormal(mesh, t)) < 0.0f;
            if (expected > 1e-3f * field.spacing()) QCOMPARE(field.distance(p) < 0.0f, inside);
            negative += inside ? 1 : 0;
        }
        QVERIFY(negative > 300);
    }

    void bandEqualsOneQueryANode() {
        // Slivers, specks and triangles as large as the grid, at every vector width.
        SurfaceMesh mesh;
        for (std::uint64_t i = 0; i < 300; ++i) {
            const glm::vec3 a = randomPoint(11, i, 1.0f);
            const float size = std::pow(10.0f, -3.0f * randomFloat(12, i, 0));
            const glm::vec3 b = a + randomPoint(13, i, 2.0f * size);
            const glm::vec3 c = i % 3 == 0 ? a + 0.3f * (b - a) + randomPoint(14, i, 1e-4f * size)
                                           : a + randomPoint(15, i, 2.0f * size);
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec3& p : {a, b, i % 31 == 0 ? b : c}) mesh.positions.push_back(p);
            mesh.triangles.emplace_back(first, first + 1, first + 2);
        }
        const SurfaceQuery query{SurfaceMesh(mesh)};
        const NodeGrid grid{glm::vec3(-0.8f), 1.6f / 44.0f, {45, 43, 41}};
        const float band = 6.0f * grid.spacing;
        const SimdLevel best = simdLevel();
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            setSimdLevel(level);
            std::vector<NodeHit> hits(grid.count(), NodeHit{0, {}, {~0u, 0.0f, 0.0f}, 0.0f});
            searchBand(mesh, grid, band, [&](const NodeHit& hit) { hits[hit.index] = hit; });
            for (int z = 0; z < grid.size[2]; ++z) {
                for (int y = 0; y < grid.size[1]; ++y) {
                    for (int x = 0; x < grid.size[0]; ++x) {
                        const NodeHit& found = hits[grid.index(x, y, z)];
                        const auto expected = query.nearest(glm::vec3(grid.node(x, y, z)));
                        if (found.nearest.triangle == ~0u) {
                            QVERIFY(expected->distance > band * 0.9999f);
                        } else {
                            QVERIFY(std::abs(expected->distance - found.distance) < 1e-6f);
                            QCOMPARE(found.index, grid.index(x, y, z));
                        }
                    }
                }
            }
        }
        setSimdLevel(best);
    }

    void sameForAnyNumberOfThreads() {
        const SurfaceQuery query{testing::sphere(20, 24)};
        const DistanceField many = DistanceField::build(query.mesh(), 64);
        const ThreadLimit one(1);
        const DistanceField alone = DistanceField::build(query.mesh(), 64);
        for (std::uint64_t i = 0; i < 5000; ++i) {
            const glm::vec3 p = randomPoint(4, i, 0.3f);
            QCOMPARE(many.distance(p), alone.distance(p));
        }
    }

    void seamsAreNoBorders() {
        const SurfaceMesh mesh = testing::sphere(20, 24);
        const SurfaceQuery whole{SurfaceMesh(mesh)};
        const SurfaceQuery cut{split(mesh)};
        const DistanceField a = DistanceField::build(whole.mesh(), 48);
        const DistanceField b = DistanceField::build(cut.mesh(), 48);
        for (std::uint64_t i = 0; i < 5000; ++i) {
            const glm::vec3 p = randomPoint(5, i, 0.3f);
            QVERIFY(std::abs(a.distance(p) - b.distance(p)) < 1e-6f);
        }
    }

    void openSheetHasAnInsideOnlyBehindIt() {
        const SurfaceQuery query{testing::plane(10)};
        const DistanceField field = DistanceField::build(query.mesh(), 64);
        const float step = field.spacing();
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const glm::vec3 p = randomPoint(6, i, 0.9f);
            const glm::vec3 on(p.x, 0.0f, p.z);
            QVERIFY(std::abs(field.distance(on + glm::vec3(0.0f, 2.0f * step, 0.0f)) - 2.0f * step) < 1e-5f);
            QVERIFY(std::abs(field.distance(on - glm::vec3(0.0f, 2.0f * step, 0.0f)) + 2.0f * step) < 1e-5f);
            QVERIFY(field.gradient(on - glm::vec3(0.0f, step, 0.0f)).y > 0.999f);
            // Far below is outside again, and so is everything beside the rim, above or below.
            QCOMPARE(field.distance(on - glm::vec3(0.0f, field.band() + 2.0f * step, 0.0f)), field.band());
            const glm::vec3 beside(0.5f + 3.0f * step, 4.0f * step * (2.0f * randomFloat(7, i, 0) - 1.0f), p.z);
            QVERIFY(field.distance(beside) > 2.0f * step);
        }
    }

    void pocketsOfClosedMeshesAreInside() {
        // A ball with a hollow: three far regions.
        SurfaceMesh inner = testing::sphere(32, 40, 0.05f);
        flip(inner);
        const SurfaceQuery query{joined(testing::sphere(48, 60, 0.1f), inner)};
        const DistanceField field = DistanceField::build(query.mesh(), 200);
        QCOMPARE(field.distance(glm::vec3(0.0f)), field.band());
        QCOMPARE(field.distance({0.075f, 0.0f, 0.0f}), -field.band());
        QCOMPARE(field.distance({0.12f, 0.0f, 0.0f}), field.band());
    }

    void sheetsDrawnTwiceHaveNoInside() {
        const SurfaceMesh front = testing::plane(6);
        SurfaceMesh back = front;
        flip(back);
        const SurfaceQuery query{joined(front, back)};
        const DistanceField field = DistanceField::build(query.mesh(), 32);
        for (std::uint64_t i = 0; i < 2000; ++i) QVERIFY(field.distance(randomPoint(8, i, 1.2f)) >= 0.0f);
    }

    void finsAndDuplicatesDoNotTurnASolidInsideOut() {
        // A fin along a ball's equator and every face twice: edges of four and more faces.
        const SurfaceMesh ball = testing::sphere(24, 32);
        SurfaceMesh mesh = joined(ball, ball);
        const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(0.13f, 0.0f, 0.0f);
        mesh.normals.emplace_back(1.0f, 0.0f, 0.0f);
        const std::uint32_t equator = 1 + 11 * 32;
        mesh.triangles.emplace_back(equator, equator + 1, tip);
        for (int k = 0; k < 3; ++k) mesh.cornerUvs.emplace_back(0.0f, 0.0f);
        mesh.triangles.emplace_back(tip, tip, tip);
        for (int k = 0; k < 3; ++k) mesh.cornerUvs.emplace_back(0.0f, 0.0f);
        const SurfaceQuery query{std::move(mesh)};
        const DistanceField field = DistanceField::build(query.mesh(), 64);
        for (std::uint64_t i = 0; i < 5000; ++i) {
            const glm::vec3 p = randomPoint(9, i, 0.22f);
            if (glm::distance(p, glm::vec3(0.1f, 0.0f, 0.0f)) < 0.04f) continue;
            const float exact = glm::length(p) - 0.1f;
            if (std::abs(exact) > field.spacing()) QCOMPARE(field.distance(p) > 0.0f, exact > 0.0f);
        }
    }

    void nothingToMeasure() {
        const SurfaceQuery empty{SurfaceMesh{}};
        const DistanceField none = DistanceField::build(empty.mesh());
        QVERIFY(none.distance(glm::vec3(0.0f)) >= 0.0f);
        QCOMPARE(none.gradient(glm::vec3(0.0f)), glm::vec3(0.0f));
        SurfaceMesh point = testing::plane(1);
        for (glm::vec3& p : point.positions) p = glm::vec3(1.0f);
        const SurfaceQuery dot{std::move(point)};
        QVERIFY(DistanceField::build(dot.mesh()).distance(glm::vec3(0.0f)) >= 0.0f);
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const SurfaceQuery ball{testing::sphere(8, 8)};
        const DistanceField field = DistanceField::build(ball.mesh(), 16);
        QCOMPARE(field.distance(glm::vec3(nan)), field.band());
        QCOMPARE(field.gradient(glm::vec3(nan)), glm::vec3(0.0f));
        QCOMPARE(field.distance(glm::vec3(-1e30f)), field.band());
    }
};

QTEST_APPLESS_MAIN(DistanceFieldTest)
#include "distance_field_test.moc"
