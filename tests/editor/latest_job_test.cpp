// SPDX-License-Identifier: Apache-2.0
// Background work: only the newest waits, cancelled work ends, hair arrives in order.
#include "editor/app/latest_job.h"

#include "editor/app/hair_job.h"
#include "tests/support/shapes.h"

#include <QSignalSpy>
#include <QTest>
#include <atomic>

using namespace whorl;

namespace {

void until(const std::atomic<bool>& flag) {
    while (!flag) std::this_thread::yield();
}

}  // namespace

class LatestJobTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void onlyTheNewestOfThoseThatWaitRuns() {
        LatestJob job;
        std::atomic<bool> started{false};
        std::atomic<bool> go{false};
        std::atomic<int> ran{0};
        std::atomic<int> last{0};
        job.submit(
            [&](Progress&) {
                started = true;
                until(go);
            },
            LatestJob::Running::Finish);
        until(started);
        for (int i = 1; i <= 50; ++i) {
            job.submit(
                [&, i](Progress&) {
                    ++ran;
                    last = i;
                },
                LatestJob::Running::Finish);
        }
        go = true;
        job.wait();
        QCOMPARE(ran.load(), 1);
        QCOMPARE(last.load(), 50);
        QVERIFY(!job.busy());
    }

    void newerWorkCancelsOlder() {
        LatestJob job;
        std::atomic<bool> started{false};
        std::atomic<bool> cancelled{false};
        job.submit(
            [&](Progress& progress) {
                started = true;
                while (!progress.cancelled()) std::this_thread::yield();
                cancelled = true;
            },
            LatestJob::Running::Finish);
        until(started);
        job.submit([](Progress&) {}, LatestJob::Running::Cancel);
        job.wait();
        QVERIFY(cancelled);
    }

    void theEndCancels() {
        std::atomic<bool> started{false};
        std::atomic<bool> ended{false};
        {
            LatestJob job;
            job.submit(
                [&](Progress& progress) {
                    started = true;
                    while (!progress.cancelled()) std::this_thread::yield();
                    ended = true;
                },
                LatestJob::Running::Finish);
            until(started);
        }
        QVERIFY(ended);
    }

    void theLastHairIsOfTheLastRequest() {
        HairJob job;
        std::vector<std::size_t> counts;
        connect(&job, &HairJob::delivered, this,
                [&](std::shared_ptr<const Strands> strands) { counts.push_back(strands->count()); });
        const Groom groom = testing::groomOn(testing::sphere(12, 18), 60);
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        for (std::uint32_t hairs = 100; hairs <= 2000; hairs += 100)
            job.request(groom, surface, {.hairCount = hairs}, hairs % 200 == 0);
        QTRY_VERIFY(!job.busy());
        QVERIFY(!counts.empty());
        QCOMPARE(counts.back(), std::size_t{2000});
        QVERIFY(std::is_sorted(counts.begin(), counts.end()));
    }

    void withoutGuidesThereIsNoHair() {
        HairJob job;
        std::size_t count = 1;
        connect(&job, &HairJob::delivered, this,
                [&](std::shared_ptr<const Strands> strands) { count = strands->count(); });
        const Groom groom = makeGroom(testing::sphere(6, 8));
        job.request(groom, std::make_shared<const Surface>(groom.mesh), {.hairCount = 500}, false);
        QTRY_VERIFY(!job.busy());
        QCOMPARE(count, std::size_t{0});
    }
};

QTEST_GUILESS_MAIN(LatestJobTest)
#include "latest_job_test.moc"
