// SPDX-License-Identifier: Apache-2.0
// Laws: a prepared groom gives the hair of a generator, part by part, in any number of threads at once.
#include "core/hair/prepared.h"

#include "tests/support/shapes.h"

#include <QTest>
#include <thread>

using namespace whorl;

namespace {

std::uint64_t digestOf(const PreparedGroom& prepared, const GenerateOptions& options, std::uint32_t blockSize) {
    Progress progress;
    Hasher hasher;
    const auto made = prepared.stream(
        options, blockSize,
        [&](const Strands& block) {
            block.addTo(hasher);
            return true;
        },
        progress);
    return made ? hasher.digest() : 0;
}

}  // namespace

class PreparedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void manyThreadsGiveTheSameHair() {
        for (std::uint32_t seed = 0; seed < 6; ++seed) {
            const Groom groom = testing::randomGroom(seed);
            Progress progress;
            const auto prepared = PreparedGroom::make(groom, progress);
            QVERIFY(prepared.ok());
            Generator generator;
            std::vector<std::uint64_t> expected(5), made(10);
            for (std::uint32_t part = 0; part < 5; ++part) {
                Hasher hasher;
                generator.generate(groom, {.part = part, .partCount = 5}, progress)->addTo(hasher);
                expected[part] = hasher.digest();
            }
            std::vector<std::thread> threads;
            for (std::uint32_t i = 0; i < made.size(); ++i)
                threads.emplace_back(
                    [&, i] { made[i] = digestOf(**prepared, {.part = i % 5, .partCount = 5}, i < 5 ? 4096 : 33); });
            for (std::thread& thread : threads) thread.join();
            for (std::size_t i = 0; i < made.size(); ++i) QCOMPARE(made[i], expected[i % 5]);
        }
    }

    void stopsWhenAsked() {
        Progress progress;
        const Groom groom = testing::groomOn(testing::sphere(8, 12), 20, 6);
        const auto prepared = PreparedGroom::make(groom, progress);
        int blocks = 0;
        const auto refused = (*prepared)->stream(
            {.hairCount = 1000}, 100, [&](const Strands&) { return ++blocks < 3; }, progress);
        QVERIFY(!refused.ok() && refused.error().cancelled);
        QCOMPARE(blocks, 3);
        progress.cancel();
        QVERIFY(!(*prepared)
                     ->stream(
                         {}, 100, [](const Strands&) { return true; }, progress)
                     .ok());
        QVERIFY(PreparedGroom::make(groom, progress).error().cancelled);
    }
};

QTEST_APPLESS_MAIN(PreparedTest)
#include "prepared_test.moc"
