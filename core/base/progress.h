// SPDX-License-Identifier: Apache-2.0
// How far long work is, and the wish to stop it.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace whorl {

/// Passed last to every function that can take longer than half a second. Thread-safe: the work reports from any of
/// its threads; the owner cancels from any thread. Work asks `cancelled()` at least every few milliseconds and then
/// returns `cancelledError()`.
class Progress {
public:
    using Listener = std::function<void(float fraction, std::string_view what)>;

    Progress() = default;
    /// `listener` is called from the working threads, at most once for each percent.
    explicit Progress(Listener listener) : m_listener(std::move(listener)) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void cancel() { m_cancelled.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return m_cancelled.load(std::memory_order_relaxed); }

    /// `fraction` from 0 to 1; `what` in words for the artist ("Writing part 3 of 8").
    void report(float fraction, std::string_view what) {
        if (!m_listener) return;
        const int percent = static_cast<int>(fraction * 100.0f);
        if (m_percent.exchange(percent, std::memory_order_relaxed) != percent) m_listener(fraction, what);
    }

private:
    Listener m_listener;
    std::atomic<bool> m_cancelled{false};
    std::atomic<int> m_percent{-1};
};

}  // namespace whorl
