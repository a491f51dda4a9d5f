// SPDX-License-Identifier: Apache-2.0
// A 64-bit digest of bytes, for checksums and for "the same hair" proofs. Not for secrets.
#pragma once

#include "core/base/random.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace whorl {

/// Streams bytes into a 64-bit digest. Depends on the bytes and their order only, not on how they were cut into calls.
class Hasher {
public:
    void add(const void* data, std::size_t bytes) {
        const auto* p = static_cast<const unsigned char*>(data);
        m_bytes += bytes;
        while (bytes > 0) {
            if (m_fill == 0 && bytes >= 8) {
                std::uint64_t word = 0;
                std::memcpy(&word, p, 8);
                absorb(word);
                p += 8;
                bytes -= 8;
                continue;
            }
            m_tail |= std::uint64_t{*p++} << (8 * m_fill);
            --bytes;
            if (++m_fill == 8) {
                absorb(m_tail);
                m_tail = 0;
                m_fill = 0;
            }
        }
    }

    std::uint64_t digest() const {
        return mix64((m_state ^ mix64(m_tail + 0x632be59bd9b4e019ull)) + m_bytes * 0x9e3779b97f4a7c15ull);
    }

private:
    void absorb(std::uint64_t word) { m_state = mix64(m_state ^ word) + 0x9e3779b97f4a7c15ull; }

    std::uint64_t m_state = 0x2545f4914f6cdd1dull;
    std::uint64_t m_tail = 0;
    std::uint64_t m_bytes = 0;
    unsigned m_fill = 0;
};

inline std::uint64_t hashBytes(const void* data, std::size_t bytes) {
    Hasher hasher;
    hasher.add(data, bytes);
    return hasher.digest();
}

/// Sixteen lower-case hexadecimal digits.
std::string hexDigest(std::uint64_t digest);

}  // namespace whorl
