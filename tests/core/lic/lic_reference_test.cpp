// SPDX-License-Identifier: Apache-2.0
// Laws of line integral convolution on the skin, and of straight ways over triangles.
#include "core/base/random.h"
#include "core/field/grow_guides.h"
#include "core/lic/reference.h"
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>

using namespace whorl;
using namespace whorl::testing;

namespace {

LicReference combed(const LicScene& scene) {
    return LicReference(scene.surface, scene.field);
}

}  // namespace

class LicReferenceTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void straightWaysStayStraight() {
        const LicScene scene(testing::plane(9));
        const SurfaceMesh& mesh = *scene.groom.mesh;
        const SurfaceWalk walk(mesh);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const glm::vec3 from(randomFloat(1, i, 0) * 0.6f - 0.3f, 0, randomFloat(1, i, 1) * 0.6f - 0.3f);
            const float angle = randomFloat(1, i, 2) * 6.2832f, way = randomFloat(1, i, 3) * 0.15f;
            const glm::vec3 d(std::cos(angle), 0, std::sin(angle));
            const SurfacePoint start = scene.placeAt(from);
            const SurfaceWalk::Step step = walk.go(mesh, start, d, way);
            QVERIFY(glm::distance(positionAt(mesh, step.point), positionAt(mesh, start) + d * way) < 2e-6f);
            QVERIFY(glm::distance(step.direction, d) < 1e-5f);
            QVERIFY(std::abs(step.walked - way) < 1e-6f);
        }
        // Off the border there is no way.
        const SurfaceWalk::Step off = walk.go(mesh, scene.placeAt({0.4f, 0, 0}), {1, 0, 0}, 1.0f);
        QVERIFY(std::abs(off.walked - 0.1f) < 1e-4f);
    }

    void aroundABallAndBack() {
        const LicScene scene(testing::sphere(64, 96, 0.1f));
        const SurfaceMesh& mesh = *scene.groom.mesh;
        const SurfaceWalk walk(mesh);
        const SurfacePoint start = scene.placeAt({0.07f, 0.03f, 0.064f});
        const glm::vec3 from = positionAt(mesh, start);
        const SurfaceWalk::Step there = walk.go(mesh, start, {0.3f, 0.8f, -0.2f}, 0.25f);
        QVERIFY(std::abs(there.walked - 0.25f) < 1e-5f);
        QVERIFY(glm::distance(positionAt(mesh, there.point), from) > 0.15f);
        const SurfaceWalk::Step back = walk.go(mesh, there.point, -there.direction, 0.25f);
        QVERIFY(glm::distance(positionAt(mesh, back.point), from) < 1e-5f);
    }

    void streamlinesComeBack() {
        const LicScene scene(testing::sphere(64, 96, 0.1f), Lines(aroundTheBall.begin(), aroundTheBall.begin() + 2));
        const LicReference lic = combed(scene);
        int whole = 0;
        for (std::uint32_t i = 0; i < 40; ++i) {
            const glm::vec3 out(randomFloat(2, i, 0) - 0.5f, randomFloat(2, i, 1) * 0.5f, randomFloat(2, i, 2) - 0.5f);
            const SurfacePoint start = scene.placeAt(glm::normalize(out) * 0.1f);
            const auto line = lic.streamline(start, 0.02f, 0.0005f, false);
            if (line.size() < 41) continue;
            ++whole;
            const auto back = lic.streamline(line.back().point, 0.02f, 0.0005f, true);
            QVERIFY2(
                back.size() == 41 && glm::distance(back.back().position, line.front().position) < 5e-5f,
                qPrintable(QString("%1: %2").arg(i).arg(glm::distance(back.back().position, line.front().position))));
        }
        QVERIFY(whole > 30);
    }

    void theShareOfWhiteIsTheMean() {
        const LicScene scene(testing::plane(4), {{{-0.2f, 0, 0}, {0.2f, 0, 0.1f}}});
        const LicReference lic = combed(scene);
        for (const float white : {0.1f, 0.5f, 0.8f}) {
            LicOptions options;
            options.grain = 0.01f;
            options.length = 0.03f;
            options.white = white;
            double sum = 0.0;
            for (std::uint32_t i = 0; i < 800; ++i) {
                const glm::vec3 p(randomFloat(4, i, 0) * 0.8f - 0.4f, 0, randomFloat(4, i, 1) * 0.8f - 0.4f);
                sum += static_cast<double>(*lic.at(scene.placeAt(p), options)) / 800.0;
            }
            QVERIFY2(std::abs(sum - static_cast<double>(white)) < 0.03, qPrintable(QString::number(sum)));
        }
    }

    void noStreamlineCrossesAParting() {
        const std::vector<glm::vec3> line{{0.013f, 0, -0.5f}, {-0.02f, 0, 0.0f}, {0.013f, 0, 0.5f}};
        // Towards the parting from both sides.
        const LicScene scene(testing::plane(12), {{{-0.4f, 0, 0}, {-0.1f, 0, 0}}, {{0.4f, 0, 0}, {0.1f, 0, 0}}},
                             {line});
        const LicReference lic = combed(scene);
        const auto sideOf = [&](const glm::vec3& p) {
            const float at = -0.02f + 0.033f * std::abs(p.z) / 0.5f;
            return p.x < at ? -1 : 1;
        };
        int stopped = 0;
        for (std::uint32_t i = 0; i < 200; ++i) {
            const glm::vec3 p(randomFloat(5, i, 0) * 0.4f - 0.2f, 0, randomFloat(5, i, 1) * 0.7f - 0.35f);
            const auto places = lic.streamline(scene.placeAt(p), 0.3f, 0.004f, false);
            if (places.empty()) continue;
            for (const auto& place : places) QCOMPARE(sideOf(place.position), sideOf(places.front().position));
            stopped += places.size() < 75;
        }
        QVERIFY(stopped > 150);
    }

    void aFieldFromGuides() {
        Groom groom = testing::groomOn(testing::sphere(32, 48), 150, 10, 0.03f);
        const LicScene scene(*groom.mesh, {{{0.1f, 0, 0}, {0.07f, 0.07f, 0.02f}}});
        const LicReference lic = combed(scene);
        Progress progress;
        QVERIFY(growGuidesAlong(groom, *scene.surface, lic.field(), {.lift = 0.1f}, progress).ok());
        QCOMPARE(strokesFromGuides(groom, *scene.surface, -1).size(), groom.guides.count());
        // Without strokes guides lead.
        const DirectionField again = LicScene(groom).field;
        double sum = 0.0;
        for (std::size_t i = 0; i < again.vertices().size(); ++i) {
            const double cosine = static_cast<double>(glm::dot(again.vertices()[i], lic.field().vertices()[i]));
            sum += std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.3;
        }
        const double mean = sum / static_cast<double>(again.vertices().size());
        QVERIFY2(mean < 8.0, qPrintable(QString::number(mean)));
        QVERIFY(strokesFromGuides(groom, *scene.surface, 1).empty());
    }

    void nothingWhereNoHairLies() {
        const LicScene scene(testing::plane(4));
        Progress progress;
        const std::vector<std::uint8_t> grows(scene.groom.mesh->triangleCount(), 0);
        const auto solver = FieldSolver::make(scene.surface, grows, {}, progress);
        const LicReference lic(scene.surface, *solver->solve({}, {}, progress));
        QVERIFY(!lic.at({0, 0.2f, 0.2f}, {}));
        QVERIFY(lic.streamline({0, 0.2f, 0.2f}, 0.1f, 0.01f, false).empty());
    }
};

QTEST_GUILESS_MAIN(LicReferenceTest)
#include "lic_reference_test.moc"
