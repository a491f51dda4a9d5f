// SPDX-License-Identifier: Apache-2.0
// One thread that does the newest piece of work and forgets the ones that waited before it.
#pragma once

#include "core/base/progress.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace whorl {

/// Work runs in one thread, one piece at a time. At most one piece waits: the newest.
class LatestJob {
public:
    using Work = std::function<void(Progress&)>;
    /// What happens to the piece that runs when a newer one comes.
    enum class Running {
        Cancel,  ///< it is asked to stop: its result would be out of date
        Finish,  ///< it goes on: while the artist drags, a result of a moment ago is better than none
    };

    LatestJob();
    /// Cancels what runs, drops what waits, ends the thread.
    ~LatestJob();
    LatestJob(const LatestJob&) = delete;
    LatestJob& operator=(const LatestJob&) = delete;

    void submit(Work work, Running running);
    /// Returns when nothing runs or waits.
    void wait();
    bool busy() const;

private:
    void loop();

    mutable std::mutex m_mutex;
    std::condition_variable m_wake;
    std::condition_variable m_idle;
    Work m_waiting;
    std::shared_ptr<Progress> m_current;
    bool m_stop = false;
    std::thread m_thread;
};

}  // namespace whorl
