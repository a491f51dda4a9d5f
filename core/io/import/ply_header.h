// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file and its values in any of the three encodings. Private to the importers.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whorl::import {

enum class PlyType { I8, U8, I16, U16, I32, U32, F32, F64 };
enum class PlyEncoding { Ascii, Little, Big };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::F32;
    std::optional<PlyType> listCount;  ///< type of the length, for lists
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    /// Number of the property of one of these names, or -1.
    int find(std::initializer_list<std::string_view> names) const;
    /// Fewest bytes that one of them can take.
    std::uint64_t smallestBytes(PlyEncoding encoding) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::Ascii;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;  ///< where the values start
};

/// Errors are half sentences.
Result<PlyHeader> readPlyHeader(std::string_view text);

/// Takes values one after another and never reads past the end.
class PlyValues {
public:
    PlyValues(std::string_view bytes, PlyEncoding encoding) : m_rest(bytes), m_encoding(encoding) {}
    /// Nothing at the end of the file or where a word is no number.
    std::optional<double> take(PlyType type);
    /// At the end of an element: drops what else stands on the line of a text file.
    void endElement();
    std::size_t bytesLeft() const { return m_rest.size(); }

private:
    std::string_view m_rest;
    PlyEncoding m_encoding;
};

}  // namespace whorl::import
