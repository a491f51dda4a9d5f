// SPDX-License-Identifier: Apache-2.0
// A host that works in the thread pool of TBB, as the library does. Not built for the thread sanitizer, which does not
// see into TBB.
#include "tests/core/procedural/procedural_hair.h"
#include "tests/support/shapes.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <QTest>

using namespace whorl;
using namespace whorl::testing;
namespace fs = std::filesystem;

class ThreadPoolTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aHostMayWorkInTheSameThreadPool() {
        // Tasks of a host that all need the groom at once, in the pool that the library works in: the one that makes it
        // ready must not take up another of them while it waits for its own loops.
        const fs::path package = exported(randomGroom(3), scratchFolder("procedural-pool") / "a.groom", 4);
        const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
        tbb::task_arena pool(8);
        for (int round = 0; round < 10; ++round) {
            const Opened opened(package);
            std::vector<std::uint64_t> digests(64, 0);
            const auto make = [&](std::size_t i) {
                WhorlRequest request = WHORL_REQUEST_INIT;
                request.part = static_cast<std::uint32_t>(i % 4);
                request.share = 0.2f;
                whorl_digest(opened, &request, &digests[i], nullptr);
            };
            pool.execute([&] { tbb::parallel_for(std::size_t{0}, digests.size(), make); });
            for (std::size_t i = 4; i < digests.size(); ++i) QCOMPARE(digests[i], digests[i % 4]);
        }
    }
};

QTEST_APPLESS_MAIN(ThreadPoolTest)
#include "thread_pool_test.moc"
