// SPDX-License-Identifier: Apache-2.0
// Direct solution of sparse systems over a mesh that keeps what a small change leaves valid.
#pragma once

#include "core/field/front.kernel.h"

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

// Unknowns are eliminated in an order of minimum degree (Amestoy, Davis and Duff, "An Approximate Minimum Degree
// Ordering Algorithm", 1996). The factorisation is multifrontal (Duff and Reid, "The Multifrontal Solution of
// Indefinite Sparse Symmetric Linear Equations", 1983): unknowns that are coupled to the same others share a small
// dense matrix, a front, made of the entries that are its own and of what fronts eliminated before leave over. A front
// depends on nothing but those, so after a change of some entries only the fronts above them are made anew, and the
// numbers are the very ones that starting from nothing gives.

namespace whorl {

/// For Hermitian positive definite matrices. One thread at a time; its work is spread over all cores.
class FrontSolver {
public:
    using Complex = std::complex<double>;

    /// Two unknowns that an entry of the matrix may couple; low < high.
    struct Pair {
        std::uint32_t low = 0, high = 0;
        auto operator<=>(const Pair&) const = default;
    };
    struct System {
        std::vector<double> diagonal;  ///< one an unknown
        std::vector<Complex> coupled;  ///< one a pair: row `high`, column `low`
    };

    FrontSolver() = default;
    /// `pairs`: each once.
    FrontSolver(std::uint32_t unknowns, std::span<const Pair> pairs);

    /// The solution for `right`, one number an unknown. Pivots below `least` (above zero) count as that.
    std::vector<Complex> solve(const System& system, std::span<const Complex> right, double least);

    std::size_t frontCount() const { return m_fronts.size(); }
    /// Fronts that the last solution made anew.
    std::size_t frontsMade() const { return m_made; }

private:
    /// An entry of the matrix in its front.
    struct Entry {
        std::uint32_t source;  // pair, or unknown
        std::uint32_t row, column;
        bool conjugated;
    };
    struct Front {
        std::uint32_t first = 0;  // of m_order; followed by the other pivots
        std::uint32_t pivots = 0;
        std::vector<std::uint32_t> rest{};      // places in m_order, rising
        std::vector<std::uint32_t> inParent{};  // row in the parent's front, one of each of `rest`
        std::vector<std::uint32_t> children{};
        std::uint32_t level = 0;  // above the lowest
        std::uint32_t firstEntry = 0, lastEntry = 0;
        std::uint32_t below = 0;        // pivots of it and of all fronts under it
        std::vector<double> columns{};  // those of the pivots
        // What is left for the parent: the lower triangle column by column, real parts and then imaginary ones.
        std::vector<double> left{};
        // The right side, real parts and then imaginary ones: half solved for the pivots, what is left for the others.
        std::vector<double> half{};
        std::size_t rows() const { return pivots + rest.size(); }
        /// `square`: room for what is left, while it is made.
        FrontColumns parts(double* square = nullptr);
        /// What is left is made again when it is asked for: that takes less than remembering all of it.
        bool forgets() const { return below <= 64; }
    };

    void order(std::uint32_t unknowns, std::span<const Pair> pairs);
    bool changed(const Front& front, const System& system) const;
    void make(Front& front);
    void solveForward(Front& front);

    std::vector<std::uint32_t> m_order;  // unknowns as they are eliminated
    std::vector<Front> m_fronts;         // children before parents
    std::vector<std::vector<std::uint32_t>> m_levels;
    std::vector<Entry> m_entries;
    System m_system;  // of the last solution, as m_right and m_least
    std::vector<Complex> m_right;
    double m_least = 0.0;
    std::size_t m_made = 0;
};

}  // namespace whorl
