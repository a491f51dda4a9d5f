// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/sub_triangle_positions.h"

#include <array>
#include <cassert>
#include <mutex>

namespace whorl {

const std::vector<SubTrianglePlace>& subTrianglePlaces(int depth) {
    assert(depth >= 0 && depth <= deepestSubdivision);
    static std::array<std::once_flag, deepestSubdivision + 1> made;
    static std::array<std::vector<SubTrianglePlace>, deepestSubdivision + 1> tables;
    const auto level = static_cast<std::size_t>(depth);
    std::call_once(made[level], [&] {
        std::vector<SubTrianglePlace>& table = tables[level];
        // 4 + 16 + ... + 4^depth; a parent stands before its children.
        table.resize(((std::size_t{4} << (2 * level)) - 4) / 3);
        for (std::size_t i = 0; i < table.size(); ++i) {
            const auto j = static_cast<unsigned>(i % 4);
            table[i] = i < 4 ? SubTrianglePlace{}.child(j) : table[i / 4 - 1].child(j);
        }
    });
    return tables[level];
}

}  // namespace whorl
