// SPDX-License-Identifier: Apache-2.0
#include "core/io/plain_text.h"

#include <charconv>
#include <cstdint>
#include <limits>

namespace whorl {
namespace {

// Length in bytes of the well-formed UTF-8 character at the start of `text` and its number; 0 when there is none.
std::size_t character(std::string_view text, std::uint32_t& code) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t first = byte(0);
    if (first < 0x80) {
        code = first;
        return 1;
    }
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    code = first & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = (code << 6) | (byte(i) & 0x3fu);
    }
    const bool tooLong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    return tooLong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : length;
}

bool shown(std::uint32_t code) {
    const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029;
    const bool turnsDirection = code == 0x200e || code == 0x200f || code == 0x061c ||
                                (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return !control && !turnsDirection && code != 0xfeff;
}

}  // namespace

std::string plainText(std::string_view text, std::size_t maxBytes) {
    std::string out;
    while (!text.empty()) {
        std::uint32_t code = 0;
        const std::size_t length = character(text, code);
        if (length == 0) {
            if (out.size() + 1 > maxBytes) break;
            out += '?';
            text.remove_prefix(1);
            continue;
        }
        if (shown(code)) {
            if (out.size() + length > maxBytes) break;
            out += text.substr(0, length);
        } else if (code == '\t' || code == '\n') {
            out += ' ';
        }
        text.remove_prefix(length);
    }
    return out;
}

std::optional<float> parseFloat(std::string_view word) {
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
        if (!word.empty() && word.front() == '-') return std::nullopt;
    }
    float value = 0.0f;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        double wide = 0.0;  // tells too large from too small
        const auto again = std::from_chars(word.data(), word.data() + word.size(), wide);
        const bool small = again.ec == std::errc{} ? (wide < 1.0 && wide > -1.0) : word.find("e-") != word.npos;
        return small ? 0.0f : std::numeric_limits<float>::infinity();
    }
    if (error != std::errc{}) return std::nullopt;
    return value;
}

std::optional<long long> parseInteger(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

}  // namespace whorl
