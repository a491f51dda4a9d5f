// SPDX-License-Identifier: Apache-2.0
#include "core/base/noise.h"

#include "core/base/polynomials.h"
#include "core/base/random.h"

#include <QtTest>
#include <cmath>

using namespace whorl;

class NoiseTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void isZeroAtWholeNumbers() {
        for (int i = -300; i < 300; i += 7) {
            const float at = static_cast<float>(i);
            float vector[3];
            perlinVector(at, at + 3.0f, -at, vector);
            for (const float component : vector) QCOMPARE(component, 0.0f);
        }
    }

    // The value that Perlin's published program gives.
    void hasTheKnownValue() { QVERIFY(std::abs(perlinNoise(3.14f, 42.0f, 7.0f) - 0.13691996f) < 1e-6f); }

    void isSmoothBoundedAndUncorrelated() {
        double sums[3] = {}, squares[3] = {}, products[3] = {};
        constexpr int count = 20000;
        for (std::uint64_t i = 0; i < count; ++i) {
            float at[3], here[3], near[3];
            for (std::uint32_t axis = 0; axis < 3; ++axis) at[axis] = 1000.0f * randomFloat(1, i, axis) - 500.0f;
            perlinVector(at[0], at[1], at[2], here);
            perlinVector(at[0] + 0.01f, at[1] - 0.01f, at[2] + 0.01f, near);
            QCOMPARE(here[0], perlinNoise(at[0], at[1], at[2]));
            for (int k = 0; k < 3; ++k) {
                QVERIFY(std::abs(here[k]) <= 1.1f);
                QVERIFY(std::abs(here[k] - near[k]) < 0.1f);
                sums[k] += double{here[k]};
                squares[k] += double{here[k]} * double{here[k]};
                products[k] += double{here[k]} * double{here[(k + 1) % 3]};
            }
        }
        for (int k = 0; k < 3; ++k) {
            const double deviation = std::sqrt(squares[k] / count);
            QVERIFY(deviation > 0.2 && deviation < 0.4);
            QVERIFY(std::abs(sums[k] / count) < 0.01);
            QVERIFY(std::abs(products[k] / count) < 0.03 * deviation * deviation * 3);
        }
    }

    void takesAnyNumber() {
        for (const float x : {1e9f, -1e9f, 3e38f, -3e38f}) QVERIFY(std::isfinite(perlinNoise(x, 0.5f, 0)));
    }

    void sineAndCosineAreRight() {
        for (int i = -628; i <= 628; ++i) {
            const double angle = i * 0.01;
            const SinCos both = sinCos(angle);
            QVERIFY(std::abs(both.sin - std::sin(angle)) < 1e-9);
            QVERIFY(std::abs(both.cos - std::cos(angle)) < 1e-9);
        }
    }
};

QTEST_APPLESS_MAIN(NoiseTest)
#include "noise_test.moc"
