// SPDX-License-Identifier: Apache-2.0
// Arrays and texts as pieces of a container. Include in codec sources only.
#pragma once

#include "core/io/container.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace whorl {

template <class T>
std::vector<std::uint8_t> bytesOf(const std::vector<T>& values) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(values.data());
    return {from, from + values.size() * sizeof(T)};
}

/// 32-bit length and bytes.
inline void appendText(std::vector<std::uint8_t>& bytes, const std::string& text) {
    const auto size = static_cast<std::uint32_t>(text.size());
    const auto* from = reinterpret_cast<const std::uint8_t*>(&size);
    bytes.insert(bytes.end(), from, from + sizeof size);
    bytes.insert(bytes.end(), text.begin(), text.end());
}

/// Takes a text off the front; false when it is cut short.
inline bool takeText(std::span<const std::uint8_t>& bytes, std::string& text) {
    std::uint32_t size = 0;
    if (bytes.size() < sizeof size) return false;
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes = bytes.subspan(sizeof size);
    if (size > bytes.size()) return false;
    text.assign(reinterpret_cast<const char*>(bytes.data()), size);
    bytes = bytes.subspan(size);
    return true;
}

/// Collects what is to be inflated, each into memory of the right size.
struct Wanted {
    Container& container;
    std::string& fault;
    std::vector<Container::Request> requests{};

    template <class T>
    void array(const Blob& blob, std::vector<T>& values) {
        if (!fault.empty()) return;
        if (blob.bytes % sizeof(T) != 0 || !container.claim(blob, blob.bytes)) {
            fault = "a piece that its table of contents names is not there.";
            return;
        }
        values.resize(static_cast<std::size_t>(blob.bytes / sizeof(T)));
        requests.push_back({blob, reinterpret_cast<std::uint8_t*>(values.data())});
    }
};

}  // namespace whorl
