// SPDX-License-Identifier: Apache-2.0
// Laws of hair beside partings.
#include "core/base/random.h"
#include "core/commands/partings.h"
#include "core/hair/generate.h"
#include "core/hair/guide_index.h"
#include "core/hair/reference.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>

using namespace whorl;

namespace {

using Neighbours = std::array<Neighbour, GuideIndex::maxNeighbours>;

// Guides at random places of a mesh that lie flat to the side that they are on: to -x or to +x.
Groom combedApart(SurfaceMesh mesh, int guides, std::uint32_t seed) {
    Groom groom = makeGroom(std::move(mesh));
    groom.groups.edit()[0].params.general.keepOutside = false;
    groom.groups.edit()[0].params.general.segments = 4;
    groom.counts.edit().hairs = 3000;
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(guides); ++i) {
        const auto triangle = static_cast<std::uint32_t>(randomBits(seed, i, 0) % groom.mesh->triangleCount());
        const float u = randomFloat(seed, i, 1);
        const SurfacePoint root{triangle, u, (1.0f - u) * randomFloat(seed, i, 2)};
        const glm::vec3 start = positionAt(*groom.mesh, root);
        const glm::vec3 way(start.x < 0.0f ? -0.01f : 0.01f, 0.002f, 0.0f);
        std::vector<glm::vec3> points;
        for (int k = 0; k <= 4; ++k) points.push_back(start + way * static_cast<float>(k));
        groom.guides.append(root, 0, points);
    }
    return groom;
}

void part(Groom& groom, const std::vector<glm::vec3>& points) {
    const Surface surface(groom.mesh);
    QVERIFY(addParting(groom, surface, points).ok());
}

}  // namespace

class PartedHairTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void findsWhatASearchOfAllGuidesFinds() {
        Groom groom = combedApart(testing::sphere(24, 48), 500, 3);
        part(groom, {{0.02f, 0, 0.1f}, {0, 0.1f, 0}, {0, 0, -0.1f}});
        part(groom, {{-0.08f, 0, 0.05f}, {0.05f, -0.03f, 0.08f}});
        const GuideIndex index(groom);
        int parted = 0;
        for (std::uint64_t i = 0; i < 1500; ++i) {
            const glm::vec3 normal = glm::normalize(
                glm::vec3(randomFloat(5, i, 0), randomFloat(5, i, 1), randomFloat(5, i, 2)) * 2.0f - 1.0f);
            const glm::vec3 place = normal * 0.1f;
            struct Found {
                float distance;
                std::uint32_t id, guide;
            };
            std::vector<Found> all;
            for (const GuideRoot& root : index.rootsOf(0)) {
                const float detour = index.partings().detour({place, normal}, {root.position, root.normal});
                if (detour != 1.0f) ++parted;
                if (detour == PartingIndex::separate) continue;
                all.push_back({rootDistanceSquared(place, normal, root) * detour * detour, root.id, root.guide});
            }
            std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) {
                return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
            });
            const int samples = 1 + static_cast<int>(i % 20);
            Neighbours found;
            const std::size_t count = index.nearest(0, place, normal, samples, found);
            QCOMPARE(count, std::min(static_cast<std::size_t>(samples), all.size()));
            for (std::size_t j = 0; j < count; ++j) QCOMPARE(found[j].guide, all[j].guide);
        }
        QVERIFY(parted > 1000);
    }

    // Walking round the end of a parting, no guide's weight jumps.
    void weightsAreContinuousRoundTheEnd() {
        Groom groom = combedApart(testing::plane(20), 400, 7);
        part(groom, {{0, 0, -0.4f}, {0, 0, 0.0f}});
        const GuideIndex index(groom);
        const glm::vec3 up(0, 1, 0);
        for (const float radius : {0.15f, 0.05f, 0.01f}) {
            std::vector<float> before(groom.guides.count(), -1.0f);
            // From the left side of the line round its end to the right side.
            for (int step = 1; step < 8000; ++step) {
                const float turn = static_cast<float>(step) / 8000.0f * 6.2831853f - 1.5707963f;
                const glm::vec3 place(radius * std::cos(turn), 0.0f, radius * std::sin(turn));
                Neighbours found;
                const std::size_t count = index.nearest(0, place, up, 4, found);
                std::vector<float> now(groom.guides.count(), 0.0f);
                for (std::size_t j = 0; j < count; ++j) now[found[j].guide] = found[j].weight;
                float jump = 0.0f;
                for (std::size_t g = 0; step > 1 && g < now.size(); ++g)
                    jump = std::max(jump, std::abs(now[g] - before[g]));
                QVERIFY(jump < 0.05f);
                before = now;
            }
        }
    }

    // Guides to the left and to the right: near the line hair stands up where they mix, unless a parting keeps them
    // apart.
    void noHairCrossesTheLine() {
        Groom groom = combedApart(testing::plane(20), 600, 11);
        Progress progress;
        const auto tipsAcross = [&](const Strands& strands) {
            int across = 0;
            for (std::size_t i = 0; i < strands.count(); ++i) {
                const glm::vec3 root = strands.positions[strands.firstVertex[i]];
                const glm::vec3 way = strands.positions[strands.firstVertex[i + 1] - 1] - root;
                if (std::abs(root.z) < 0.3f && std::abs(std::abs(way.x) - 0.04f) > 1e-5f) ++across;
                if (std::abs(root.z) < 0.3f && way.x * root.x < 0.0f) ++across;
            }
            return across;
        };
        Generator generator;
        QVERIFY(tipsAcross(*generator.generate(groom, {}, progress)) > 50);
        part(groom, {{0, 0, -0.5f}, {0, 0, 0.5f}});
        const auto parted = generator.generate(groom, {}, progress);
        QVERIFY(parted->count() > 2900);
        QCOMPARE(tipsAcross(*parted), 0);
        // The kept generator follows the parting as a fresh one does.
        QCOMPARE(parted->positions, Generator().generate(groom, {}, progress)->positions);
        groom.partings = {};
        QVERIFY(tipsAcross(*generator.generate(groom, {}, progress)) > 50);
    }

    void asTheReference() {
        Groom groom = combedApart(testing::sphere(24, 48), 200, 5);
        part(groom, {{0, -0.02f, 0.1f}, {0, 0.1f, 0}, {0, -0.02f, -0.1f}});
        Progress progress;
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        const auto fast = Generator().generate(groom, {}, progress);
        const auto slow = generateReference(groom, surface, {}, progress);
        QVERIFY(fast.ok() && slow.ok());
        QCOMPARE(fast->ids, slow->ids);
        for (std::size_t v = 0; v < fast->vertexCount(); ++v)
            QVERIFY(glm::distance(fast->positions[v], slow->positions[v]) < 1e-6f);
    }

    // Where all guides are beyond a parting there is no hair, as in a group without guides.
    void sidesWithoutGuidesStayBare() {
        Groom groom = combedApart(testing::plane(20), 300, 13);
        const auto inside = [](const glm::vec3& p) { return std::abs(p.x) < 0.2f && std::abs(p.z) < 0.2f; };
        std::vector<std::size_t> within;
        for (std::size_t i = 0; i < groom.guides.count(); ++i)
            if (inside(groom.guides.points(i)[0])) within.push_back(i);
        groom.guides.erase(within);
        part(groom, {{-0.2f, 0, -0.2f}, {0.2f, 0, -0.2f}, {0.2f, 0, 0.2f}, {-0.2f, 0, 0.2f}, {-0.2f, 0, -0.2f}});
        Progress progress;
        const auto strands = Generator().generate(groom, {}, progress);
        QVERIFY(strands->count() > 2000 && strands->count() < 2800);
        for (std::size_t i = 0; i < strands->count(); ++i)
            QVERIFY(!inside(strands->positions[strands->firstVertex[i]] * 1.02f));
    }

    // Beside a parting the neighbours are guides of the hair's own side, on both sides of a mirrored head alike.
    void mirrorsTheSame() {
        Groom groom = combedApart(testing::sphere(24, 48), 0, 1);
        const Surface surface(groom.mesh);
        for (std::uint64_t i = 0; i < 300; ++i) {
            const float a = 2.0f * randomFloat(2, i, 0), b = 6.2831853f * randomFloat(2, i, 1);
            const glm::vec3 n(std::abs(std::sin(a) * std::cos(b)) + 1e-3f, std::cos(a), std::sin(a) * std::sin(b));
            for (const float side : {-1.0f, 1.0f}) {
                const auto hit = surface.query.nearest(glm::normalize(n) * 0.1f * glm::vec3(side, 1, 1));
                const std::vector<glm::vec3> points{hit->position, hit->position + n};
                groom.guides.append(hit->point, 0, points);
            }
        }
        part(groom, {{0, -0.02f, 0.1f}, {0, 0.1f, 0}, {0, -0.02f, -0.1f}});
        const GuideIndex index(groom);
        int same = 0, all = 0;
        for (std::uint64_t i = 0; i < 500; ++i) {
            const float z = 0.12f * randomFloat(3, i, 1) - 0.06f;
            const glm::vec3 n = glm::normalize(glm::vec3(0.002f + 0.03f * randomFloat(3, i, 0), 0.1f, z));
            const glm::vec3 m(-n.x, n.y, n.z);
            Neighbours left, right;
            const std::size_t count = index.nearest(0, m * 0.1f, m, 4, left);
            QCOMPARE(index.nearest(0, n * 0.1f, n, 4, right), count);
            for (std::size_t j = 0; j < count; ++j) {
                QVERIFY(left[j].root->position.x < 0.0f && right[j].root->position.x > 0.0f);
                same += left[j].guide + 1 == right[j].guide && std::abs(left[j].weight - right[j].weight) < 1e-3f;
                ++all;
            }
        }
        // Roots are rounded to their triangles: a few ties may fall otherwise.
        QVERIFY(same > all * 98 / 100);
    }
};

QTEST_APPLESS_MAIN(PartedHairTest)
#include "parted_hair_test.moc"
