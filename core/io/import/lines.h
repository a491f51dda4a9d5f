// SPDX-License-Identifier: Apache-2.0
// A text file line by line, word by word. Private to the importers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace whorl::import {

/// Lines that end in LF, CRLF or CR; a backslash at the end joins the next line.
class Lines {
public:
    explicit Lines(std::string_view text) : m_rest(text) {}

    /// False at the end. `line` is good until the next call.
    bool next(std::string_view& line) {
        if (m_rest.empty()) return false;
        ++m_number;
        line = take();
        if (line.empty() || line.back() != '\\') return true;
        m_joined.clear();
        while (!line.empty() && line.back() == '\\') {
            m_joined.append(line.substr(0, line.size() - 1)).push_back(' ');
            if (m_rest.empty()) {
                line = {};
                break;
            }
            ++m_joinedLines;
            line = take();
        }
        m_joined.append(line);
        line = m_joined;
        return true;
    }

    /// Of the line last given, from 1.
    std::uint64_t number() const { return m_number; }

private:
    std::string_view take() {
        m_number += m_joinedLines;
        m_joinedLines = 0;
        const std::size_t end = m_rest.find_first_of("\r\n");
        if (end == m_rest.npos) {
            const std::string_view line = m_rest;
            m_rest = {};
            return line;
        }
        const std::string_view line = m_rest.substr(0, end);
        const bool two = m_rest[end] == '\r' && end + 1 < m_rest.size() && m_rest[end + 1] == '\n';
        m_rest.remove_prefix(end + (two ? 2 : 1));
        return line;
    }

    std::string_view m_rest;
    std::string m_joined;
    std::uint64_t m_number = 0;
    std::uint64_t m_joinedLines = 0;
};

/// Takes the next word off `line`; empty when there is none.
inline std::string_view takeWord(std::string_view& line) {
    const std::size_t begin = line.find_first_not_of(" \t\v\f");
    if (begin == line.npos) {
        line = {};
        return {};
    }
    line.remove_prefix(begin);
    const std::size_t end = line.find_first_of(" \t\v\f");
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end == line.npos ? line.size() : end);
    return word;
}

/// The rest of the line without the spaces around it.
inline std::string_view trimmed(std::string_view line) {
    const std::size_t begin = line.find_first_not_of(" \t\v\f");
    if (begin == line.npos) return {};
    return line.substr(begin, line.find_last_not_of(" \t\v\f") - begin + 1);
}

}  // namespace whorl::import
