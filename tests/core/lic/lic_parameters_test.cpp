// SPDX-License-Identifier: Apache-2.0
// Laws of what parameters and sizes of hair texture do.
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <cmath>

using namespace whorl;
using namespace whorl::testing;

namespace {

SurfaceMesh ball() {
    return testing::sphere(64, 96, 0.1f);
}

struct Statistics {
    double mean = 0, deviation = 0;
};

}  // namespace

class LicParametersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void parametersDoWhatTheySay() {
        LicScene scene(testing::plane(6, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0}}});
        const LicPainter painter = painterFor(scene, 256);
        const float texel = painter.atlas().usualTexel();
        QVERIFY(std::abs(texel - 0.2f / 256.0f) < 1e-6f);
        LicTexture texture;
        const auto paint = [&](float length, float grain, float white) {
            scene.lic().length.value = length * texel;
            scene.lic().grain.value = grain * texel;
            scene.lic().white = white;
            texture = painted(painter, scene);
        };
        const auto light = [&](int x, int y) {
            return (*texture.light)[static_cast<std::size_t>(y * 256 + x)] / 255.0;
        };
        const auto statistics = [&] {
            Statistics s;
            std::size_t count = 0;
            for (int y = 40; y < 216; ++y) {
                for (int x = 60; x < 196; ++x, ++count) {
                    s.mean += light(x, y);
                    s.deviation += light(x, y) * light(x, y);
                }
            }
            s.mean /= static_cast<double>(count);
            s.deviation = std::sqrt(s.deviation / static_cast<double>(count) - s.mean * s.mean);
            return s;
        };
        const auto alike = [&](int dx, int dy) {
            std::vector<double> a, b;
            for (int y = 40; y < 216; ++y) {
                for (int x = 60; x < 196; ++x) {
                    a.push_back(light(x, y));
                    b.push_back(light(x + dx, y + dy));
                }
            }
            return correlation(a, b);
        };
        // Share of white is the mean; mean and deviation are as announced.
        for (const float white : {0.1f, 0.5f, 0.85f}) {
            paint(20.0f, 2.0f, white);
            const Statistics s = statistics();
            QVERIFY2(std::abs(s.mean - static_cast<double>(white)) < 0.02, qPrintable(QString::number(s.mean)));
            QCOMPARE(texture.mean, white);
            QVERIFY2(std::abs(s.deviation / static_cast<double>(texture.deviation) - 1.0) < 0.25,
                     qPrintable(QString("%1 %2").arg(s.deviation).arg(static_cast<double>(texture.deviation))));
        }
        // Length: alike along the hair over more of it. Grain: alike across.
        paint(10.0f, 2.0f, 0.5f);
        const double shortAlong = alike(8, 0), thinAcross = alike(0, 2);
        paint(40.0f, 2.0f, 0.5f);
        const double longAlong = alike(8, 0);
        paint(20.0f, 6.0f, 0.5f);
        const double thickAcross = alike(0, 2);
        QVERIFY2(longAlong > 0.8 && longAlong > shortAlong + 0.2,
                 qPrintable(QString("%1 %2").arg(shortAlong).arg(longAlong)));
        QVERIFY2(thickAcross > 0.5 && std::abs(thinAcross) < 0.15,
                 qPrintable(QString("%1 %2").arg(thinAcross).arg(thickAcross)));
        // Over few texels soft ends change less than hard ones.
        paint(20.0f, 2.0f, 0.5f);
        const double soft = alike(4, 0);
        scene.lic().kernel.index = 1;
        paint(20.0f, 2.0f, 0.5f);
        const double box = alike(4, 0), farBox = alike(12, 0);
        QVERIFY2(std::abs(farBox - (1.0 - 12.0 / 41.0)) < 0.06 && soft > box + 0.01,
                 qPrintable(QString("%1 %2 %3").arg(soft).arg(box).arg(farBox)));
        const std::vector<std::uint8_t> first = *texture.light;
        scene.lic().seed = 2;
        paint(20.0f, 2.0f, 0.5f);
        QVERIFY(*texture.light != first);
        // No length: noise as it is.
        paint(0.0f, 4.0f, 0.5f);
        QVERIFY(std::abs(statistics().deviation - 0.45) < 0.05);
    }

    void mapsScaleLengthAndGrainPlaceByPlace() {
        LicScene scene(testing::plane(6, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0}}});
        const LicPainter painter = painterFor(scene, 256);
        const float texel = painter.atlas().usualTexel();
        scene.lic().length = {30.0f * texel, "length"};
        scene.lic().grain = {4.0f * texel, "grain"};
        scene.groom.maps.set("length", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        scene.groom.maps.set("grain", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        const LicTexture all = painted(painter, scene);
        scene.groom.maps.set("length", Map(16, 16, 1, TexelFormat::F32, 0.2f));
        const LicTexture shorter = painted(painter, scene);
        scene.groom.maps.set("length", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        scene.groom.maps.set("grain", Map(16, 16, 1, TexelFormat::F32, 0.5f));
        const LicTexture finer = painted(painter, scene);
        // As if the parameters said so themselves.
        scene.lic().grain = {2.0f * texel, ""};
        const LicTexture fine = painted(painter, scene);
        scene.lic().grain = {4.0f * texel, ""};
        scene.lic().length = {6.0f * texel, ""};
        const LicTexture brief = painted(painter, scene);
        const auto alike = [&](const LicTexture& a, const LicTexture& b) {
            std::vector<double> x, y;
            for (std::size_t i = 256 * 60; i < 256 * 200; ++i) {
                x.push_back((*a.light)[i]);
                y.push_back((*b.light)[i]);
            }
            return correlation(x, y);
        };
        QVERIFY2(alike(shorter, brief) > 0.97, qPrintable(QString::number(alike(shorter, brief))));
        QVERIFY(alike(all, brief) < 0.8);
        QVERIFY2(alike(finer, fine) > 0.9, qPrintable(QString::number(alike(finer, fine))));
        QVERIFY(alike(all, fine) < 0.3);
    }

    void smallTexturesLookLikeBigOnes() {
        LicScene scene(ball(), aroundTheBall);
        scene.lic().grain.value = 0.0012f;
        scene.lic().length.value = 0.012f;
        const LicTexture big = painted(painterFor(scene, 1024), scene);
        const LicTexture little = painted(painterFor(scene, 256), scene);
        std::vector<double> averaged, made;
        for (int y = 64; y < 192; ++y) {
            for (int x = 4; x < 252; ++x) {
                double sum = 0;
                for (int i = 0; i < 16; ++i)
                    sum += (*big.light)[static_cast<std::size_t>((y * 4 + i / 4) * 1024 + x * 4 + i % 4)] / 16.0;
                averaged.push_back(sum);
                made.push_back((*little.light)[static_cast<std::size_t>(y * 256 + x)]);
            }
        }
        QVERIFY2(correlation(averaged, made) > 0.8, qPrintable(QString::number(correlation(averaged, made))));
        QVERIFY(std::abs(big.mean - little.mean) < 1e-6f && little.deviation < big.deviation);
    }
};

QTEST_GUILESS_MAIN(LicParametersTest)
#include "lic_parameters_test.moc"
