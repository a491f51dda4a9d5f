// SPDX-License-Identifier: Apache-2.0
// Laws of the ribbons that the processor draws: area, joints, depth, order; the same for any threads and instructions.
#include "render/passes/strand_raster.h"

#include "core/base/parallel.h"
#include "core/base/random.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numeric>

using namespace whorl;

namespace {

constexpr glm::ivec2 size(200, 130);

RasterPoint point(float x, float y, float half = 1.0f, float opacity = 1.0f, float depth = 0.5f) {
    return {x, y, depth, half, {0.5f, 0.25f, 1.0f, opacity}};
}

/// The layer, premultiplied red, green, blue, opacity as floats; zero outside the region.
std::vector<float> layerOf(const std::vector<RasterPoint>& points, const std::vector<std::uint32_t>& segments,
                           const std::vector<float>& depth) {
    StrandRaster raster;
    raster.begin(size, depth, 0.5f);
    raster.add(points, segments);
    raster.draw();
    std::vector<float> layer(static_cast<std::size_t>(size.x * size.y) * 4, 0.0f);
    const StrandRaster::Region region = raster.region();
    for (int y = 0; y < region.height; ++y) {
        for (int i = 0; i < region.width * 4; ++i) {
            const std::uint16_t texel = raster.texels()[static_cast<std::size_t>(y * size.x * 4 + i)];
            layer[static_cast<std::size_t>(((y + region.y) * size.x + region.x) * 4 + i)] =
                static_cast<float>(texel) / 65535.0f * StrandRaster::brightest;
        }
    }
    return layer;
}

double sumOf(const std::vector<float>& layer, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < layer.size(); i += 4) sum += static_cast<double>(layer[i]);
    return sum;
}

std::vector<float> far() {
    return std::vector<float>(static_cast<std::size_t>(size.x * size.y), 1.0f);
}

struct Tangle {
    std::vector<RasterPoint> points;
    std::vector<std::uint32_t> segments;
};

Tangle tangle(int hairs) {
    Tangle all;
    for (int i = 0; i < hairs; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        float x = randomFloat(1, index, 0) * 240.0f - 20.0f;
        float y = randomFloat(1, index, 1) * 170.0f - 20.0f;
        for (std::uint64_t j = 0; j < 8; ++j) {
            if (j > 0) all.segments.push_back(static_cast<std::uint32_t>(all.points.size()) - 1);
            all.points.push_back(point(x, y, 0.3f + 2.0f * randomFloat(2, index, j), randomFloat(3, index, j),
                                       randomFloat(4, index, j)));
            x += randomFloat(5, index, j) * 30.0f - 15.0f;
            y += randomFloat(6, index, j) * 30.0f - 15.0f;
        }
    }
    return all;
}

}  // namespace

class StrandRasterTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void areaIsLengthTimesWidth() {
        for (int i = 0; i < 40; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / 40.0f;
            const float half = 0.5f + 0.1f * static_cast<float>(i % 10);
            const RasterPoint a = point(100.3f, 65.7f, half);
            const RasterPoint b = point(100.3f + 50.0f * std::cos(angle), 65.7f + 50.0f * std::sin(angle), half);
            const std::vector<float> layer = layerOf({a, b}, {0}, far());
            const double area = sumOf(layer, 3);
            QVERIFY2(std::abs(area - 100.0 * static_cast<double>(half)) < 4.0 * static_cast<double>(half),
                     qPrintable(QString("%1 %2 %3").arg(i).arg(area).arg(half)));
            QVERIFY(std::abs(sumOf(layer, 0) / area - 0.5) < 0.01);
        }
    }

    void joinedPiecesAreOneRibbon() {
        std::vector<RasterPoint> pieces;
        std::vector<std::uint32_t> segments(20);
        std::iota(segments.begin(), segments.end(), 0u);
        for (int i = 0; i <= 20; ++i) {
            const float t = static_cast<float>(i) / 20.0f;
            pieces.push_back(point(20.0f + 130.0f * t, 15.0f + 90.0f * t, 1.2f, 0.5f));
        }
        const std::vector<float> many = layerOf(pieces, segments, far());
        const std::vector<float> one = layerOf({pieces.front(), pieces.back()}, {0}, far());
        for (std::size_t i = 0; i < one.size(); ++i) QVERIFY(std::abs(one[i] - many[i]) < 0.01f);
    }

    void depthHides() {
        const std::vector<RasterPoint> line{point(10, 60, 1.5f, 1.0f, 0.4f), point(190, 60, 1.5f, 1.0f, 0.4f)};
        std::vector<float> depth = far();
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < 100; ++x) depth[static_cast<std::size_t>(y * size.x + x)] = 0.3f;
        }
        const std::vector<float> layer = layerOf(line, {0}, depth);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < 100; ++x) QCOMPARE(layer[static_cast<std::size_t>(y * size.x + x) * 4 + 3], 0.0f);
        }
        QVERIFY(sumOf(layer, 3) > 250);
    }

    void laterSegmentsLieOver() {
        std::vector<RasterPoint> points{point(100, 10, 3), point(100, 120, 3), point(10, 60, 3), point(190, 60, 3)};
        for (int i : {2, 3}) points[static_cast<std::size_t>(i)].colour[0] = 0.9f;
        const std::size_t crossing = (60 * 200 + 100) * 4;
        QVERIFY(std::abs(layerOf(points, {0, 2}, far())[crossing] - 0.9f) < 0.01f);
        QVERIFY(std::abs(layerOf(points, {2, 0}, far())[crossing] - 0.5f) < 0.01f);
    }

    void sameForAnyThreadsAndInstructions() {
        const Tangle all = tangle(3000);
        std::vector<float> depth = far();
        for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = randomFloat(9, i, 0);
        const SimdLevel best = bestSimdLevel();
        const std::vector<float> expected = layerOf(all.points, all.segments, depth);
        QVERIFY(sumOf(expected, 3) > 1000);
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            if (level > best) continue;
            setSimdLevel(level);
            for (const unsigned threads : {1u, 2u, 5u}) {
                const ThreadLimit limit(threads);
                QVERIFY(layerOf(all.points, all.segments, depth) == expected);
            }
        }
        setSimdLevel(best);
    }

    void oddPointsDoNoHarm() {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float inf = std::numeric_limits<float>::infinity();
        const std::vector<RasterPoint> points{point(nan, 10),      point(50, nan),   point(inf, 10),
                                              point(10, -inf),     point(-1e8f, 20), point(1e8f, 30),
                                              point(5, 5, -1),     point(90, 90),    point(40.0f, 40.0f),
                                              point(40.0f, 40.0f), point(-50, -50),  point(-20, -9)};
        std::vector<std::uint32_t> segments(points.size() - 1);
        std::iota(segments.begin(), segments.end(), 0u);
        for (const float value : layerOf(points, segments, far())) QVERIFY(value >= 0.0f && value <= 1.1f);
        QCOMPARE(sumOf(layerOf({}, {}, far()), 3), 0.0);
    }
};

QTEST_GUILESS_MAIN(StrandRasterTest)
#include "strand_raster_test.moc"
