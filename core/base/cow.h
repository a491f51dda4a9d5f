// SPDX-License-Identifier: Apache-2.0
// A value that copies share until one of them edits it.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace whorl {

/// To be called when `use_count` of `pointer` is 1 and before its value is written: pairs with the release when another
/// thread dropped the last other copy, so that its reads come before our writes.
template <class T>
void acquireSole(const std::shared_ptr<T>& pointer) {
#if defined(__SANITIZE_THREAD__)
    // The sanitizer knows no fences. Counting up and down again has the same order.
    const std::shared_ptr<T> counted = pointer;
#else
    static_cast<void>(pointer);
    std::atomic_thread_fence(std::memory_order_acquire);
#endif
}

/// Implicitly shared value. Copying costs a counter; `edit` makes this copy its own first.
/// A default-made Cow shares one empty T with all others, so two empty ones are `sameAs`.
/// Thread rule: one Cow object belongs to one thread at a time; copies of it may live and be read in other threads.
template <class T>
class Cow {
public:
    Cow() : m_data(emptyValue()) {}
    Cow(T value) : m_data(std::make_shared<T>(std::move(value))) {}

    const T& operator*() const { return *m_data; }
    const T* operator->() const { return m_data.get(); }
    const T& read() const { return *m_data; }

    /// The value, for writing; copied first when shared. The reference is good until this Cow is copied.
    T& edit() {
        if (m_data.use_count() != 1) {
            m_data = std::make_shared<T>(*m_data);
        } else {
            acquireSole(m_data);
        }
        return *m_data;
    }

    /// True when both share one value: nothing can differ. False says nothing about equality.
    bool sameAs(const Cow& other) const { return m_data == other.m_data; }

    /// Shared reading from another thread, kept alive by the returned pointer.
    std::shared_ptr<const T> share() const { return m_data; }

private:
    static const std::shared_ptr<T>& emptyValue() {
        static const std::shared_ptr<T> empty = std::make_shared<T>();
        return empty;
    }

    std::shared_ptr<T> m_data;
};

}  // namespace whorl
