// SPDX-License-Identifier: Apache-2.0
#include "core/hair/outside.h"

#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/hair/generate.h"
#include "core/io/mesh_import.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <vector>

using namespace whorl;

namespace {

// Guides that leave along the normal and then bow to the middle of the mesh: without help all end inside.
void bowInwards(Groom& groom, const glm::vec3& middle) {
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size() - 1);
            points[v] = glm::mix(points[v], middle, 0.8f * along * along);
        }
    }
}

// Made once: distance fields take a second.
std::shared_ptr<const Surface> sphereSurface() {
    static const auto surface = std::make_shared<const Surface>(Cow<SurfaceMesh>(testing::sphere(24, 48)));
    return surface;
}

std::size_t inside(const Strands& strands, const DistanceField& skin, float tolerance) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < strands.count(); ++i)
        for (std::uint32_t v = strands.firstVertex[i] + 1; v < strands.firstVertex[i + 1]; ++v)
            count += skin.distance(strands.positions[v]) < -tolerance;
    return count;
}

}  // namespace

class OutsideTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void noVertexOfASphereIsInside() {
        const std::shared_ptr<const Surface> surface = sphereSurface();
        Groom groom = testing::groomOn(surface->mesh(), 200, 15, 0.06f);
        groom.mesh = surface->shared;
        bowInwards(groom, glm::vec3(0.0f));
        Generator generator;
        generator.setSurface(surface);
        Progress progress;
        const Strands kept = *generator.generate(groom, {2000u}, progress);
        QCOMPARE(inside(kept, surface->skin(), 1e-5f), std::size_t{0});
        groom.groups.edit()[0].params.general.keepOutside = false;
        const Strands free = *generator.generate(groom, {2000u}, progress);
        QVERIFY(inside(free, surface->skin(), 1e-5f) > 10000);
    }

    void noVertexOfAHeadIsInside() {
        const auto file = testing::realData("heads/makehuman_derived/head_neutral_sub1.glb");
        if (!file) QSKIP("The real heads are not here.");
        Progress progress;
        Result<ImportedMesh> imported = importMesh(*file, progress);
        QVERIFY(imported);
        Groom groom = testing::groomOn(imported->mesh, 300, 15, 0.12f);
        bowInwards(groom, boundsOf(*groom.mesh).centre());
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        Generator generator;
        generator.setSurface(surface);
        const Strands kept = *generator.generate(groom, {5000u}, progress);
        const std::size_t wrong = inside(kept, surface->skin(), 2e-4f);
        QVERIFY2(wrong * 2000 < kept.vertexCount(),
                 qPrintable(QString("%1 of %2 vertices inside").arg(wrong).arg(kept.vertexCount())));
    }

    void hairOutsideStaysAndRootsNeverMove() {
        const SkinGuard guard(sphereSurface()->sharedSkin());
        std::vector<glm::vec3> points;
        std::vector<float> ease;
        for (int v = 0; v < 8; ++v) {
            points.emplace_back(0.1f + 0.01f * static_cast<float>(v), 0.0f, 0.0f);
            ease.push_back(std::min(1.0f, 0.3f * static_cast<float>(v)));
        }
        std::vector<glm::vec3> moved = points;
        guard.keepOutside(moved, ease);
        QCOMPARE(moved, points);
        points[0] = {0.05f, 0.0f, 0.0f};
        moved = points;
        guard.keepOutside(moved, ease);
        QCOMPARE(moved[0], points[0]);
    }

    // Moving a vertex towards and through the skin moves the result without a step (a fifth of a millimetre: the
    // facets of the mesh turn the way out).
    void isContinuous() {
        const SkinGuard guard(std::make_shared<const DistanceField>(DistanceField::build(testing::sphere(48, 96))));
        const DistanceField& skin = guard.skin();
        const std::vector<float> ease{0.0f, 1.0f};
        glm::vec3 before(0.0f);
        for (int step = 0; step < 2000; ++step) {
            const float height = 0.103f - 2.5e-6f * static_cast<float>(step);
            std::vector<glm::vec3> points{{0.1f, 0, 0}, glm::vec3(0.8f, 0.6f, 0.0f) * height};
            guard.keepOutside(points, ease);
            if (step > 0) QVERIFY(glm::distance(points[1], before) < 2e-4f);
            QVERIFY(skin.distance(points[1]) > 0.9f * guard.clearance());
            before = points[1];
        }
    }

    // The coarse grid never hides a vertex that the field would move.
    void farFromTheSkinNothingWouldMove() {
        const SkinGuard guard(sphereSurface()->sharedSkin());
        const DistanceField& skin = guard.skin();
        std::size_t moved = 0;
        for (std::uint64_t i = 0; i < 200000; ++i) {
            const glm::vec3 p(0.26f * randomFloat(1, i, 0) - 0.13f, 0.26f * randomFloat(1, i, 1) - 0.13f,
                              0.26f * randomFloat(1, i, 2) - 0.13f);
            std::vector<glm::vec3> points{glm::normalize(p) * 0.1f, p};
            guard.keepOutside(points, std::vector<float>{0.0f, 1.0f});
            if (points[1] == p)
                QVERIFY(skin.distance(p) >= 1.9f * guard.clearance());
            else
                ++moved;
        }
        QVERIFY(moved > 10000);
    }

    void sixteenHairsAtOnceStartWhereEachOneDoes() {
        // Hairs that wander in and out; the bytes before the start, and all after it, are those of the whole way.
        const SkinGuard guard(sphereSurface()->sharedSkin());
        constexpr std::size_t vertices = 12, lanes = SkinGuard::lanes;
        std::vector<float> ease;
        for (std::size_t v = 0; v < vertices; ++v) ease.push_back(std::min(1.0f, static_cast<float>(v) / 4.0f));
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            setSimdLevel(level);
            std::size_t free = 0, late = 0;
            for (std::uint32_t round = 0; round < 200; ++round) {
                std::vector<std::vector<glm::vec3>> hairs(lanes);
                std::vector<float> rows[3];
                for (std::vector<float>& row : rows) row.resize(lanes * vertices);
                for (std::size_t l = 0; l < lanes; ++l) {
                    const auto dice = [&](std::size_t v, std::uint32_t channel) {
                        return randomFloat(round, l * 64 + v, channel) - 0.5f;
                    };
                    const glm::vec3 way = glm::normalize(glm::vec3(dice(0, 0), dice(0, 1), dice(0, 2)));
                    const float step = 0.03f * randomFloat(round, l, 3), bend = 0.03f * randomFloat(round, l, 4);
                    glm::vec3 p = way * 0.1f;
                    for (std::size_t v = 0; v < vertices; ++v) {
                        hairs[l].push_back(p);
                        for (int axis = 0; axis < 3; ++axis) rows[axis][v * lanes + l] = p[axis];
                        p += way * step + bend * glm::vec3(dice(v, 5), dice(v, 6) - 0.3f, dice(v, 7));
                    }
                }
                SkinGuard::Start starts[lanes];
                guard.findStarts(rows[0].data(), rows[1].data(), rows[2].data(), ease, vertices, starts);
                for (std::size_t l = 0; l < lanes; ++l) {
                    std::vector<glm::vec3> whole = hairs[l], rest = hairs[l];
                    guard.keepOutside(whole, ease);
                    QVERIFY(starts[l].first >= 1 && starts[l].first <= vertices);
                    if (starts[l].first < vertices) guard.keepFrom(starts[l], rest, ease);
                    QVERIFY(whole == rest);
                    free += starts[l].first == vertices ? 1 : 0;
                    late += starts[l].first > 1 && starts[l].first < vertices ? 1 : 0;
                }
            }
            QVERIFY(free > 200 && late > 200);
        }
        setSimdLevel(bestSimdLevel());
    }

    // A hair through the whole head is laid around it instead of showing again on the other side.
    void aHairThroughTheHeadGoesAround() {
        const SkinGuard guard(sphereSurface()->sharedSkin());
        const DistanceField& skin = guard.skin();
        std::vector<glm::vec3> points;
        std::vector<float> ease;
        for (int v = 0; v <= 30; ++v) {
            points.emplace_back(0.09f - 0.01f * static_cast<float>(v), 0.0436f, 0.0f);
            ease.push_back(std::min(1.0f, 0.2f * static_cast<float>(v)));
        }
        guard.keepOutside(points, ease);
        for (std::size_t v = 1; v < points.size(); ++v) {
            QVERIFY(skin.distance(points[v]) > -1e-5f);
            QVERIFY(glm::distance(points[v], points[v - 1]) < 0.02f);
        }
    }
};

QTEST_APPLESS_MAIN(OutsideTest)
#include "outside_test.moc"
