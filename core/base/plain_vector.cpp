// SPDX-License-Identifier: Apache-2.0
#include "core/base/plain_vector.h"

#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace whorl {
namespace {

// From here on a page of two megabytes saves more faults than the rest of the last one costs.
constexpr std::size_t large = std::size_t{8} << 20;
constexpr std::size_t largePage = std::size_t{2} << 20;

}  // namespace

void* allocatePlain(std::size_t bytes) {
    if (bytes < large) return ::operator new(bytes);
    const std::size_t whole = (bytes + largePage - 1) / largePage * largePage;
    void* memory = whole < bytes ? nullptr : std::aligned_alloc(largePage, whole);
    if (!memory) throw std::bad_alloc();
#if defined(__linux__)
    // Only advice: without large pages everything works as well.
    static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
#endif
    return memory;
}

void freePlain(void* memory, std::size_t bytes) noexcept {
    if (bytes < large) {
        ::operator delete(memory);
    } else {
        std::free(memory);
    }
}

}  // namespace whorl
