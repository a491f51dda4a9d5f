// SPDX-License-Identifier: Apache-2.0
// The unknowns of the direction field and what couples them.
#pragma once

#include "core/field/field_state.h"
#include "core/field/front_solver.h"

#include <complex>
#include <memory>
#include <vector>

namespace whorl {

/// Made once for mesh, growing area and partings. A direction at a vertex is an unknown, a complex number in its frame.
struct FieldMesh {
    using Complex = std::complex<double>;
    static constexpr std::uint32_t none = UINT32_MAX;

    /// A way from one unknown to another that no parting meets.
    struct Way {
        std::uint32_t to = 0;
        Complex turn;  ///< what a vector's number here is multiplied by there
    };

    std::shared_ptr<FieldDomain> domain = std::make_shared<FieldDomain>();
    std::vector<std::uint32_t> unknown;  ///< one a vertex, or none
    std::vector<std::uint32_t> vertex;   ///< one an unknown
    std::vector<double> areas;           ///< one an unknown, square metres
    std::vector<std::uint32_t> piece;    ///< one an unknown: number of the connected piece that it is in
    std::uint32_t pieces = 0;
    double edgeLength = 0.0;              ///< mean, metres
    std::vector<std::uint32_t> firstWay;  ///< of each unknown, and the end
    std::vector<Way> ways;
    std::vector<FrontSolver::Pair> pairs;  ///< corners of one triangle, rising, each once
    FrontSolver::System smooth;            ///< sum of |z_j - turn z_i|^2 over the edges, by their weight

    /// Fails only when cancelled.
    static Result<FieldMesh> make(std::shared_ptr<const Surface> surface, std::span<const std::uint8_t> grows,
                                  std::span<const Parting> partings, Progress& progress);
    /// Number of the pair of two different unknowns of one triangle.
    std::uint32_t pairOf(std::uint32_t a, std::uint32_t b) const;
    /// Default direction at an unknown's vertex: along the skin, its length from 0 to 1 says how sure it is.
    glm::vec3 defaultAt(std::uint32_t unknown, const FieldParams& params) const;

private:
    void numberPieces();
};

}  // namespace whorl
