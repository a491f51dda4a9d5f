// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#if defined(WHORL_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace whorl {
namespace {

// The thread sanitizer does not see into TBB, which no distribution builds for it, so the two promises that TBB makes
// are told to it here: a block sees what came before the call, and after the call all blocks are seen.
#if defined(WHORL_THREAD_SANITIZER)
struct Order {
    char before = 0, after = 0;
    Order() { __tsan_release(&before); }
    void blockBegins() { __tsan_acquire(&before); }
    void blockEnds() { __tsan_release(&after); }
    void allEnded() { __tsan_acquire(&after); }
};
#else
struct Order {
    void blockBegins() {}
    void blockEnds() {}
    void allEnded() {}
};
#endif

thread_local int loopsAlone = 0;

}  // namespace

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t blocks = (count + grain - 1) / grain;
    if (blocks == 1) {
        body(0, count);
        return;
    }
    if (loopsAlone > 0) {
        for (std::size_t block = 0; block < blocks; ++block) body(block * grain, std::min(count, (block + 1) * grain));
        return;
    }
    Order order;
    // Alone with itself: a host that runs on TBB as well may hold a lock around this call, and its own work, taken up
    // while this loop waits for its last block, would wait for that lock for ever.
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
            order.blockBegins();
            body(block * grain, std::min(count, (block + 1) * grain));
            order.blockEnds();
        });
    });
    order.allEnded();
}

OneThread::OneThread() {
    ++loopsAlone;
}

OneThread::~OneThread() {
    --loopsAlone;
}

ThreadLimit::ThreadLimit(unsigned threads) {
    if (threads == 0) return;
    // The pool keeps the size that it had at its first work; made under a limit it would stay that small.
    static const bool made = [] {
        tbb::parallel_for(0, 2, [](int) {});
        return true;
    }();
    if (made) m_control = new tbb::global_control(tbb::global_control::max_allowed_parallelism, threads);
}

ThreadLimit::~ThreadLimit() {
    delete static_cast<tbb::global_control*>(m_control);
}

}  // namespace whorl
