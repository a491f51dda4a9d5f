// SPDX-License-Identifier: Apache-2.0
#include "core/field/front_solver.h"

#include "core/base/parallel.h"
#include "core/field/front.kernel.h"

#include <algorithm>

namespace whorl {
namespace {

/// Columns that are eliminated together.
constexpr std::size_t panel = 16;
/// Columns that one thread subtracts from; even, so that they pair up the same way on any number of threads.
constexpr std::size_t columnsATime = 32;

std::size_t strideOf(std::size_t rows) {
    return (rows + 3) / 4 * 4;
}

}  // namespace

FrontColumns FrontSolver::Front::parts(double* square) {
    const std::size_t stride = strideOf(rows()), restStride = strideOf(rest.size());
    return {columns.data(),
            columns.data() + stride * pivots,
            stride,
            square,
            square ? square + restStride * rest.size() : nullptr,
            restStride,
            pivots,
            rest.size()};
}

FrontSolver::FrontSolver(std::uint32_t unknowns, std::span<const Pair> pairs) {
    order(unknowns, pairs);
    std::vector<std::uint32_t> frontOf(m_order.size()), placeOf(m_order.size());
    for (std::uint32_t f = 0; f < m_fronts.size(); ++f) {
        for (std::uint32_t k = 0; k < m_fronts[f].pivots; ++k) {
            frontOf[m_fronts[f].first + k] = f;
            placeOf[m_order[m_fronts[f].first + k]] = m_fronts[f].first + k;
        }
    }
    // Entries by front, and from them which rows a front has below its pivots.
    std::vector<std::vector<Entry>> entries(m_fronts.size());
    for (std::uint32_t place = 0; place < m_order.size(); ++place) {
        entries[frontOf[place]].push_back({m_order[place], place, place, false});
    }
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
        const std::uint32_t low = placeOf[pairs[k].low], high = placeOf[pairs[k].high];
        const std::uint32_t column = std::min(low, high);
        entries[frontOf[column]].push_back({k, std::max(low, high), column, high < low});
    }
    std::vector<std::uint32_t> rowOf(m_order.size(), 0);
    for (Front& front : m_fronts) {
        const auto index = static_cast<std::size_t>(&front - m_fronts.data());
        const std::uint32_t end = front.first + front.pivots;
        for (const Entry& entry : entries[index]) {
            if (entry.row >= end) front.rest.push_back(entry.row);
        }
        for (const std::uint32_t child : front.children) {
            for (const std::uint32_t place : m_fronts[child].rest) {
                if (place >= end) front.rest.push_back(place);
            }
            front.level = std::max(front.level, m_fronts[child].level + 1);
            front.below += m_fronts[child].below;
        }
        front.below += front.pivots;
        std::ranges::sort(front.rest);
        front.rest.erase(std::unique(front.rest.begin(), front.rest.end()), front.rest.end());
        const auto row = [&](std::uint32_t place) { return place < end ? place - front.first : rowOf[place]; };
        for (std::size_t k = 0; k < front.rest.size(); ++k)
            rowOf[front.rest[k]] = front.pivots + static_cast<std::uint32_t>(k);
        for (const std::uint32_t child : front.children) {
            for (const std::uint32_t place : m_fronts[child].rest) m_fronts[child].inParent.push_back(row(place));
        }
        front.firstEntry = static_cast<std::uint32_t>(m_entries.size());
        for (const Entry& entry : entries[index])
            m_entries.push_back({entry.source, row(entry.row), row(entry.column), entry.conjugated});
        front.lastEntry = static_cast<std::uint32_t>(m_entries.size());
        if (m_levels.size() <= front.level) m_levels.resize(front.level + 1);
        m_levels[front.level].push_back(static_cast<std::uint32_t>(index));
    }
}

bool FrontSolver::changed(const Front& front, const System& system) const {
    for (std::uint32_t k = front.firstEntry; k < front.lastEntry; ++k) {
        const Entry& entry = m_entries[k];
        if (entry.row == entry.column ? system.diagonal[entry.source] != m_system.diagonal[entry.source]
                                      : system.coupled[entry.source] != m_system.coupled[entry.source])
            return true;
    }
    return false;
}

std::vector<FrontSolver::Complex> FrontSolver::solve(const System& system, std::span<const Complex> right,
                                                     double least) {
    const bool anew = m_right.size() != right.size() || least != m_least;
    enum : std::uint8_t { same, otherRight, otherMatrix };
    std::vector<std::uint8_t> states(m_fronts.size(), same);
    for (std::size_t f = 0; f < m_fronts.size(); ++f) {
        const Front& front = m_fronts[f];
        std::uint8_t& state = states[f];
        for (const std::uint32_t child : front.children) state = std::max(state, states[child]);
        for (std::uint32_t k = 0; k < front.pivots && !anew && state == same; ++k) {
            const std::uint32_t unknown = m_order[front.first + k];
            if (m_right[unknown] != right[unknown]) state = otherRight;
        }
        if (state != otherMatrix && (anew || changed(front, system))) state = otherMatrix;
    }
    // Parents before children: what a front is made of has to be there.
    for (std::size_t f = m_fronts.size(); f-- > 0;) {
        if (states[f] != otherMatrix) continue;
        for (const std::uint32_t child : m_fronts[f].children)
            if (m_fronts[child].forgets()) states[child] = otherMatrix;
    }
    m_system = system;
    m_right.assign(right.begin(), right.end());
    m_least = least;
    m_made = 0;
    for (const std::vector<std::uint32_t>& level : m_levels) {
        std::vector<std::uint32_t> due;
        for (const std::uint32_t f : level) {
            if (states[f] != same) due.push_back(f);
            if (states[f] == otherMatrix) ++m_made;
        }
        parallelFor(due.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) {
                if (states[due[k]] == otherMatrix) make(m_fronts[due[k]]);
                solveForward(m_fronts[due[k]]);
            }
        });
    }
    const auto backward = WHORL_PICK(frontBackward);
    std::vector<double> real(m_order.size()), imaginary(m_order.size()), r, i;
    for (auto at = m_fronts.rbegin(); at != m_fronts.rend(); ++at) {
        Front& front = *at;
        const std::size_t rows = front.rows();
        r.assign(front.half.data(), front.half.data() + rows);
        i.assign(front.half.data() + rows, front.half.data() + 2 * rows);
        for (std::size_t k = 0; k < front.rest.size(); ++k) {
            r[front.pivots + k] = real[front.rest[k]];
            i[front.pivots + k] = imaginary[front.rest[k]];
        }
        backward(front.parts(), r.data(), i.data());
        std::copy_n(r.begin(), front.pivots, real.begin() + front.first);
        std::copy_n(i.begin(), front.pivots, imaginary.begin() + front.first);
    }
    std::vector<Complex> values(m_order.size());
    for (std::size_t k = 0; k < m_order.size(); ++k) values[m_order[k]] = {real[k], imaginary[k]};
    return values;
}

void FrontSolver::solveForward(Front& front) {
    const std::size_t rows = front.rows();
    front.half.assign(2 * rows, 0.0);
    double* real = front.half.data();
    double* imaginary = real + rows;
    for (std::uint32_t k = 0; k < front.pivots; ++k) {
        const Complex value = m_right[m_order[front.first + k]];
        real[k] = value.real();
        imaginary[k] = value.imag();
    }
    for (const std::uint32_t c : front.children) {
        const Front& child = m_fronts[c];
        const double* left = child.half.data() + child.pivots;
        for (std::size_t k = 0; k < child.rest.size(); ++k) {
            real[child.inParent[k]] += left[k];
            imaginary[child.inParent[k]] += left[k + child.rows()];
        }
    }
    WHORL_PICK(frontForward)(front.parts(), real, imaginary);
}

void FrontSolver::make(Front& front) {
    const std::size_t rest = front.rest.size(), rows = front.pivots + rest;
    front.columns.assign(2 * strideOf(rows) * front.pivots, 0.0);
    std::vector<double> square(2 * strideOf(rest) * rest, 0.0);
    const FrontColumns columns = front.parts(square.data());
    const auto at = [&](std::size_t row, std::size_t column) {
        return column < front.pivots
                   ? std::pair(columns.pivotReal + column * columns.pivotStride + row,
                               columns.pivotImaginary + column * columns.pivotStride + row)
                   : std::pair(
                         columns.restReal + (column - front.pivots) * columns.restStride + (row - front.pivots),
                         columns.restImaginary + (column - front.pivots) * columns.restStride + (row - front.pivots));
    };
    for (std::uint32_t k = front.firstEntry; k < front.lastEntry; ++k) {
        const Entry& entry = m_entries[k];
        const auto [real, imaginary] = at(entry.row, entry.column);
        if (entry.row == entry.column) {
            *real = m_system.diagonal[entry.source];
        } else {
            const Complex value = m_system.coupled[entry.source];
            *real = value.real();
            *imaginary = entry.conjugated ? -value.imag() : value.imag();
        }
    }
    for (const std::uint32_t c : front.children) {
        Front& child = m_fronts[c];
        const double* real = child.left.data();
        const double* imaginary = real + child.left.size() / 2;
        for (std::size_t column = 0; column < child.rest.size(); ++column) {
            for (std::size_t row = column; row < child.rest.size(); ++row) {
                // Rows rise in the parent, too: pivots are before the rest, and both are sorted.
                const auto [toReal, toImaginary] = at(child.inParent[row], child.inParent[column]);
                *toReal += *real++;
                *toImaginary += *imaginary++;
            }
        }
        if (child.forgets()) child.left = {};
    }
    const auto eliminate = WHORL_PICK(frontEliminate);
    const auto subtract = WHORL_PICK(frontSubtract);
    for (std::size_t first = 0; first < front.pivots; first += panel) {
        const std::size_t last = std::min<std::size_t>(first + panel, front.pivots);
        eliminate(columns, first, last, m_least);
        parallelFor(rows - last, columnsATime,
                    [&](std::size_t from, std::size_t to) { subtract(columns, first, last, last + from, last + to); });
    }
    front.left.resize(rest * (rest + 1));
    double* real = front.left.data();
    double* imaginary = real + front.left.size() / 2;
    for (std::size_t column = 0; column < rest; ++column) {
        real = std::copy_n(columns.restReal + column * columns.restStride + column, rest - column, real);
        imaginary = std::copy_n(columns.restImaginary + column * columns.restStride + column, rest - column, imaginary);
    }
}

}  // namespace whorl
