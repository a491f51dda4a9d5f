// SPDX-License-Identifier: Apache-2.0
// Large arrays of plain numbers: memory that nobody writes before its content is made.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace whorl {

/// Memory for a PlainVector: large pages where that pays. Throws std::bad_alloc.
void* allocatePlain(std::size_t bytes);
void freePlain(void* memory, std::size_t bytes) noexcept;

/// Leaves new elements of plain types as the memory is, so that resize() costs nothing and the threads that fill the
/// elements are the first to touch their pages.
template <class T>
struct PlainAllocator {
    using value_type = T;
    PlainAllocator() = default;
    template <class U>
    explicit PlainAllocator(const PlainAllocator<U>&) noexcept {}
    T* allocate(std::size_t count) { return static_cast<T*>(allocatePlain(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t count) noexcept { freePlain(memory, count * sizeof(T)); }
    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Args>
    void construct(U* place, Args&&... args) {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    template <class U>
    bool operator==(const PlainAllocator<U>&) const noexcept {
        return true;
    }
};

/// A vector of plain numbers whose resize() does not set them.
template <class T>
using PlainVector = std::vector<T, PlainAllocator<T>>;

/// Memory that begins with a cache line.
template <class T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t line{64};
    LineAllocator() = default;
    template <class U>
    explicit LineAllocator(const LineAllocator<U>&) noexcept {}
    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), line)); }
    void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, line); }
    template <class U>
    bool operator==(const LineAllocator<U>&) const noexcept {
        return true;
    }
};

/// Rows of numbers for kernels, which take a cache line at once.
using LineVector = std::vector<float, LineAllocator<float>>;

}  // namespace whorl
