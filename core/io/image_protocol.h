// SPDX-License-Identifier: Apache-2.0
// What whorl and whorl-image-worker say to each other. Both come from one build, so plain structs do.
#pragma once

#include <cstdint>

namespace whorl::image_protocol {

// Reading: `whorl-image-worker read PLUGIN data|colour`, the image file as descriptor 0, the answer on descriptor 1:
// an Answer, then `bytes` of pixels (rows from the top, native byte order) or of an error text.
// Writing: `whorl-image-worker write PLUGIN PATH`, a Request and its pixels as descriptor 0, an Answer on descriptor 1.

constexpr std::uint32_t maxSize = 16384;
constexpr std::uint64_t maxDecodedBytes = 512ull << 20;
constexpr std::uint64_t maxMemoryBytes = 2ull << 30;
constexpr int maxSeconds = 20;
/// Processor time for the header alone, metadata included: some metadata takes OpenImageIO's parser very long.
constexpr int maxHeaderMilliseconds = 700;
constexpr std::uint32_t maxErrorBytes = 4096;
constexpr std::uint32_t answerMagic = 0x31474d57;   // "WMG1"
constexpr std::uint32_t requestMagic = 0x32474d57;  // "WMG2"

/// Texel formats have the numbers of whorl::TexelFormat: 0 = 8 bit, 1 = 16 bit, 2 = float.
constexpr std::uint32_t formatBytes(std::uint32_t format) {
    return format == 0 ? 1u : format == 1 ? 2u : 4u;
}

struct Answer {
    std::uint32_t magic = answerMagic;
    std::uint32_t failed = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;
    std::uint32_t format = 0;
    std::uint64_t notANumber = 0;  ///< texels that became 0
    std::uint64_t infinite = 0;    ///< texels that became the largest finite one
    std::uint64_t negative = 0;    ///< texels that became 0
    std::uint64_t bytes = 0;
};

struct Request {
    std::uint32_t magic = requestMagic;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;
    std::uint32_t format = 0;
    std::uint32_t srgb = 0;  ///< the numbers are sRGB-encoded colour
    std::uint32_t half = 0;  ///< floats are stored as half floats
};

}  // namespace whorl::image_protocol
