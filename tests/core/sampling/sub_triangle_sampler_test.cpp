// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/sub_triangle_sampler.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/sampling/sub_triangle_positions.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <cmath>
#include <limits>
#include <map>

using namespace whorl;

namespace {

enum class Paint { None, Noise, Ramp, Checks, Blot };

Map painted(Paint paint, int size) {
    Map map(size, size, 1, TexelFormat::U8, 1.0f);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float s = static_cast<float>(x) / static_cast<float>(size);
            const float t = static_cast<float>(y) / static_cast<float>(size);
            float value = 1.0f;
            if (paint == Paint::Noise) value = randomFloat(77, static_cast<std::uint64_t>(y * size + x), 0);
            if (paint == Paint::Ramp) value = s;
            if (paint == Paint::Checks) value = ((x / 8 + y / 8) % 2 == 0) ? 1.0f : 0.0f;
            if (paint == Paint::Blot) value = std::hypot(s - 0.5f, t - 0.4f) < 0.2f ? 1.0f : 0.0f;
            map.setTexel(x, y, 0, value);
        }
    }
    return map;
}

Groom groomWith(SurfaceMesh mesh, Paint paint, int size = 64) {
    Groom groom = makeGroom(std::move(mesh));
    if (paint != Paint::None) {
        groom.maps.set("density", painted(paint, size));
        groom.groups.edit()[0].params.general.density = {1.0f, "density"};
    }
    return groom;
}

SubTriangleSampler build(const Groom& groom, float gridPercent = 100.0f, int maxDepth = 10) {
    Progress progress;
    const DensityLookup density(groom);
    auto sampler =
        SubTriangleSampler::build(*groom.mesh, density, {.gridPercent = gridPercent, .maxDepth = maxDepth}, progress);
    return std::move(*sampler);
}

// Standard deviations that chi-square lies above what it should be (Wilson and Hilferty).
double chiSquareExcess(const std::vector<double>& expected, const std::vector<double>& found) {
    double sum = 0.0;
    double pooledExpected = 0.0;
    double pooledFound = 0.0;
    int bins = 0;
    const auto add = [&](double e, double f) {
        sum += (f - e) * (f - e) / e;
        ++bins;
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        pooledExpected += expected[i];
        pooledFound += found[i];
        if (pooledExpected < 20.0) continue;
        add(pooledExpected, pooledFound);
        pooledExpected = pooledFound = 0.0;
    }
    const double k = bins - 1;
    return (std::cbrt(sum / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

}  // namespace

class SubTriangleSamplerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void smoke() {
        const Groom groom = groomWith(testing::sphere(20, 30), Paint::Noise);
        const SubTriangleSampler sampler = build(groom);
        QVERIFY(sampler.total() > 0.0);
        std::vector<double> expected;
        std::vector<double> found(sampler.subTriangles().size(), 0.0);
        const int count = 400000;
        for (const auto& sub : sampler.subTriangles())
            expected.push_back(static_cast<double>(sub.weight) / sampler.total() * count);
        for (std::uint64_t i = 0; i < count; ++i) found[sampler.select(unitDouble(randomBits(1, i, 0)))] += 1.0;
        QVERIFY(std::abs(chiSquareExcess(expected, found)) < 4.5);
        Progress progress;
        const auto roots = evenRoots(*groom.mesh, sampler, 200, 1, progress);
        QCOMPARE(roots->size(), std::size_t{200});
    }
};

QTEST_APPLESS_MAIN(SubTriangleSamplerTest)
#include "sub_triangle_sampler_test.moc"
