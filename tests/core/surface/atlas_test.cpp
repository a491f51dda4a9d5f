// SPDX-License-Identifier: Apache-2.0
#include "core/surface/atlas.h"

#include "core/base/random.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QElapsedTimer>
#include <QTest>
#include <cmath>

using namespace whorl;

namespace {

double uvArea(const SurfaceMesh& mesh, std::uint32_t t) {
    const glm::dvec2 a(mesh.cornerUvs[t * 3]), b(mesh.cornerUvs[t * 3 + 1]), c(mesh.cornerUvs[t * 3 + 2]);
    return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

// How often each texel centre of a map is covered, by the sign of exact-enough edge functions.
struct Coverage {
    int size;
    std::vector<std::int32_t> owner;
    std::size_t twice = 0;
    explicit Coverage(const SurfaceMesh& mesh, int mapSize)
        : size(mapSize), owner(static_cast<std::size_t>(mapSize) * static_cast<std::size_t>(mapSize), -1) {
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            glm::dvec2 p[3];
            for (std::uint32_t k = 0; k < 3; ++k) p[k] = glm::dvec2(mesh.cornerUvs[t * 3 + k]) * double(size);
            const auto low = glm::floor(glm::min(p[0], glm::min(p[1], p[2])));
            const auto high = glm::ceil(glm::max(p[0], glm::max(p[1], p[2])));
            for (int y = std::max(0, int(low.y)); y < std::min(size, int(high.y)); ++y) {
                for (int x = std::max(0, int(low.x)); x < std::min(size, int(high.x)); ++x) {
                    const glm::dvec2 centre(x + 0.5, y + 0.5);
                    bool inside = true;
                    for (int k = 0; k < 3; ++k) {
                        const glm::dvec2 a = p[k], b = p[(k + 1) % 3];
                        // Strictly inside: a centre on a shared edge belongs to neither.
                        inside = inside && (b.x - a.x) * (centre.y - a.y) - (b.y - a.y) * (centre.x - a.x) > 1e-6;
                    }
                    if (!inside) continue;
                    auto& cell = owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                                       static_cast<std::size_t>(x)];
                    if (cell >= 0) ++twice;
                    cell = static_cast<std::int32_t>(t);
                }
            }
        }
    }
};

SurfaceMesh withoutUvs(SurfaceMesh mesh) {
    mesh.cornerUvs.clear();
    return mesh;
}

// Loose triangles in all directions.
SurfaceMesh soup(std::uint32_t count) {
    SurfaceMesh mesh;
    for (std::uint32_t i = 0; i < count * 3; ++i) {
        const auto number = [&](std::uint32_t channel) { return randomFloat(7, i, channel); };
        mesh.positions.emplace_back(number(0), number(1), number(2));
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
    }
    for (std::uint32_t t = 0; t < count; ++t) mesh.triangles.emplace_back(t * 3, t * 3 + 1, t * 3 + 2);
    return mesh;
}

// A strip that winds round and round over itself: all triangles face up, so no cone of normals can part them.
SurfaceMesh spiral(std::uint32_t steps) {
    SurfaceMesh mesh;
    for (std::uint32_t i = 0; i <= steps; ++i) {
        const double angle = 0.2 * i;
        for (const double radius : {0.5, 1.0}) {
            mesh.positions.emplace_back(float(radius * std::cos(angle)), float(0.002 * i),
                                        float(-radius * std::sin(angle)));
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        }
    }
    for (std::uint32_t i = 0; i < steps; ++i) {
        mesh.triangles.emplace_back(i * 2, i * 2 + 1, i * 2 + 2);
        mesh.triangles.emplace_back(i * 2 + 1, i * 2 + 3, i * 2 + 2);
    }
    return mesh;
}

void checkAtlas(SurfaceMesh mesh, int mapSize, double leastUse) {
    makeAtlas(mesh, mapSize);
    QVERIFY(mesh.madeAtlas);
    QCOMPARE(mesh.cornerUvs.size(), mesh.triangles.size() * 3);
    double most = 0.0, least = 1e300, used = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const glm::vec2 uv = mesh.cornerUvs[t * 3 + k];
            QVERIFY(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
        }
        const double area = triangleArea(mesh, t);
        if (area < 1e-12) continue;
        const double ratio = uvArea(mesh, t) / area;
        most = std::max(most, ratio);
        used += uvArea(mesh, t);
        // Rounding of float UVs counts for triangles far below a texel.
        if (uvArea(mesh, t) > 1e-8) least = std::min(least, ratio);
        QVERIFY2(ratio > 0.0, qPrintable(QString("triangle %1").arg(t)));
    }
    QVERIFY2(least > most * 0.4, qPrintable(QString("%1 of %2").arg(least).arg(most)));
    QVERIFY2(used > leastUse, qPrintable(QString("only %1 of the map is used").arg(used)));
    QCOMPARE(Coverage(mesh, mapSize).twice, std::size_t{0});
    SurfaceMesh again = mesh;
    makeAtlas(again, mapSize);
    QVERIFY(again.cornerUvs == mesh.cornerUvs);
}

}  // namespace

class AtlasTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void laws_data() {
        QTest::addColumn<int>("shape");
        QTest::addColumn<double>("leastUse");
        QTest::newRow("plane") << 0 << 0.5;
        QTest::newRow("sphere") << 1 << 0.3;
        QTest::newRow("spiral that lies over itself") << 2 << 0.2;
        QTest::newRow("100 loose triangles") << 3 << 0.15;
        QTest::newRow("20,000 loose triangles") << 4 << 0.001;
    }
    void laws() {
        QFETCH(int, shape);
        QFETCH(double, leastUse);
        const SurfaceMesh mesh = shape == 0   ? testing::plane(20)
                                 : shape == 1 ? testing::sphere(40, 60)
                                 : shape == 2 ? spiral(200)
                                 : shape == 3 ? soup(100)
                                              : soup(20000);
        checkAtlas(withoutUvs(mesh), 1024, leastUse);
    }

    void chartsKeepTheirGap() {
        SurfaceMesh mesh = soup(60);
        const int size = 512, gap = 4;
        makeAtlas(mesh, size, gap);
        const Coverage coverage(mesh, size);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const int owner = coverage.owner[std::size_t(y) * std::size_t(size) + std::size_t(x)];
                if (owner < 0) continue;
                // Centres of two charts are at least the gap apart.
                for (int dx = 1; dx <= gap && x + dx < size; ++dx) {
                    const int other = coverage.owner[std::size_t(y) * std::size_t(size) + std::size_t(x + dx)];
                    QVERIFY(other < 0 || other == owner);
                }
            }
        }
    }

    void degenerateTrianglesGetAPoint() {
        SurfaceMesh mesh = withoutUvs(testing::plane(2));
        mesh.triangles.emplace_back(0, 0, 1);
        mesh.triangles.emplace_back(2, 2, 2);
        makeAtlas(mesh);
        for (const glm::vec2& uv : mesh.cornerUvs) QVERIFY(std::isfinite(uv.x) && std::isfinite(uv.y));
    }

    void emptyMesh() {
        SurfaceMesh mesh;
        makeAtlas(mesh);
        QVERIFY(mesh.cornerUvs.empty());
    }

    void needsAtlasKnows() {
        SurfaceMesh mesh = testing::plane(4);
        QVERIFY(!needsAtlas(mesh));
        SurfaceMesh zero = mesh;
        for (glm::vec2& uv : zero.cornerUvs) uv = glm::vec2(0.3f);
        QVERIFY(needsAtlas(zero));
        SurfaceMesh few = mesh;
        for (std::size_t i = 0; i < few.cornerUvs.size() / 4; ++i) few.cornerUvs[i] = glm::vec2(0.0f);
        QVERIFY(!needsAtlas(few));
        mesh.cornerUvs.clear();
        QVERIFY(needsAtlas(mesh));
    }

    void twoHundredThousandTriangles() {
        const SurfaceMesh mesh = withoutUvs(testing::sphere(320, 320));
        QElapsedTimer timer;
        timer.start();
        SurfaceMesh made = mesh;
        makeAtlas(made);
        QVERIFY2(timer.elapsed() < 10000, qPrintable(QString("%1 ms").arg(timer.elapsed())));
    }
};

QTEST_APPLESS_MAIN(AtlasTest)
#include "atlas_test.moc"
