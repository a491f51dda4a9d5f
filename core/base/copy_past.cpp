// SPDX-License-Identifier: Apache-2.0
#include "core/base/copy_past.h"

#include "core/base/quads.h"

#include <cstdint>
#include <cstring>

namespace whorl {

void copyPast(const void* from, void* to, std::size_t bytes) {
    constexpr std::size_t line = 64, few = 16 * line, ahead = 16 * line;
    const auto* source = static_cast<const char*>(from);
    auto* target = static_cast<char*>(to);
    const std::size_t head = (line - reinterpret_cast<std::uintptr_t>(target) % line) % line;
    // Floats are read and written whole.
    if (bytes < few || head % sizeof(float) != 0) {
        std::memcpy(target, source, bytes);
        return;
    }
    std::memcpy(target, source, head);
    const std::size_t end = head + (bytes - head) / line * line;
    for (std::size_t at = head; at < end; at += line) {
        quads::fetchOnce(source + at + ahead);
        quads::Quad four[4];
        std::memcpy(four, source + at, line);
        for (std::size_t i = 0; i < 4; ++i)
            quads::storePast(four[i], reinterpret_cast<float*>(target + at + i * sizeof(quads::Quad)));
    }
    quads::storesPastDone();
    std::memcpy(target + end, source + end, bytes - end);
}

}  // namespace whorl
