// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/ply_header.h"

#include "core/io/import/lines.h"
#include "core/io/plain_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace whorl::import {
namespace {

std::optional<PlyType> typeNamed(std::string_view word) {
    struct Name {
        std::string_view old, sized;
        PlyType type;
    };
    static constexpr Name names[] = {
        {"char", "int8", PlyType::I8},      {"uchar", "uint8", PlyType::U8},     {"short", "int16", PlyType::I16},
        {"ushort", "uint16", PlyType::U16}, {"int", "int32", PlyType::I32},      {"uint", "uint32", PlyType::U32},
        {"float", "float32", PlyType::F32}, {"double", "float64", PlyType::F64},
    };
    for (const Name& name : names) {
        if (word == name.old || word == name.sized) return name.type;
    }
    return std::nullopt;
}

std::size_t typeBytes(PlyType type) {
    switch (type) {
        case PlyType::I8:
        case PlyType::U8:
            return 1;
        case PlyType::I16:
        case PlyType::U16:
            return 2;
        case PlyType::F64:
            return 8;
        default:
            return 4;
    }
}

template <class T>
double valueOf(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

}  // namespace

int PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (const std::string_view wanted : names) {
        for (std::size_t i = 0; i < properties.size(); ++i) {
            if (properties[i].name == wanted) return static_cast<int>(i);
        }
    }
    return -1;
}

std::uint64_t PlyElement::smallestBytes(PlyEncoding encoding) const {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : properties) {
        bytes += encoding == PlyEncoding::Ascii ? 2 : typeBytes(property.listCount.value_or(property.type));
    }
    return bytes;
}

Result<PlyHeader> readPlyHeader(std::string_view text) {
    // A header is text; in a binary file the search for its end must not wander through gigabytes.
    const std::string_view head = text.substr(0, 1u << 20);
    const std::size_t end = head.find("end_header");
    if (end == head.npos) return Error{"its header has no end"};
    PlyHeader header;
    header.bytes = end + std::strlen("end_header");
    if (header.bytes < text.size() && text[header.bytes] == '\r') ++header.bytes;
    if (header.bytes < text.size() && text[header.bytes] == '\n') ++header.bytes;

    Lines lines(head.substr(0, end));
    std::string_view line;
    bool known = false;
    std::size_t properties = 0;
    if (!lines.next(line) || trimmed(line) != "ply") return Error{"it does not start with 'ply'"};
    while (lines.next(line)) {
        const std::string_view keyword = takeWord(line);
        const auto wrong = [&](const std::string& reason) {
            return Error{"line " + std::to_string(lines.number()) + " of the header: " + reason};
        };
        if (keyword == "format") {
            const std::string_view encoding = takeWord(line);
            known = true;
            if (encoding == "ascii") {
                header.encoding = PlyEncoding::Ascii;
            } else if (encoding == "binary_little_endian") {
                header.encoding = PlyEncoding::Little;
            } else if (encoding == "binary_big_endian") {
                header.encoding = PlyEncoding::Big;
            } else {
                return wrong("the format is unknown");
            }
        } else if (keyword == "element") {
            PlyElement element;
            element.name = takeWord(line);
            const auto count = parseInteger(takeWord(line));
            if (!count || *count < 0) return wrong("the number of elements is missing");
            element.count = static_cast<std::uint64_t>(*count);
            if (header.elements.size() >= 256) return wrong("there are more than 256 elements");
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty()) return wrong("a property comes before any element");
            if (++properties > 4096) return wrong("there are more than 4,096 properties");
            PlyProperty property;
            std::string_view word = takeWord(line);
            if (word == "list") {
                property.listCount = typeNamed(takeWord(line));
                if (!property.listCount) return wrong("the type of a list's length is unknown");
                word = takeWord(line);
            }
            const auto type = typeNamed(word);
            if (!type) return wrong("the type '" + plainText(word, 40) + "' is unknown");
            property.type = *type;
            property.name = takeWord(line);
            header.elements.back().properties.push_back(std::move(property));
        }
    }
    if (!known) return Error{"its header names no format"};
    return header;
}

void PlyValues::endElement() {
    if (m_encoding != PlyEncoding::Ascii) return;
    m_rest.remove_prefix(std::min(m_rest.find_first_of("\r\n"), m_rest.size()));
}

std::optional<double> PlyValues::take(PlyType type) {
    if (m_encoding == PlyEncoding::Ascii) {
        const std::size_t begin = m_rest.find_first_not_of(" \t\r\n\v\f");
        if (begin == m_rest.npos) return std::nullopt;
        m_rest.remove_prefix(begin);
        const std::size_t end = std::min(m_rest.find_first_of(" \t\r\n\v\f"), m_rest.size());
        const std::string_view word = m_rest.substr(0, end);
        m_rest.remove_prefix(end);
        double value = 0.0;
        const char* from = word.data() + (word.front() == '+' ? 1 : 0);
        const auto [stop, error] = std::from_chars(from, word.data() + word.size(), value);
        if (stop != word.data() + word.size() || stop == from) return std::nullopt;
        if (error == std::errc::result_out_of_range) return static_cast<double>(parseFloat(word).value_or(0.0f));
        return value;
    }
    const std::size_t size = typeBytes(type);
    if (m_rest.size() < size) return std::nullopt;
    unsigned char bytes[8];
    std::memcpy(bytes, m_rest.data(), size);
    if (m_encoding == PlyEncoding::Big) std::reverse(bytes, bytes + size);
    m_rest.remove_prefix(size);
    switch (type) {
        case PlyType::I8:
            return valueOf<std::int8_t>(bytes);
        case PlyType::U8:
            return valueOf<std::uint8_t>(bytes);
        case PlyType::I16:
            return valueOf<std::int16_t>(bytes);
        case PlyType::U16:
            return valueOf<std::uint16_t>(bytes);
        case PlyType::I32:
            return valueOf<std::int32_t>(bytes);
        case PlyType::U32:
            return valueOf<std::uint32_t>(bytes);
        case PlyType::F32:
            return valueOf<float>(bytes);
        case PlyType::F64:
            return valueOf<double>(bytes);
    }
    return std::nullopt;
}

}  // namespace whorl::import
