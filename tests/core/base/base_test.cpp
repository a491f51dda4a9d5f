// SPDX-License-Identifier: Apache-2.0
#include "core/base/copy_past.h"
#include "core/base/cow.h"
#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/random.h"
#include "core/base/result.h"
#include "core/base/simd.h"

#include <QtTest>
#include <algorithm>
#include <atomic>
#include <vector>

using namespace whorl;

class BaseTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void resultsHoldOneSide() {
        const Result<int> good(3);
        const Result<int> bad(Error{"file.png: not an image."});
        QVERIFY(good.ok() && !bad.ok());
        QCOMPARE(*good, 3);
        QCOMPARE(bad.error().message, std::string("file.png: not an image."));
        QVERIFY(cancelledError().cancelled);
    }

    void cowsShareUntilEdited() {
        Cow<std::vector<int>> a(std::vector<int>{1, 2, 3});
        const Cow<std::vector<int>> b = a;
        QVERIFY(a.sameAs(b));
        a.edit()[0] = 9;
        QVERIFY(!a.sameAs(b));
        QCOMPARE((*b)[0], 1);
        const auto* place = &a.read();
        a.edit()[1] = 9;
        QCOMPARE(&a.read(), place);
        QVERIFY(Cow<std::vector<int>>().sameAs(Cow<std::vector<int>>()));
    }

    void loopsCoverEverythingOnce() {
        for (const std::size_t count : {0u, 1u, 7u, 64u, 65u, 1000u}) {
            std::vector<std::atomic<int>> hits(count);
            parallelFor(count, 8, [&](std::size_t begin, std::size_t end) {
                QVERIFY(begin % 8 == 0 && end - begin <= 8);
                for (std::size_t i = begin; i < end; ++i) ++hits[i];
            });
            for (const auto& hit : hits) QCOMPARE(hit.load(), 1);
        }
    }

    void digestsDependOnBytesNotOnCuts() {
        std::vector<unsigned char> bytes(1000);
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(mix64(i));
        const std::uint64_t whole = hashBytes(bytes.data(), bytes.size());
        for (const std::size_t cut : {1u, 3u, 8u, 13u, 999u}) {
            Hasher hasher;
            for (std::size_t i = 0; i < bytes.size(); i += cut) {
                hasher.add(bytes.data() + i, std::min(cut, bytes.size() - i));
            }
            QCOMPARE(hasher.digest(), whole);
        }
        bytes[500] ^= 1;
        QVERIFY(hashBytes(bytes.data(), bytes.size()) != whole);
        QVERIFY(hashBytes(bytes.data(), 999) != hashBytes(bytes.data(), 1000));
        QCOMPARE(hexDigest(0x0123456789abcdefull), std::string("0123456789abcdef"));
    }

    void randomNumbersAreEvenAndStay() {
        double sum = 0.0;
        std::array<int, 16> bins{};
        for (std::uint32_t i = 0; i < 160000; ++i) {
            const float value = randomFloat(7, i, 2);
            QVERIFY(value >= 0.0f && value < 1.0f);
            sum += static_cast<double>(value);
            ++bins[static_cast<std::size_t>(value * 16.0f)];
        }
        QVERIFY(std::abs(sum / 160000 - 0.5) < 0.003);
        double chi = 0.0;
        for (const int bin : bins) chi += (bin - 10000.0) * (bin - 10000.0) / 10000.0;
        QVERIFY2(chi < 37.7, "chi-square of 15 degrees at 0.001");
        QVERIFY(randomBits(1, 2, 3) == randomBits(1, 2, 3));
        QVERIFY(randomBits(1, 2, 3) != randomBits(2, 2, 3));
        QVERIFY(randomBits(1, 2, 3) != randomBits(1, 2, 4));
    }

    void progressReportsAndStops() {
        int calls = 0;
        Progress progress([&](float, std::string_view) { ++calls; });
        for (int i = 0; i < 1000; ++i) progress.report(0.5f, "half");
        QCOMPARE(calls, 1);
        QVERIFY(!progress.cancelled());
        progress.cancel();
        QVERIFY(progress.cancelled());
    }

    void copiesPastTheCachesAreCopies() {
        // Every offset of both, whole lines and rests, and nothing around it is touched.
        std::vector<char> from(9000);
        for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<char>(i * 31 + i / 256);
        for (const std::size_t bytes : {0u, 1u, 63u, 1024u, 1025u, 4096u, 8191u})
            for (std::size_t a = 0; a < 20; ++a)
                for (std::size_t b = 0; b < 70; ++b) {
                    std::vector<char> to(9000, 'x');
                    copyPast(from.data() + a, to.data() + b, bytes);
                    QVERIFY(std::equal(from.begin() + a, from.begin() + a + bytes, to.begin() + b));
                    QVERIFY(std::all_of(to.begin(), to.begin() + b, [](char c) { return c == 'x'; }));
                    QVERIFY(std::all_of(to.begin() + b + bytes, to.end(), [](char c) { return c == 'x'; }));
                }
    }

    void theSimdLevelNeverPassesTheProcessor() {
        const SimdLevel before = simdLevel();
        setSimdLevel(SimdLevel::Avx512);
        QCOMPARE(simdLevel(), bestSimdLevel());
        setSimdLevel(SimdLevel::Plain);
        QCOMPARE(simdLevel(), SimdLevel::Plain);
        QCOMPARE(std::string(simdLevelName(SimdLevel::Plain)), std::string("plain"));
        setSimdLevel(before);
    }
};

QTEST_APPLESS_MAIN(BaseTest)
#include "base_test.moc"
