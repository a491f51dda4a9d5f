// SPDX-License-Identifier: Apache-2.0
#include "core/field/direction_field.h"
#include "core/field/field_mesh.h"
#include "core/field/field_wishes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace whorl {
namespace {

using Complex = FieldMesh::Complex;

/// Pivots that rounding takes below this are none: far below what holds the system definite.
constexpr double leastPivot = 1e-10;

/// Adds what makes `weight * |unknown - wanted|^2` small.
void lean(FrontSolver::System& system, std::vector<Complex>& right, std::size_t unknown, double weight,
          Complex wanted) {
    system.diagonal[unknown] += weight;
    right[unknown] += weight * wanted;
}

void add(FrontSolver::System& system, std::vector<Complex>& right, const FieldWish& wish) {
    for (int a = 0; a < 3; ++a) {
        const std::uint32_t i = wish.unknowns[a];
        if (i == FieldMesh::none) continue;
        right[i] += wish.weight * std::conj(wish.shares[a]) * wish.wanted;
        system.diagonal[i] += wish.weight * std::norm(wish.shares[a]);
        const int b = (a + 1) % 3;
        const std::uint32_t j = wish.unknowns[b];
        if (j == FieldMesh::none || i == j) continue;
        const Complex entry = wish.weight * std::conj(wish.shares[a]) * wish.shares[b];  // row i, column j
        system.coupled[wish.pairs[a]] += i > j ? entry : std::conj(entry);
    }
}

}  // namespace

struct FieldSolver::State {
    FieldMesh mesh;

    /// Directions by default, as FieldMesh::defaultAt has them.
    const std::vector<glm::vec3>& defaultsFor(const FieldParams& params) const;
    const std::vector<FieldWish>& wishesFor(std::size_t index, const FieldStroke& stroke) const;

    // What the last solution leaves to the next one, which comes out the same without it. One thread at a time.
    mutable std::mutex mutex;
    mutable FrontSolver fronts;
    mutable std::vector<glm::vec3> defaults;
    mutable FieldParams defaultsOf;
    struct Made {
        FieldStroke stroke;
        std::vector<FieldWish> wishes;
    };
    mutable std::vector<Made> made;
};

const std::vector<glm::vec3>& FieldSolver::State::defaultsFor(const FieldParams& params) const {
    const bool same = defaults.size() == mesh.vertex.size() && defaultsOf.gravity == params.gravity &&
                      defaultsOf.partingWidth == params.partingWidth;
    if (same) return defaults;
    defaults.clear();
    for (std::uint32_t i = 0; i < mesh.vertex.size(); ++i) defaults.push_back(mesh.defaultAt(i, params));
    defaultsOf = params;
    return defaults;
}

const std::vector<FieldWish>& FieldSolver::State::wishesFor(std::size_t index, const FieldStroke& stroke) const {
    if (made.size() <= index) made.resize(index + 1);
    Made& known = made[index];
    if (known.stroke != stroke) known = {stroke, wishesOf(mesh, stroke)};
    return known.wishes;
}

Result<FieldSolver> FieldSolver::make(std::shared_ptr<const Surface> surface, std::span<const std::uint8_t> grows,
                                      std::span<const Parting> partings, Progress& progress) {
    auto mesh = FieldMesh::make(std::move(surface), grows, partings, progress);
    if (!mesh) return mesh.error();
    auto state = std::make_shared<State>();
    state->mesh = std::move(*mesh);
    state->fronts = FrontSolver(static_cast<std::uint32_t>(state->mesh.vertex.size()), state->mesh.pairs);
    FieldSolver solver;
    solver.m_state = std::move(state);
    return solver;
}

DirectionField FieldSolver::defaults(const FieldParams& params) const {
    const FieldMesh& mesh = m_state->mesh;
    auto made = std::make_shared<DirectionField::State>();
    made->domain = mesh.domain;
    made->directions.assign(mesh.unknown.size(), glm::vec3(0.0f));
    for (std::uint32_t i = 0; i < mesh.vertex.size(); ++i) {
        const glm::vec3 direction = mesh.defaultAt(i, params);
        const float length = glm::length(direction);
        if (length > 1e-4f) made->directions[mesh.vertex[i]] = direction / length;
    }
    DirectionField field;
    field.m_state = std::move(made);
    return field;
}

Result<DirectionField> FieldSolver::solve(std::span<const FieldStroke> strokes, const FieldParams& params,
                                          Progress& progress) const {
    const State& s = *m_state;
    const FieldMesh& mesh = s.mesh;
    const std::size_t count = mesh.vertex.size();
    std::vector<Complex> values;
    {
        const std::lock_guard lock(s.mutex);
        FrontSolver::System system = mesh.smooth;
        std::vector<Complex> right(count, 0.0);
        std::vector<std::uint8_t> led(mesh.pieces, 0);
        for (std::size_t k = 0; k < strokes.size(); ++k) {
            if (progress.cancelled()) return cancelledError();
            for (const FieldWish& wish : s.wishesFor(k, strokes[k])) {
                add(system, right, wish);
                for (const std::uint32_t unknown : wish.unknowns) {
                    if (unknown != FieldMesh::none) led[mesh.piece[unknown]] = 1;
                }
            }
        }
        s.made.resize(strokes.size());
        // A screened system: influence falls to 1/e over `reach`. What no stroke reaches hangs, softly smoothed.
        const auto reach = static_cast<double>(params.reach);
        const double everywhere = reach > 0.0 ? 1.0 / (reach * reach) : 0.0;
        const double alone =
            everywhere > 0.0 ? everywhere : 1.0 / std::max(mesh.edgeLength * mesh.edgeLength * 16.0, 1e-18);
        const std::vector<glm::vec3>& defaults = s.defaultsFor(params);
        for (std::size_t i = 0; i < count; ++i) {
            const double length = static_cast<double>(glm::length(defaults[i]));
            // Steep skin knows where down is better than flat skin does.
            const double weight = (led[mesh.piece[i]] ? everywhere : alone) * mesh.areas[i] * length;
            if (!(weight > 0.0)) continue;
            lean(system, right, i, weight, mesh.domain->inFrame(mesh.vertex[i], defaults[i]) / length);
        }
        if (progress.cancelled()) return cancelledError();
        values = s.fronts.solve(system, right, leastPivot);
    }

    auto made = std::make_shared<DirectionField::State>();
    made->domain = mesh.domain;
    made->directions.assign(mesh.unknown.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < count; ++i) {
        const double length = std::abs(values[i]);
        if (!(length > 1e-12) || !std::isfinite(length)) continue;
        made->directions[mesh.vertex[i]] = mesh.domain->fromFrame(mesh.vertex[i], values[i] / length);
    }
    DirectionField field;
    field.m_state = std::move(made);
    return field;
}

}  // namespace whorl
