// SPDX-License-Identifier: Apache-2.0
// The density of triangles three ways, against brute force.
#include "core/sampling/triangle_density.h"

#include "core/base/random.h"
#include "core/commands/vertex_guides.h"
#include "core/surface/surface_point.h"
#include "tests/support/distribution.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;
using testing::Paint;
using testing::painted;

namespace {

constexpr std::array<glm::vec2, 3> whole{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};

Groom groomWith(SurfaceMesh mesh, Map map) {
    Groom groom = makeGroom(std::move(mesh));
    groom.maps.set("density", std::move(map));
    groom.groups.edit()[0].params.general.density = {1.0f, "density"};
    return groom;
}

}  // namespace

class TriangleDensityTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void allAgreeWhereItIsEven() {
        const Groom groom = groomWith(testing::sphere(8, 12), Map(64, 64, 1, TexelFormat::F32, 0.3f));
        for (const TriangleDensity way :
             {TriangleDensity::Corners, TriangleDensity::Blurred, TriangleDensity::Texels}) {
            const TriangleDensities densities(groom, way);
            for (std::uint32_t t = 0; t < groom.mesh->triangleCount(); ++t)
                QVERIFY(std::abs(densities.mean(t, whole) - 0.3f) < 1e-5f);
        }
    }

    void texelsAreThoseInTheTriangle() {
        for (const Paint paint : {Paint::Noise, Paint::Ramp, Paint::Checks, Paint::Blot}) {
            const Groom groom = groomWith(testing::sphere(5, 7), painted(paint, 96));
            const DensityLookup density(groom);
            const TriangleDensities densities(groom, TriangleDensity::Texels);
            for (std::uint32_t t = 0; t < groom.mesh->triangleCount(); ++t) {
                for (const std::array<glm::vec2, 3>& piece :
                     {whole,
                      std::array<glm::vec2, 3>{glm::vec2(0.1f, 0.2f), glm::vec2(0.8f, 0.1f), glm::vec2(0.3f, 0.6f)}}) {
                    glm::dvec2 corner[3];
                    for (int k = 0; k < 3; ++k)
                        corner[k] = glm::dvec2(uvAt(*groom.mesh, {t, piece[static_cast<std::size_t>(k)].x,
                                                                  piece[static_cast<std::size_t>(k)].y}));
                    // Every texel of the map, asked whether it lies on the same side of all three edges.
                    double sum = 0.0;
                    int count = 0;
                    for (int y = 0; y < 96; ++y) {
                        for (int x = 0; x < 96; ++x) {
                            const glm::dvec2 p((x + 0.5) / 96.0, (y + 0.5) / 96.0);
                            int left = 0, right = 0;
                            for (int k = 0; k < 3; ++k) {
                                const glm::dvec2 a = corner[k], b = corner[(k + 1) % 3];
                                const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
                                left += side > 1e-9 ? 1 : 0;
                                right += side < -1e-9 ? 1 : 0;
                            }
                            if (left > 0 && right > 0) continue;
                            sum += static_cast<double>(density.at(t, glm::vec2(p)));
                            ++count;
                        }
                    }
                    if (count < 30) continue;
                    // Texels on an edge may count or not.
                    QVERIFY2(std::abs(static_cast<double>(densities.mean(t, piece)) - sum / count) < 4.0 / count,
                             qPrintable(QString("%1 of %2").arg(t).arg(count)));
                }
            }
        }
    }

    void cornersAreTheirAverage() {
        const Groom groom = groomWith(testing::sphere(8, 12), painted(Paint::Noise, 64));
        const DensityLookup density(groom);
        const TriangleDensities densities(groom, TriangleDensity::Corners);
        for (std::uint32_t t = 0; t < groom.mesh->triangleCount(); ++t) {
            float sum = 0.0f;
            for (const glm::vec2& corner : whole) sum += density.at(t, uvAt(*groom.mesh, {t, corner.x, corner.y}));
            QVERIFY(std::abs(densities.mean(t, whole) - sum / 3.0f) < 1e-6f);
        }
    }

    void blurIsAGaussian() {
        // Against the sum over all texels, by the formula.
        Map map(40, 30, 1, TexelFormat::F32, 0.0f);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x)
                map.setTexel(x, y, 0, randomFloat(1, static_cast<std::uint64_t>(y * 40 + x), 0));
        const float sigma = 1.5f;
        const Map smooth = blurred(map, sigma);
        for (int y = 0; y < 30; y += 7) {
            for (int x = 0; x < 40; x += 3) {
                double sum = 0.0, weights = 0.0;
                for (int j = -5; j <= 5; ++j) {
                    for (int i = -5; i <= 5; ++i) {
                        const double w = std::exp(-0.5 * (i * i + j * j) / double{sigma * sigma});
                        weights += w;
                        sum += w * static_cast<double>(map.texel((x + i + 40) % 40, (y + j + 30) % 30));
                    }
                }
                QVERIFY(std::abs(static_cast<double>(smooth.texel(x, y)) - sum / weights) < 1e-5);
            }
        }
        // A spot that no corner lies on: blurred corners know of it, plain ones do not.
        Map spot(128, 128, 1, TexelFormat::U8, 0.0f);
        for (int y = 40; y < 50; ++y)
            for (int x = 70; x < 90; ++x) spot.setTexel(x, y, 0, 1.0f);
        const Groom groom = groomWith(testing::plane(40), spot);
        float sums[3] = {};
        for (const TriangleDensity way :
             {TriangleDensity::Corners, TriangleDensity::Blurred, TriangleDensity::Texels}) {
            const TriangleDensities densities(groom, way);
            for (std::uint32_t t = 0; t < groom.mesh->triangleCount(); ++t)
                sums[static_cast<int>(way)] += densities.mean(t, whole);
        }
        for (const float sum : sums) QVERIFY(std::abs(sum - 3200.0f * 200.0f / 16384.0f) < 0.12f * sum);
    }

    void guidesComeWhereTexelsAskForThem() {
        // Two huge triangles, a spot in the middle of one: corners see black, texels see the spot.
        Map spot(128, 128, 1, TexelFormat::U8, 0.0f);
        for (int y = 20; y < 50; ++y)
            for (int x = 70; x < 100; ++x) spot.setTexel(x, y, 0, 1.0f);
        Groom groom = testing::groomOn(testing::plane(1), 0);
        groom.maps.set("density", spot);
        groom.groups.edit()[0].params.general.density = {1.0f, "density"};
        const Surface surface(groom.mesh);
        Progress progress;
        VertexGuides options{.length = 0.02f, .perSquareMetre = 2000.0f};
        QVERIFY(!placeGuidesOnVertices(groom, surface, options, progress).ok());
        options.density = TriangleDensity::Texels;
        QVERIFY(placeGuidesOnVertices(groom, surface, options, progress).ok());
        QVERIFY(checkGroom(groom).empty());
        // 0.055 square metres: one for each 1/2000 while pieces are larger, about 110 and not more than some times
        // that.
        QVERIFY2(groom.guides.count() > 60 && groom.guides.count() < 400,
                 qPrintable(QString::number(groom.guides.count())));
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const glm::vec2 uv = uvAt(*groom.mesh, groom.guides.root(i));
            QVERIFY(spot.sample(uv) > 0.0f);
        }
    }
};

QTEST_APPLESS_MAIN(TriangleDensityTest)
#include "triangle_density_test.moc"
