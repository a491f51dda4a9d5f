// SPDX-License-Identifier: Apache-2.0
#include "core/surface/surface_point.h"

#include "core/base/random.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <QTest>
#include <cmath>
#include <limits>

using namespace whorl;

namespace {

glm::vec3 randomDirection(std::uint32_t seed, std::uint64_t i) {
    const float y = 2.0f * randomFloat(seed, i, 0) - 1.0f;
    const float angle = 6.2831853f * randomFloat(seed, i, 1);
    const float r = std::sqrt(std::max(0.0f, 1.0f - y * y));
    return glm::normalize(glm::vec3(r * std::cos(angle), y, r * std::sin(angle)));
}

float largest(const glm::vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

class SurfacePointTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void rotationIsARotationAndHitsItsTarget() {
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const glm::vec3 from = randomDirection(1, i);
            glm::vec3 to = randomDirection(2, i);
            // A third of the pairs nearly opposite, a third nearly equal: from a tenth of a radian down to nothing.
            const float tiny = std::pow(10.0f, -1.0f - 9.0f * randomFloat(3, i, 0));
            if (i % 3 == 0) to = glm::normalize(-from + tiny * to);
            if (i % 3 == 1) to = glm::normalize(from + tiny * to);
            const glm::mat3 r = minimalRotation(from, to);
            QVERIFY(largest(r * from - to) < 3e-6f);
            for (int column = 0; column < 3; ++column)
                QVERIFY(largest((glm::transpose(r) * r)[column] - glm::mat3(1.0f)[column]) < 2e-6f);
            QVERIFY(std::abs(glm::determinant(r) - 1.0f) < 3e-6f);
        }
    }

    void rotationIsTheSmallest() {
        // The axis is across both directions, so what is across both stays.
        for (std::uint64_t i = 0; i < 5000; ++i) {
            const glm::vec3 from = randomDirection(4, i);
            const glm::vec3 to = randomDirection(5, i);
            const glm::vec3 cross = glm::cross(from, to);
            if (glm::length(cross) < 0.05f) continue;
            const glm::vec3 axis = glm::normalize(cross);
            QVERIFY(largest(minimalRotation(from, to) * axis - axis) < 1e-5f);
        }
    }

    void rotationBackUndoesIt() {
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const glm::vec3 from = randomDirection(6, i);
            const glm::vec3 to = randomDirection(7, i);
            const glm::mat3 there = minimalRotation(from, to);
            const glm::mat3 back = minimalRotation(to, from);
            for (int column = 0; column < 3; ++column)
                QVERIFY(largest((back * there)[column] - glm::mat3(1.0f)[column]) < 1e-5f);
        }
    }

    void rotationOfEqualsIsNothing() {
        const glm::vec3 up(0.0f, 1.0f, 0.0f);
        QCOMPARE(minimalRotation(up, up), glm::mat3(1.0f));
        QCOMPARE(minimalRotation(glm::vec3(std::nanf("")), up), glm::mat3(1.0f));
    }

    void cornersAndCentre() {
        const SurfaceMesh mesh = testing::plane(1, 2.0f);
        const glm::uvec3 t = mesh.triangles[1];
        QCOMPARE(positionAt(mesh, {1, 0.0f, 0.0f}), mesh.positions[t.x]);
        QCOMPARE(positionAt(mesh, {1, 1.0f, 0.0f}), mesh.positions[t.y]);
        QCOMPARE(positionAt(mesh, {1, 0.0f, 1.0f}), mesh.positions[t.z]);
        QCOMPARE(uvAt(mesh, {1, 1.0f, 0.0f}), mesh.cornerUvs[4]);
        QCOMPARE(triangleArea(mesh, 0), 2.0);
        QCOMPARE(triangleNormal(mesh, 0), glm::vec3(0.0f, 1.0f, 0.0f));
    }

    void normalsPointOut() {
        const SurfaceMesh mesh = testing::sphere(12, 16);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            const SurfacePoint centre{t, 0.3f, 0.3f};
            const glm::vec3 out = glm::normalize(positionAt(mesh, centre));
            QVERIFY(glm::dot(normalAt(mesh, centre), out) > 0.99f);
            QVERIFY(glm::dot(triangleNormal(mesh, t), out) > 0.95f);
            QVERIFY(std::abs(glm::length(normalAt(mesh, centre)) - 1.0f) < 1e-6f);
        }
    }

    void degenerateTrianglesHaveAnswers() {
        SurfaceMesh mesh = testing::plane(1);
        mesh.positions[mesh.triangles[0].y] = mesh.positions[mesh.triangles[0].x];
        QCOMPARE(triangleArea(mesh, 0), 0.0);
        QCOMPARE(triangleNormal(mesh, 0), glm::vec3(0.0f, 1.0f, 0.0f));
        // Corner normals that cancel leave the triangle's own.
        SurfaceMesh opposed = testing::plane(1);
        const glm::uvec3 t = opposed.triangles[0];
        opposed.normals[t.x] = {1.0f, 0.0f, 0.0f};
        opposed.normals[t.y] = {-1.0f, 0.0f, 0.0f};
        QCOMPARE(normalAt(opposed, {0, 0.5f, 0.0f}), glm::vec3(0.0f, 1.0f, 0.0f));
    }

    void partsByTriangle() {
        SurfaceMesh mesh = testing::plane(4);
        mesh.parts = {{.name = "a", .firstTriangle = 0, .triangleCount = 10},
                      {.name = "empty", .firstTriangle = 10, .triangleCount = 0},
                      {.name = "b", .firstTriangle = 10, .triangleCount = 22}};
        QCOMPARE(partOfTriangle(mesh, 0), 0u);
        QCOMPARE(partOfTriangle(mesh, 9), 0u);
        QCOMPARE(partOfTriangle(mesh, 10), 2u);
        QCOMPARE(partOfTriangle(mesh, 31), 2u);
    }

    void boundsIgnoreStrayVertices() {
        SurfaceMesh mesh = testing::plane(1, 2.0f);
        mesh.positions.emplace_back(1000.0f);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        const Bounds bounds = boundsOf(mesh);
        QCOMPARE(bounds.min, glm::vec3(-1.0f, 0.0f, -1.0f));
        QCOMPARE(bounds.max, glm::vec3(1.0f, 0.0f, 1.0f));
        QVERIFY(boundsOf({}).empty());
        Bounds withNaN = bounds;
        withNaN.add(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        QCOMPARE(withNaN.max, bounds.max);
    }

    void shapesAndRandomGroomsAreSound() {
        for (std::uint32_t seed = 0; seed < 40; ++seed) {
            const Groom groom = testing::randomGroom(seed);
            for (const std::string& problem : checkGroom(groom)) QFAIL(problem.c_str());
            QCOMPARE(testing::groomDigest(groom), testing::groomDigest(testing::randomGroom(seed)));
            QVERIFY(testing::groomDigest(groom) != testing::groomDigest(testing::randomGroom(seed + 1)));
        }
        const Groom plain = testing::groomOn(testing::sphere(8, 12), 30);
        QVERIFY(checkGroom(plain).empty());
        QCOMPARE(plain.guides.count(), std::size_t{30});
    }
};

QTEST_APPLESS_MAIN(SurfacePointTest)
#include "surface_point_test.moc"
