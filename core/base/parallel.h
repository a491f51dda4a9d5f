// SPDX-License-Identifier: Apache-2.0
// Loops over blocks on all cores. Results never depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace whorl {

/// Calls `body(begin, end)` for consecutive blocks of at most `grain` items that cover [0, count), from a persistent
/// pool of threads. Blocks always start at multiples of `grain`, however many threads there are, so a body may keep
/// its result by block. `body` must not throw.
void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

/// While it lives, loops that the calling thread starts run in it alone: for hosts that call from all of their threads.
class OneThread {
public:
    OneThread();
    ~OneThread();
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;
};

/// Limits all parallel work of the process to `threads` while it lives; 0 means all cores.
class ThreadLimit {
public:
    explicit ThreadLimit(unsigned threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    void* m_control = nullptr;
};

}  // namespace whorl
