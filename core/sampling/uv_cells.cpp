// SPDX-License-Identifier: Apache-2.0
#include "core/sampling/uv_cells.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace whorl {
namespace {

constexpr int side = TouchedUvs::side;
// On more cells than this a triangle is asked on its own, so that huge ones cost no memory.
constexpr int mostCells = 16;

// Cells from (column, row) on; both may lie outside the grid, which repeats.
struct Box {
    int column = 0, row = 0, columns = side, rows = side;
};

Box boxOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const glm::vec2* uv = &mesh.cornerUvs[std::size_t{3} * triangle];
    const glm::vec2 low = glm::min(glm::min(uv[0], uv[1]), uv[2]), high = glm::max(glm::max(uv[0], uv[1]), uv[2]);
    constexpr float far = TouchedUvs::farOut;
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(uv[k].x) < far && std::abs(uv[k].y) < far)) return {};
    const auto cell = [](float x) { return static_cast<int>(std::floor(static_cast<double>(x) * side)); };
    Box box{cell(low.x), cell(low.y), 0, 0};
    box.columns = std::min(cell(high.x) - box.column + 1, side);
    box.rows = std::min(cell(high.y) - box.row + 1, side);
    return box;
}

int wrapped(int cell) {
    const int rest = cell % side;
    return rest < 0 ? rest + side : rest;
}

template <class Visit>
void forCells(const Box& box, Visit&& visit) {
    for (int row = box.row; row < box.row + box.rows; ++row)
        for (int column = box.column; column < box.column + box.columns; ++column) visit(wrapped(column), wrapped(row));
}

}  // namespace

UvCells::UvCells(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles) {
    std::vector<Box> boxes(triangles.size());
    m_first.assign(std::size_t{side} * side + 1, 0);
    const auto at = [](int column, int row) { return static_cast<std::size_t>(row * side + column); };
    for (std::uint32_t place = 0; place < triangles.size(); ++place) {
        const Box box = boxes[place] = boxOf(mesh, triangles[place]);
        if (box.columns * box.rows > mostCells) {
            m_wide.push_back({place, box.column, box.row, box.columns, box.rows});
        } else {
            forCells(box, [&](int column, int row) { ++m_first[at(column, row) + 1]; });
        }
    }
    for (std::size_t cell = 1; cell < m_first.size(); ++cell) m_first[cell] += m_first[cell - 1];
    m_places.resize(m_first.back());
    std::vector<std::uint32_t> next(m_first.begin(), m_first.end() - 1);
    for (std::uint32_t place = 0; place < triangles.size(); ++place) {
        const Box& box = boxes[place];
        if (box.columns * box.rows > mostCells) continue;
        forCells(box, [&](int column, int row) { m_places[next[at(column, row)]++] = place; });
    }
}

std::vector<std::uint32_t> UvCells::under(const TouchedUvs& touched) const {
    std::vector<std::uint32_t> places;
    if (touched.empty()) return places;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            if (!touched.cell(column, row)) continue;
            const auto cell = static_cast<std::size_t>(row * side + column);
            places.insert(places.end(), m_places.begin() + static_cast<std::ptrdiff_t>(m_first[cell]),
                          m_places.begin() + static_cast<std::ptrdiff_t>(m_first[cell + 1]));
        }
    }
    for (const Wide& wide : m_wide) {
        bool on = false;
        forCells({wide.column, wide.row, wide.columns, wide.rows},
                 [&](int column, int row) { on = on || touched.cell(column, row); });
        if (on) places.push_back(wide.place);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

std::size_t UvCells::memoryBytes() const {
    return (m_first.capacity() + m_places.capacity()) * sizeof(std::uint32_t) + m_wide.capacity() * sizeof(Wide);
}

}  // namespace whorl
