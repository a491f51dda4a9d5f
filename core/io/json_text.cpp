// SPDX-License-Identifier: Apache-2.0
#include "core/io/json_text.h"

#include <algorithm>

namespace whorl {
namespace {

using nlohmann::json;

// A byte b that is no UTF-8 becomes the private character escapeBase + b; real ones of these are escaped bytewise too.
constexpr std::uint32_t escapeBase = 0x10f700;

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  ///< 0: not UTF-8
};

Character characterAt(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    if (first < 0x80) return {first, 1};
    const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || at + bytes > text.size()) return {};
    std::uint32_t code = first & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80) return {};
        code = (code << 6) | (byte(at + i) & 0x3fu);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (code < least[bytes] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {};
    return {code, bytes};
}

bool isEscape(std::uint32_t code) {
    return code >= escapeBase + 0x80 && code <= escapeBase + 0xff;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const Character character = characterAt(text, at);
        if (character.bytes > 0 && !isEscape(character.code)) {
            result.append(text, at, character.bytes);
            at += character.bytes;
            continue;
        }
        const std::size_t last = at + std::max<std::size_t>(character.bytes, 1);
        for (; at < last; ++at) {
            const std::uint32_t code = escapeBase + static_cast<unsigned char>(text[at]);
            result += static_cast<char>(0xf0 | (code >> 18));
            result += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
            result += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
            result += static_cast<char>(0x80 | (code & 0x3f));
        }
    }
    return result;
}

std::string unescaped(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const Character character = characterAt(text, at);
        if (isEscape(character.code)) {
            result += static_cast<char>(character.code - escapeBase);
        } else {
            result.append(text, at, std::max<std::size_t>(character.bytes, 1));
        }
        at += std::max<std::size_t>(character.bytes, 1);
    }
    return result;
}

/// Strings with another text; keys too. `value` is not deeper than maxJsonDepth.
json changed(const json& value, std::string (*change)(const std::string&)) {
    if (value.is_string()) return change(value.get_ref<const std::string&>());
    if (value.is_array()) {
        json result = json::array();
        for (const json& entry : value) result.push_back(changed(entry, change));
        return result;
    }
    if (value.is_object()) {
        json result = json::object();
        for (const auto& [key, entry] : value.items()) result[change(key)] = changed(entry, change);
        return result;
    }
    return value;
}

int depthOf(std::string_view text) {
    int depth = 0, deepest = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            if (c == '"') inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

}  // namespace

Result<json> parseJson(std::string_view text, const std::string& name) {
    if (depthOf(text) > maxJsonDepth)
        return Error{name + ": its JSON is nested more than " + std::to_string(maxJsonDepth) + " deep."};
    json value = json::parse(text.begin(), text.end(), nullptr, false);
    if (value.is_discarded()) return Error{name + ": its JSON is broken."};
    return changed(value, unescaped);
}

std::string jsonText(const json& value, int indent) {
    return changed(value, escaped).dump(indent);
}

void reportUnknownKeys(const json& object, std::initializer_list<std::string_view> known, const std::string& where,
                       Problems& problems) {
    if (!object.is_object()) return;
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), std::string_view(key)) == known.end())
            problems.push_back(where + ": unknown key \"" + key + "\"; left out.");
    }
}

}  // namespace whorl
