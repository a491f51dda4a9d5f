// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace whorl::samples {

/// Symmetric sparse matrix of 2x2 blocks over the chart's vertices.
class BlockMatrix {
public:
    BlockMatrix(size_t vertices, const std::vector<std::array<uint32_t, 3>>& triangles) : m_first(vertices + 1, 0) {
        std::vector<uint64_t> keys;
        for (const auto& t : triangles) {
            for (uint32_t a : t) {
                for (uint32_t b : t) {
                    keys.push_back(uint64_t(a) << 32 | b);
                }
            }
        }
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        for (uint64_t k : keys) {
            ++m_first[(k >> 32) + 1];
            m_column.push_back(uint32_t(k));
        }
        std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
        m_block.resize(m_column.size());
    }

    void clear() { std::fill(m_block.begin(), m_block.end(), glm::dvec3(0.0)); }
    glm::dvec3& at(uint32_t row, uint32_t column) {
        const auto begin = m_column.begin() + m_first[row];
        return m_block[size_t(std::lower_bound(begin, m_column.begin() + m_first[row + 1], column) - m_column.begin())];
    }

    void multiply(const std::vector<glm::dvec2>& x, std::vector<glm::dvec2>& y) const {
        for (size_t r = 0; r + 1 < m_first.size(); ++r) {
            glm::dvec2 sum(0.0);
            for (uint32_t i = m_first[r]; i < m_first[r + 1]; ++i) {
                sum += apply(m_block[i], x[m_column[i]]);
            }
            y[r] = sum;
        }
    }

    /// A block holds (xx, xy, yy).
    static glm::dvec2 apply(const glm::dvec3& m, const glm::dvec2& v) {
        return {m.x * v.x + m.y * v.y, m.y * v.x + m.z * v.y};
    }

private:
    std::vector<uint32_t> m_first, m_column;
    std::vector<glm::dvec3> m_block;
};

}  // namespace whorl::samples
