// SPDX-License-Identifier: Apache-2.0
#include "core/surface/parting_index.h"

#include "core/base/random.h"
#include "core/io/mesh_import.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

namespace {

using Root = PartingIndex::Root;

Parting traced(const Surface& surface, const std::vector<glm::vec3>& points) {
    auto line = tracedParting(surface, points);
    return line ? Parting{1, "", *line} : Parting{};
}

Root rootAt(const SurfaceMesh& mesh, const SurfacePoint& point) {
    return {positionAt(mesh, point), normalAt(mesh, point)};
}

Root randomRoot(const SurfaceMesh& mesh, std::uint32_t seed, std::uint64_t i) {
    const auto triangle = static_cast<std::uint32_t>(randomBits(seed, i, 0) % mesh.triangleCount());
    const float u = randomFloat(seed, i, 1);
    return rootAt(mesh, {triangle, u, (1.0f - u) * randomFloat(seed, i, 2)});
}

Root onPlane(float x, float z) {
    return {{x, 0, z}, {0, 1, 0}};
}

Root onBall(float x, float y, float z) {
    const glm::vec3 normal = glm::normalize(glm::vec3(x, y, z));
    return {normal * 0.1f, normal};
}

}  // namespace

class PartingIndexTest : public QObject {
    Q_OBJECT

private:
    // A plane of a metre with a parting along x = 0 from z = -0.3 to 0.3.
    const Surface m_plane{Cow<SurfaceMesh>(testing::plane(20))};
    const Parting m_middle = traced(m_plane, {{0, 0, -0.3f}, {0, 0, 0.3f}});

private Q_SLOTS:
    void nothingIsPartedWithoutPartings() {
        const PartingIndex none;
        QVERIFY(none.empty());
        QCOMPARE(none.detour(onPlane(-1, 0), onPlane(1, 0)), 1.0f);
        QVERIFY(!none.near({0, 0, 0}, 100.0f));
        const Parting nowhere{1, "", {{0, 0.1f, 0.1f}, {0, 0.1f, 0.1f}}};
        QVERIFY(PartingIndex(m_plane.mesh(), {&nowhere, 1}).empty());
    }

    void tracingFollowsTheSkin() {
        const Surface ball{Cow<SurfaceMesh>(testing::sphere(48, 96))};
        const std::vector<glm::vec3> three{{0, 0, 0.1f}, {0, 0.1f, 0}, {0, 0, -0.1f}};
        const Parting line = traced(ball, three);
        const std::vector<glm::vec3> positions = partingPositions(ball.mesh(), line);
        QVERIFY(positions.size() > 80);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            QVERIFY(std::abs(glm::length(positions[i]) - 0.1f) < 2e-4f);
            QVERIFY(std::abs(positions[i].x) < 1e-3f);
            if (i > 0) QVERIFY(glm::distance(positions[i], positions[i - 1]) <= 1.01f * partingStep(ball));
        }
        QVERIFY(std::abs(partingLength(ball.mesh(), line) - 0.314f) < 0.003f);
    }

    void tracingRefusesWhatIsNoLine() {
        const float nan = std::nanf("");
        for (const std::vector<glm::vec3>& points :
             {std::vector<glm::vec3>{}, {{0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {nan, 0, 0}}}) {
            const auto line = tracedParting(m_plane, points);
            QVERIFY(!line.ok());
            QVERIFY(line.error().message.ends_with('.'));
        }
    }

    void partsThePlaneAtItsLine() {
        const PartingIndex index(m_plane.mesh(), {&m_middle, 1});
        for (std::uint64_t i = 0; i < 4000; ++i) {
            // Less than a quarter of the line apart, and away from its ends by more than that.
            const Root a = onPlane(0.1f * randomFloat(1, i, 0) - 0.05f, 0.3f * randomFloat(1, i, 1) - 0.15f);
            const Root b =
                onPlane(0.1f * randomFloat(1, i, 2) - 0.05f, a.position.z + 0.1f * randomFloat(1, i, 3) - 0.05f);
            const bool apart = (a.position.x < 0) != (b.position.x < 0);
            QCOMPARE(index.separated(a, b), apart);
            QCOMPARE(index.separated(b, a), apart);
            if (!apart) QCOMPARE(index.detour(a, b), 1.0f);
        }
    }

    // Normals of scans shake, and the curtain twists: on which side a root lies is the same for all other roots, near
    // and far, however near to the line it is itself.
    void sidesAreTheSameForAllPairs() {
        SurfaceMesh mesh = m_plane.mesh();
        for (std::size_t v = 0; v < mesh.normals.size(); ++v)
            mesh.normals[v] = glm::normalize(glm::vec3(randomFloat(4, v, 0) - 0.5f, 1.0f, randomFloat(4, v, 1) - 0.5f));
        const PartingIndex index(mesh, {&m_middle, 1});
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const float nearness = std::pow(10.0f, -1.0f - 5.0f * randomFloat(5, i, 0));
            const Root a = onPlane(nearness * (randomFloat(5, i, 1) - 0.5f), 0.3f * randomFloat(5, i, 2) - 0.15f);
            const Root b =
                onPlane(0.1f * randomFloat(5, i, 3) - 0.05f, a.position.z + 0.1f * randomFloat(5, i, 4) - 0.05f);
            const bool apart = (a.position.x < 0) != (b.position.x < 0);
            QCOMPARE(index.separated(a, b), apart);
            QCOMPARE(index.separated(b, a), apart);
        }
        // Off the plane no formula says where the curtain is, but of three pairs of roots none or two are parted.
        for (std::size_t v = 0; v < mesh.normals.size(); ++v)
            mesh.normals[v] = glm::normalize(glm::vec3(3.0f * mesh.positions[v].z, 1.0f, 2.0f * mesh.positions[v].z));
        const Parting piece{1, "", {m_middle.points.front(), m_middle.points.back()}};
        const PartingIndex twisted(mesh, {&piece, 1});
        int parted = 0;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            Root three[3];
            for (std::uint64_t k = 0; k < 3; ++k) {
                three[k] = onPlane(0.3f * randomFloat(6, i, k) - 0.15f, 0.4f * randomFloat(6, i, 3 + k) - 0.2f);
                three[k].position.y = 0.4f * randomFloat(6, i, 6 + k) - 0.2f;
            }
            int count = 0;
            for (int k = 0; k < 3; ++k) count += twisted.detour(three[k], three[(k + 1) % 3]) > 1.0f;
            QVERIFY2(count == 0 || count == 2, qPrintable(QString("%1: %2").arg(i).arg(count)));
            parted += count > 0;
            // Beyond an end there is no curtain.
            for (Root& root : three) root.position.z += i % 2 == 0 ? 0.7f : -0.7f;
            for (int k = 0; k < 3; ++k) QCOMPARE(twisted.detour(three[k], three[(k + 1) % 3]), 1.0f);
        }
        QVERIFY(parted > 10000);
    }

    // Ways straight through the points of the line, where two pieces of curtain meet.
    void hasNoCracks() {
        const Surface ball{Cow<SurfaceMesh>(testing::sphere(48, 96))};
        const Parting line = traced(ball, {{0, 0, 0.1f}, {0.02f, 0.1f, 0}, {0, 0, -0.1f}});
        const PartingIndex index(ball.mesh(), {&line, 1});
        for (std::size_t i = 30; i + 30 < line.points.size(); ++i) {
            const Root at = rootAt(ball.mesh(), line.points[i]);
            for (std::uint64_t k = 0; k < 64; ++k) {
                const glm::vec3 aside =
                    0.01f * glm::vec3(1.0f, 0.4f * randomFloat(2, k, 0) - 0.2f, 0.4f * randomFloat(2, k, 1) - 0.2f);
                const Root a{at.position + aside, at.normal}, b{at.position - aside, at.normal};
                QVERIFY(index.separated(a, b) && index.separated(b, a));
            }
        }
    }

    void partsABallAlsoFarApart() {
        const Surface ball{Cow<SurfaceMesh>(testing::sphere(48, 96))};
        const Parting line = traced(ball, {{0, -0.02f, 0.1f}, {0, 0.1f, 0}, {0, -0.02f, -0.1f}});
        const PartingIndex index(ball.mesh(), {&line, 1});
        for (float angle = 0.02f; angle < 0.7f; angle += 0.02f) {
            const Root left = onBall(-std::sin(angle), std::cos(angle), 0.0f);
            const Root right = onBall(std::sin(angle), std::cos(angle), 0.0f);
            QVERIFY(index.separated(left, right));
            QVERIFY(!index.separated(left, onBall(-std::sin(angle), std::cos(angle), 0.1f)));
            // The chin is not parted by a line over the crown.
            QCOMPARE(index.detour(onBall(-0.3f * std::sin(angle), -1, 0), onBall(0.3f * std::sin(angle), -1, 0)), 1.0f);
        }
    }

    // A line on the upper sheet does nothing to the lower one, two millimetres below.
    void leavesTheOtherSideOfASheetAlone() {
        const PartingIndex index(m_plane.mesh(), {&m_middle, 1});
        const glm::vec3 down(0, -1, 0);
        QVERIFY(!index.separated({{-0.01f, -0.002f, 0}, down}, {{0.01f, -0.002f, 0}, down}));
        QVERIFY(index.separated({{-0.01f, -0.002f, 0}, -down}, {{0.01f, -0.002f, 0}, -down}));
    }

    // Past the end nothing jumps; far before it nothing passes.
    void endsOpenSmoothly() {
        const PartingIndex index(m_plane.mesh(), {&m_middle, 1});
        double before = 0.0;
        bool open = false;
        for (float z = 0.0f; z < 0.4f; z += 1e-4f) {
            const float detour = index.detour(onPlane(-0.02f, z), onPlane(0.02f, z));
            const double passes = detour == PartingIndex::separate ? 0.0 : 1.0 / double{detour};
            if (z < 0.27f) QCOMPARE(passes, 0.0);
            if (z > 0.3001f) QCOMPARE(passes, 1.0);
            if (z > 0.27f) QVERIFY(std::abs(passes - before) < 0.02);
            QVERIFY(passes >= before);
            open = open || (passes > 0.0 && passes < 1.0);
            before = passes;
        }
        QVERIFY(open);
    }

    void joinedEndsDoNotOpen() {
        // A second line whose end stops two millimetres before the first.
        const Parting side = traced(m_plane, {{-0.002f, 0, 0}, {-0.2f, 0, 0}});
        const std::vector<Parting> both{m_middle, side};
        const PartingIndex index(m_plane.mesh(), both);
        for (float x = -0.001f; x > -0.1f; x -= 0.001f) QVERIFY(index.separated(onPlane(x, -0.01f), onPlane(x, 0.01f)));
        QVERIFY(!index.separated(onPlane(-0.25f, -0.01f), onPlane(-0.25f, 0.01f)));
        // A closed line has no ends.
        const Parting ring = traced(m_plane, {{0.1f, 0, 0}, {0, 0, 0.1f}, {-0.1f, 0, 0}, {0, 0, -0.1f}, {0.1f, 0, 0}});
        const PartingIndex closed(m_plane.mesh(), {&ring, 1});
        for (int i = 0; i < 360; ++i) {
            const float turn = static_cast<float>(i) * 0.0174533f;
            QVERIFY(closed.separated(onPlane(0.05f * std::cos(turn), 0.05f * std::sin(turn)),
                                     onPlane(0.12f * std::cos(turn), 0.12f * std::sin(turn))));
        }
    }

    void mirrorsTheSame() {
        const Surface ball{Cow<SurfaceMesh>(testing::sphere(48, 96))};
        const Parting line = traced(ball, {{0.03f, 0.02f, 0.1f}, {0.05f, 0.1f, 0}});
        const Parting other = traced(ball, {{-0.03f, 0.02f, 0.1f}, {-0.05f, 0.1f, 0}});
        const PartingIndex index(ball.mesh(), {&line, 1}), mirror(ball.mesh(), {&other, 1});
        int separated = 0, differing = 0;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            Root a = randomRoot(ball.mesh(), 4, i), b = randomRoot(ball.mesh(), 5, i);
            b.position = glm::normalize(a.position + 0.3f * b.position) * 0.1f;
            b.normal = b.position * 10.0f;
            const float here = index.detour(a, b);
            a.position.x *= -1, a.normal.x *= -1, b.position.x *= -1, b.normal.x *= -1;
            const float there = mirror.detour(a, b);
            separated += here == PartingIndex::separate;
            // The tracing rounds; only ways within that of the curtain's border may differ.
            differing += std::abs(1.0f / here - 1.0f / there) > 0.02f;
        }
        QVERIFY2(separated > 100, qPrintable(QString::number(separated)));
        QVERIFY2(differing < 20, qPrintable(QString::number(differing)));
    }

    // Whatever is parted lies in a ball that is said to be near.
    void nearIsSafe() {
        const Surface ball{Cow<SurfaceMesh>(testing::sphere(48, 96))};
        const std::vector<Parting> lines{traced(ball, {{0.03f, 0.02f, 0.1f}, {0.05f, 0.1f, 0}}),
                                         traced(ball, {{-0.1f, 0, 0.0f}, {0, 0.05f, 0.1f}})};
        const PartingIndex index(ball.mesh(), lines);
        int far = 0;
        for (std::uint64_t i = 0; i < 50000; ++i) {
            const Root a = randomRoot(ball.mesh(), 8, i);
            Root b = randomRoot(ball.mesh(), 9, i);
            b.position = glm::normalize(a.position + randomFloat(8, i, 9) * b.position) * 0.1f;
            const bool parted = index.detour(a, b) != 1.0f;
            const glm::vec3 centre = (a.position + b.position) * 0.5f;
            const bool near = index.near(centre, glm::distance(a.position, b.position) * 0.5001f);
            if (parted) QVERIFY(near);
            far += !near;
        }
        QVERIFY(far > 2000);
    }

    // A place in the line comes to lie on one side of it for all others; one that is clear of it stays.
    void besideIsClearOfTheLine() {
        const Surface ball{Cow<SurfaceMesh>(testing::sphere(48, 96))};
        const PartingIndex index(ball.mesh(), std::vector{traced(ball, {{0, 0.05f, 0.1f}, {0, 0.1f, -0.1f}})});
        const float distance = 1e-4f;
        int moved = 0;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            const float up = 0.5f + 1.5f * randomFloat(11, i, 0), off = 2e-4f * (randomFloat(11, i, 1) - 0.5f);
            const Root on = onBall(10.0f * off, std::sin(up), std::cos(up));
            const Root clear{index.beside(on.position, distance), on.normal};
            const float way = glm::distance(clear.position, on.position);
            QVERIFY(way < 1.01f * distance);
            moved += way > 0.0f;
            int parted = 0;
            for (const float x : {-0.3f, 0.3f}) {
                for (int k = 0; k < 4; ++k) {
                    const float near = up + 0.05f * static_cast<float>(k) - 0.075f;
                    parted +=
                        index.detour(clear, onBall(x, std::sin(near), std::cos(near))) > 1.0f ? (x < 0 ? 1 : 8) : 0;
                }
            }
            // From all of one side and none of the other.
            QVERIFY2(parted == 4 || parted == 32, qPrintable(QString::number(parted)));
            QVERIFY(glm::distance(index.beside(clear.position, 0.99f * distance), clear.position) < 1e-6f);
        }
        QVERIFY(moved > 1000);
        QCOMPARE(index.beside({0.05f, 0.08f, 0.02f}, distance), glm::vec3(0.05f, 0.08f, 0.02f));
        QCOMPARE(PartingIndex().beside({1, 2, 3}, 1.0f), glm::vec3(1, 2, 3));
    }

    void realHeads() {
        const auto folder = testing::realData("heads");
        if (!folder) QSKIP("no real data here");
        int heads = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
            if (entry.path().extension() != ".obj" && entry.path().extension() != ".glb") continue;
            Progress progress;
            const auto made = importMesh(entry.path(), progress);
            if (!made || made->mesh.triangleCount() > 400000) continue;
            ++heads;
            const Surface head{Cow<SurfaceMesh>(made->mesh)};
            const glm::vec3 centre = head.bounds.centre(), size = head.bounds.size();
            // Over the crown from front to back.
            const float top = head.bounds.max.y;
            const Parting line = traced(head, {{centre.x, top - 0.1f * size.y, head.bounds.max.z - 0.2f * size.z},
                                               {centre.x, top, centre.z},
                                               {centre.x, top - 0.2f * size.y, head.bounds.min.z}});
            QVERIFY(line.points.size() > 20);
            const PartingIndex index(head.mesh(), {&line, 1});
            const float reach = 0.04f * size.x;
            for (std::size_t i = line.points.size() / 3; i < line.points.size() * 2 / 3; ++i) {
                const Root at = rootAt(head.mesh(), line.points[i]);
                const glm::vec3 along =
                    positionAt(head.mesh(), line.points[i + 2]) - positionAt(head.mesh(), line.points[i - 2]);
                const glm::vec3 aside = glm::normalize(glm::cross(along, at.normal)) * reach;
                const auto left = head.query.nearest(at.position + aside),
                           right = head.query.nearest(at.position - aside);
                QVERIFY(left && right);
                QVERIFY2(index.separated(rootAt(head.mesh(), left->point), rootAt(head.mesh(), right->point)),
                         entry.path().c_str());
            }
            if (heads == 3) return;
        }
        if (heads == 0) QSKIP("no head could be read");
    }
};

QTEST_APPLESS_MAIN(PartingIndexTest)
#include "parting_index_test.moc"
