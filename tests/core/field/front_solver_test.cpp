// SPDX-License-Identifier: Apache-2.0
// Laws of the direct solver and of what it keeps: right, and the same numbers whatever was solved before.
#include "core/field/front_solver.h"

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/field/direction_field.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>

using namespace whorl;

namespace {

using Complex = FrontSolver::Complex;

struct Problem {
    std::vector<FrontSolver::Pair> pairs;
    FrontSolver::System system;
    std::vector<Complex> right;

    /// On the vertices of a mesh, with random turns; `pulled` of them held.
    Problem(const SurfaceMesh& mesh, std::uint32_t seed) {
        for (const glm::uvec3& t : mesh.triangles) {
            for (int k = 0; k < 3; ++k)
                pairs.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
        }
        std::ranges::sort(pairs);
        pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
        system.diagonal.assign(mesh.positions.size(), 1e-6);
        right.assign(mesh.positions.size(), 0.0);
        for (std::uint32_t k = 0; k < pairs.size(); ++k) {
            const double weight = 0.1 + static_cast<double>(randomFloat(seed, k, 0));
            system.coupled.push_back(-std::polar(weight, 6.28 * static_cast<double>(randomFloat(seed, k, 1))));
            system.diagonal[pairs[k].low] += weight;
            system.diagonal[pairs[k].high] += weight;
        }
        for (std::uint32_t i = 0; i < 20; ++i) hold(seed, i);
    }
    void hold(std::uint32_t seed, std::uint32_t i) {
        const auto count = static_cast<float>(system.diagonal.size());
        const auto at = static_cast<std::size_t>(randomFloat(seed, i, 2) * (count - 1.0f));
        system.diagonal[at] += 1000.0;
        right[at] += 1000.0 * std::polar(1.0, 6.28 * static_cast<double>(randomFloat(seed, i, 3)));
    }
    /// Greatest error of an equation.
    double residual(const std::vector<Complex>& x) const {
        std::vector<Complex> sum(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) sum[i] = system.diagonal[i] * x[i] - right[i];
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            sum[pairs[k].high] += system.coupled[k] * x[pairs[k].low];
            sum[pairs[k].low] += std::conj(system.coupled[k]) * x[pairs[k].high];
        }
        double worst = 0.0;
        for (const Complex& s : sum) worst = std::max(worst, std::abs(s));
        return worst;
    }
    FrontSolver solver() const { return {static_cast<std::uint32_t>(right.size()), pairs}; }
};

FieldStroke strokeOn(const Surface& surface, const std::vector<glm::vec3>& places) {
    FieldStroke stroke;
    stroke.points = *tracedParting(surface, places);
    return stroke;
}

/// Strokes around a ball, the last one turned by `turn`.
std::vector<FieldStroke> ringOf(const Surface& surface, float turn) {
    std::vector<FieldStroke> strokes;
    for (int i = 0; i < 6; ++i) {
        const float a = static_cast<float>(i) + (i == 5 ? turn : 0.0f);
        const glm::vec3 out(0.1f * std::cos(a), 0.02f * static_cast<float>(i % 3), 0.1f * std::sin(a));
        strokes.push_back(strokeOn(surface, {out, out + glm::vec3(0.0f, -0.04f, 0.02f)}));
    }
    return strokes;
}

}  // namespace

class FrontSolverTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void equationsAreMet() {
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            const Problem problem(seed < 3 ? testing::sphere(30, 40) : testing::plane(25), seed);
            FrontSolver solver = problem.solver();
            const double residual = problem.residual(solver.solve(problem.system, problem.right, 1e-12));
            QVERIFY2(residual < 1e-9, qPrintable(QString::number(residual)));
            QCOMPARE(solver.frontsMade(), solver.frontCount());
        }
        QVERIFY(FrontSolver().solve({}, {}, 1e-12).empty());
    }

    void whatWasSolvedBeforeMakesNoDifference() {
        const SurfaceMesh mesh = testing::sphere(40, 50);
        const Problem first(mesh, 7);
        FrontSolver solver = first.solver();
        solver.solve(first.system, first.right, 1e-12);
        Problem moved = first;
        for (std::uint32_t step = 0; step < 5; ++step) {
            moved.hold(8, step);
            const std::vector<Complex> kept = solver.solve(moved.system, moved.right, 1e-12);
            QVERIFY(solver.frontsMade() > 0 && solver.frontsMade() < solver.frontCount() / 4);
            FrontSolver fresh = moved.solver();
            QCOMPARE(kept, fresh.solve(moved.system, moved.right, 1e-12));
        }
        // Another right side alone factorises nothing.
        moved.right[100] += 1.0;
        const std::vector<Complex> kept = solver.solve(moved.system, moved.right, 1e-12);
        QCOMPARE(solver.frontsMade(), std::size_t{0});
        FrontSolver fresh = moved.solver();
        QCOMPARE(kept, fresh.solve(moved.system, moved.right, 1e-12));
        QCOMPARE(solver.solve(first.system, first.right, 1e-12),
                 first.solver().solve(first.system, first.right, 1e-12));
    }

    void sameBytesOnEveryLevelAndAnyThreads() {
        const Problem problem(testing::sphere(60, 80), 3);
        const std::vector<Complex> expected = problem.solver().solve(problem.system, problem.right, 1e-12);
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            if (level > bestSimdLevel()) continue;
            setSimdLevel(level);
            QCOMPARE(problem.solver().solve(problem.system, problem.right, 1e-12), expected);
        }
        setSimdLevel(bestSimdLevel());
        const ThreadLimit one(1);
        QCOMPARE(problem.solver().solve(problem.system, problem.right, 1e-12), expected);
    }

    void theFieldDoesNotDependOnWhatWasDrawnBefore() {
        const auto surface = std::make_shared<const Surface>(Cow<SurfaceMesh>(testing::sphere(48, 64)));
        const std::vector<std::uint8_t> grows(surface->mesh().triangleCount(), 1);
        Progress progress;
        const auto make = [&] { return *FieldSolver::make(surface, grows, {}, progress); };
        const FieldSolver used = make();
        for (const float reach : {0.0f, 0.05f}) {
            FieldParams params;
            params.reach = reach;
            for (int k = 0; k < 4; ++k) {
                std::vector<FieldStroke> strokes = ringOf(*surface, 0.05f * static_cast<float>(k));
                if (k == 2) strokes.erase(strokes.begin() + 1);
                const auto kept = used.solve(strokes, params, progress),
                           fresh = make().solve(strokes, params, progress);
                QVERIFY(std::ranges::equal(kept->vertices(), fresh->vertices()));
            }
        }
    }
};

QTEST_GUILESS_MAIN(FrontSolverTest)
#include "front_solver_test.moc"
