// SPDX-License-Identifier: Apache-2.0
#include "core/surface/surface_query.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/surface/closest_point.h"
#include "core/surface/surface.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>
#include <cstring>
#include <limits>

using namespace whorl;

namespace {

// Triangles of every size and shape in a box, some of them without area.
SurfaceMesh soup(std::uint32_t seed, int count) {
    SurfaceMesh mesh;
    const auto coordinate = [&](int i, std::uint32_t channel) {
        return randomFloat(seed, static_cast<std::uint64_t>(i), channel) - 0.5f;
    };
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a(coordinate(i, 0), coordinate(i, 1), coordinate(i, 2));
        const float size = 0.5f * std::pow(10.0f, -3.0f * (coordinate(i, 9) + 0.5f));
        glm::vec3 b = a + size * glm::vec3(coordinate(i, 3), coordinate(i, 4), coordinate(i, 5));
        glm::vec3 c = a + size * glm::vec3(coordinate(i, 6), coordinate(i, 7), coordinate(i, 8));
        if (i % 17 == 0) b = a;
        if (i % 23 == 0) c = a + 0.25f * (b - a);
        if (i % 29 == 0) b = c = a;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : {a, b, c}) {
            mesh.positions.push_back(p);
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
            mesh.cornerUvs.emplace_back(0.0f, 0.0f);
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    mesh.parts.push_back({.name = "soup", .firstTriangle = 0, .triangleCount = mesh.triangleCount()});
    return mesh;
}

glm::vec3 randomPoint(std::uint32_t seed, std::uint64_t i, float size) {
    return size * (glm::vec3(randomFloat(seed, i, 0), randomFloat(seed, i, 1), randomFloat(seed, i, 2)) - 0.5f);
}

// Least distance over all triangles, by asking them one by one for places on their inside and border.
double bruteDistance(const SurfaceMesh& mesh, const glm::vec3& p) {
    double best = 1e300;
    for (const glm::uvec3& t : mesh.triangles) {
        const ClosestPoint place =
            closestPoint(Vec3d(mesh.positions[t.x]), Vec3d(mesh.positions[t.y]), Vec3d(mesh.positions[t.z]), Vec3d(p));
        best = std::min(best, place.distanceSquared);
    }
    return std::sqrt(best);
}

}  // namespace

class SurfaceQueryTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void closestPointBeatsAFineSearch() {
        const SurfaceMesh mesh = soup(3, 200);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            const glm::uvec3 k = mesh.triangles[t];
            const Vec3d a(mesh.positions[k.x]), b(mesh.positions[k.y]), c(mesh.positions[k.z]);
            const double size = std::max(glm::length(b - a), glm::length(c - a));
            const Vec3d p = a + size * Vec3d(randomPoint(5, t, 3.0f));
            const ClosestPoint place = closestPoint(a, b, c, p);
            QVERIFY(place.u >= 0.0 && place.v >= 0.0 && place.u + place.v <= 1.0 + 1e-12);
            const Vec3d at = a + (b - a) * place.u + (c - a) * place.v;
            QVERIFY(std::abs(glm::dot(p - at, p - at) - place.distanceSquared) <= 1e-12 * (1e-6 + size * size));
            for (int i = 0; i <= 40; ++i) {
                for (int j = 0; i + j <= 40; ++j) {
                    const Vec3d q = a + (b - a) * (i / 40.0) + (c - a) * (j / 40.0);
                    QVERIFY(glm::dot(p - q, p - q) >= place.distanceSquared * (1.0 - 1e-12));
                }
            }
        }
    }

    void nearestEqualsBruteForce() {
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const SurfaceQuery query{SurfaceMesh(seed == 0 ? testing::sphere(20, 30, 0.4f) : soup(seed, 700))};
            for (std::uint64_t i = 0; i < 1500; ++i) {
                const glm::vec3 p = randomPoint(seed, i, i % 5 == 0 ? 50.0f : 1.5f);
                const auto hit = query.nearest(p);
                QVERIFY(hit);
                const double expected = bruteDistance(query.mesh(), p);
                QVERIFY(std::abs(static_cast<double>(hit->distance) - expected) <= 2e-7 * expected + 1e-9);
                QVERIFY(glm::distance(hit->position, positionAt(query.mesh(), hit->point)) == 0.0f);
                QVERIFY(std::abs(glm::distance(p, hit->position) - hit->distance) < 1e-6f * (1.0f + hit->distance));
            }
        }
    }

    void tiesGoToTheLowestTriangle() {
        // Every vertex belongs to about six triangles; straight above it they are all as near.
        const SurfaceQuery query{testing::sphere(16, 24)};
        const SurfaceMesh& mesh = query.mesh();
        for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            std::uint32_t lowest = ~0u;
            for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
                const glm::uvec3 k = mesh.triangles[t];
                if (k.x == vertex || k.y == vertex || k.z == vertex) lowest = std::min(lowest, t);
            }
            const auto hit = query.nearest(mesh.positions[vertex] * 1.5f);
            QVERIFY(hit);
            QCOMPARE(hit->point.triangle, lowest);
            QCOMPARE(hit->position, mesh.positions[vertex]);
        }
    }

    void nearestKeepsToItsRange() {
        const SurfaceQuery query{testing::plane(3)};
        const glm::vec3 p(0.1f, 0.25f, 0.1f);
        QVERIFY(query.nearest(p, 0.25f));
        QVERIFY(!query.nearest(p, 0.2499f));
        QVERIFY(query.nearest({0.1f, 0.0f, 0.1f}, 1e-6f));
    }

    void rayEqualsBruteForce() {
        // On general triangles no ray meets an edge, so the first triangle is one for all.
        const SurfaceMesh mesh = soup(9, 800);
        const SurfaceQuery query{SurfaceMesh(mesh)};
        int hits = 0;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            const glm::vec3 origin = randomPoint(21, i, 2.0f);
            const glm::vec3 direction = 7.0f * (randomPoint(22, i, 1.0f) - 0.5f * origin);
            double best = 1e300;
            std::uint32_t triangle = ~0u;
            const Vec3d d = glm::normalize(Vec3d(direction));
            for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
                const Vec3d a(mesh.positions[mesh.triangles[t].x]);
                const Vec3d ab = Vec3d(mesh.positions[mesh.triangles[t].y]) - a;
                const Vec3d ac = Vec3d(mesh.positions[mesh.triangles[t].z]) - a;
                const Vec3d n = glm::cross(ab, ac);
                const double slope = glm::dot(n, d);
                if (slope == 0.0) continue;
                const double distance = glm::dot(n, a - Vec3d(origin)) / slope;
                const Vec3d q = Vec3d(origin) + d * distance - a;
                const double u = glm::dot(glm::cross(q, ac), n) / glm::dot(n, n);
                const double v = glm::dot(glm::cross(ab, q), n) / glm::dot(n, n);
                if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= 0.0 && distance < best) {
                    best = distance;
                    triangle = t;
                }
            }
            const auto hit = query.raycast(origin, direction);
            QCOMPARE(hit.has_value(), triangle != ~0u);
            if (!hit) continue;
            ++hits;
            QCOMPARE(hit->point.triangle, triangle);
            QVERIFY(std::abs(static_cast<double>(hit->distance) - best) < 1e-5);
            QVERIFY(!query.raycast(origin, direction, static_cast<float>(best) * 0.99f));
        }
        QVERIFY(hits > 300);
    }

    void noRayLeaksThroughAClosedMesh() {
        const SurfaceQuery query{testing::sphere(30, 40)};
        for (std::uint64_t i = 0; i < 20000; ++i) {
            glm::vec3 direction = randomPoint(31, i, 1.0f);
            // Also straight at vertices.
            if (i < query.mesh().positions.size()) direction = query.mesh().positions[i];
            QVERIFY(query.raycast(glm::vec3(0.0f), direction));
        }
    }

    void badInputsHaveNoAnswer() {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float inf = std::numeric_limits<float>::infinity();
        const SurfaceQuery query{testing::plane(2)};
        QVERIFY(!query.nearest({nan, 0.0f, 0.0f}));
        QVERIFY(!query.nearest({inf, 0.0f, 0.0f}));
        QVERIFY(!query.nearest({0.0f, 0.0f, 0.0f}, nan));
        QVERIFY(!query.nearest({0.0f, 0.0f, 0.0f}, -1.0f));
        QVERIFY(!query.raycast({nan, 1.0f, 0.0f}, {0.0f, -1.0f, 0.0f}));
        QVERIFY(!query.raycast({0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f}));
        QVERIFY(!query.raycast({0.0f, 1.0f, 0.0f}, {0.0f, nan, 0.0f}));
        QVERIFY(query.raycast({0.1f, 1.0f, 0.0f}, {0.0f, -1e-20f, 0.0f}));
        const SurfaceQuery empty{SurfaceMesh{}};
        QVERIFY(!empty.nearest(glm::vec3(0.0f)));
        QVERIFY(!empty.raycast(glm::vec3(0.0f), glm::vec3(1.0f)));
    }

    void farPointsAndHugeMeshes() {
        SurfaceMesh mesh = testing::plane(2);
        const SurfaceQuery query{SurfaceMesh(mesh)};
        QVERIFY(query.nearest(glm::vec3(1e15f)));
        for (glm::vec3& p : mesh.positions) p *= 1e12f;
        const SurfaceQuery huge{SurfaceMesh(mesh)};
        const auto hit = huge.nearest({0.0f, 1e12f, 0.0f});
        QVERIFY(hit);
        QVERIFY(std::abs(hit->distance - 1e12f) < 1e6f);
    }

    void sameFromManyThreads() {
        const SurfaceQuery query{soup(12, 500)};
        std::vector<SurfaceHit> together(2000);
        parallelFor(together.size(), 10, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) together[i] = *query.nearest(randomPoint(13, i, 1.5f));
        });
        for (std::size_t i = 0; i < together.size(); ++i) {
            const SurfaceHit alone = *query.nearest(randomPoint(13, i, 1.5f));
            QVERIFY(alone.point == together[i].point && alone.position == together[i].position &&
                    alone.distance == together[i].distance);
        }
    }

    void cacheKeepsTheNewest() {
        SurfaceCache cache;
        const Cow<SurfaceMesh> one = testing::plane(2);
        const Cow<SurfaceMesh> two = testing::plane(3);
        const auto first = cache.get(one);
        QCOMPARE(cache.get(Cow<SurfaceMesh>(one)), first);
        QVERIFY(cache.get(two) != first);
        QCOMPARE(first->mesh().triangleCount(), 8u);
        QVERIFY(first->skin().band() > 0.0f);
        QCOMPARE(&first->skin(), &first->skin());
    }
};

QTEST_APPLESS_MAIN(SurfaceQueryTest)
#include "surface_query_test.moc"
