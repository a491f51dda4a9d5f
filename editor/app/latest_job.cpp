// SPDX-License-Identifier: Apache-2.0
#include "editor/app/latest_job.h"

namespace whorl {

LatestJob::LatestJob() : m_thread([this] { loop(); }) {}

LatestJob::~LatestJob() {
    {
        const std::lock_guard lock(m_mutex);
        m_stop = true;
        m_waiting = nullptr;
        if (m_current) m_current->cancel();
    }
    m_wake.notify_all();
    m_thread.join();
}

void LatestJob::submit(Work work, Running running) {
    {
        const std::lock_guard lock(m_mutex);
        m_waiting = std::move(work);
        if (m_current && running == Running::Cancel) m_current->cancel();
    }
    m_wake.notify_one();
}

void LatestJob::wait() {
    std::unique_lock lock(m_mutex);
    m_idle.wait(lock, [this] { return !m_waiting && !m_current; });
}

bool LatestJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_waiting || m_current;
}

void LatestJob::loop() {
    std::unique_lock lock(m_mutex);
    while (true) {
        m_wake.wait(lock, [this] { return m_stop || m_waiting; });
        if (m_stop) return;
        Work work = std::move(m_waiting);
        m_waiting = nullptr;
        const auto progress = std::make_shared<Progress>();
        m_current = progress;
        lock.unlock();
        work(*progress);
        work = nullptr;  // what it held is freed before anyone hears that it is done
        lock.lock();
        m_current.reset();
        if (!m_waiting) m_idle.notify_all();
    }
}

}  // namespace whorl
