// SPDX-License-Identifier: Apache-2.0
#include "core/hair/guide_index.h"

#include "core/base/random.h"
#include "core/hair/bindings.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

namespace {

// Guides at random places of a sphere, in two groups.
Groom scattered(int guides, std::uint32_t seed) {
    Groom groom = testing::groomOn(testing::sphere(24, 48), 0);
    groom.groups.edit().push_back({"other"});
    const std::vector<glm::vec3> points{{0, 0, 0}, {0, 1, 0}};
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(guides); ++i) {
        const auto triangle = static_cast<std::uint32_t>(randomBits(seed, i, 0) % groom.mesh->triangleCount());
        groom.guides.append({triangle, 0.3f * randomFloat(seed, i, 1), 0.3f * randomFloat(seed, i, 2)},
                            randomFloat(seed, i, 3) < 0.5f ? 0 : 1, points);
    }
    return groom;
}

glm::vec3 randomPlace(std::uint32_t seed, std::uint64_t i) {
    return {0.2f * randomFloat(seed, i, 10) - 0.1f, 0.2f * randomFloat(seed, i, 11) - 0.1f,
            0.2f * randomFloat(seed, i, 12) - 0.1f};
}

}  // namespace

class GuideIndexTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void findsWhatASearchOfAllGuidesFinds() {
        const Groom groom = scattered(700, 3);
        const GuideIndex index(groom);
        for (std::uint64_t i = 0; i < 400; ++i) {
            const std::size_t group = i % 2;
            const glm::vec3 place = randomPlace(5, i), normal = glm::normalize(randomPlace(6, i));
            const int samples = 1 + static_cast<int>(i % 20);
            struct Found {
                float distance;
                std::uint32_t id, guide;
            };
            std::vector<Found> all;
            for (std::size_t g = 0; g < groom.guides.count(); ++g) {
                if (groom.guides.group(g) != group) continue;
                const GuideRoot root{static_cast<std::uint32_t>(g), groom.guides.id(g),
                                     positionAt(*groom.mesh, groom.guides.root(g)),
                                     normalAt(*groom.mesh, groom.guides.root(g))};
                all.push_back({rootDistanceSquared(place, normal, root), root.id, root.guide});
            }
            std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) {
                return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
            });
            std::array<Neighbour, GuideIndex::maxNeighbours> found;
            const std::size_t count = index.nearest(group, place, normal, samples, found);
            QCOMPARE(count, static_cast<std::size_t>(samples));
            float sum = 0;
            for (std::size_t j = 0; j < count; ++j) {
                QCOMPARE(found[j].guide, all[j].guide);
                QVERIFY(found[j].weight >= 0.0f);
                if (j > 0) QVERIFY(found[j].weight <= found[j - 1].weight);
                sum += found[j].weight;
            }
            QVERIFY(std::abs(sum - 1.0f) < 1e-5f);
        }
    }

    // Hairs bound together, in crowds and alone, beside partings and across groups, as one after another.
    void bindingsAreThoseOfSingleQueries() {
        for (const int guides : {0, 1, 3, 40, 700, 6000}) {
            Groom groom = scattered(guides, 12);
            groom.groups.edit()[0].params.general.samples = 4;
            groom.groups.edit()[1].params.general.samples = 9;
            groom.groups.edit()[1].params.general.interpolation.index = 1;
            if (guides == 700) groom.partings.edit() = {{1, "", {{100, 0.2f, 0.2f}, {160, 0.2f, 0.2f}, {400, 0, 0}}}};
            const GuideIndex index(groom);
            std::vector<HairRoot> roots;
            for (std::uint32_t i = 0; i < 4000; ++i) {
                HairRoot root;
                root.id = i;
                // Runs of neighbours, and jumps between them.
                const auto run = i / 100;
                const glm::vec3 place = randomPlace(7, run) + 0.05f * randomPlace(8, i) * randomFloat(9, run, 0);
                root.normal = glm::normalize(place);
                root.position = root.normal * 0.1f;
                root.group = randomFloat(9, run, 1) < 0.3f ? static_cast<std::uint8_t>(i % 2) : 0;
                roots.push_back(root);
            }
            // A hair at a guide's root, and one where the skin faces the other way.
            if (guides > 0 && !index.rootsOf(0).empty()) roots[500].position = index.rootsOf(0)[0].position;
            roots[600].normal = -roots[600].normal;
            Progress progress;
            const Bindings bindings = bindHairs(groom, index, roots, progress);
            for (std::size_t i = 0; i < roots.size(); ++i) {
                const GeneralParams& general = (*groom.groups)[roots[i].group].params.general;
                std::array<Neighbour, GuideIndex::maxNeighbours> found;
                const std::size_t count =
                    index.nearest(roots[i].group, roots[i].position, roots[i].normal, general.samples, found);
                QCOMPARE(std::size_t{bindings.counts[i]}, count);
                for (std::size_t j = 0; j < count; ++j) {
                    const std::size_t place = i * bindings.perHair + j;
                    QCOMPARE(bindings.guides[place], found[j].guide);
                    QCOMPARE(bindings.weights[place], found[j].weight);
                }
            }
        }
    }

    void onlyAGuideCountsAtItsOwnRoot() {
        const Groom groom = scattered(100, 9);
        const GuideIndex index(groom);
        for (const GuideRoot& root : index.rootsOf(1)) {
            std::array<Neighbour, 3> found;
            QCOMPARE(index.nearest(1, root.position, root.normal, 3, found), std::size_t{3});
            QCOMPARE(found[0].guide, root.guide);
            QCOMPARE(found[0].weight, 1.0f);
            QCOMPARE(found[1].weight, 0.0f);
        }
    }

    // Walking over the surface, no guide's weight jumps, also where the set of neighbours changes.
    void weightsAreContinuous() {
        const Groom groom = scattered(300, 4);
        const GuideIndex index(groom);
        std::vector<float> before(groom.guides.count(), -1.0f);
        for (int step = 0; step < 20000; ++step) {
            const float angle = static_cast<float>(step) * 1e-4f;
            const glm::vec3 normal(std::cos(angle), 0.2f * std::sin(angle), std::sin(angle));
            const glm::vec3 unit = glm::normalize(normal);
            std::array<Neighbour, 4> found;
            const std::size_t count = index.nearest(0, unit * 0.1f, unit, 4, found);
            std::vector<float> now(groom.guides.count(), 0.0f);
            for (std::size_t j = 0; j < count; ++j) now[found[j].guide] = found[j].weight;
            for (std::size_t g = 0; step > 0 && g < now.size(); ++g) QVERIFY(std::abs(now[g] - before[g]) < 0.05f);
            before = now;
        }
    }

    // Two sheets 2 mm apart with guides 6 mm apart: hairs take guides of their own side.
    void guidesAcrossAThinSheetComeLast() {
        SurfaceMesh sheet = testing::plane(10, 0.1f);
        const auto corners = static_cast<std::uint32_t>(sheet.positions.size());
        const std::uint32_t triangles = sheet.triangleCount();
        for (std::uint32_t i = 0; i < corners; ++i) {
            sheet.positions.push_back(sheet.positions[i] - glm::vec3(0, 0.002f, 0));
            sheet.normals.push_back(-sheet.normals[i]);
        }
        for (std::uint32_t i = 0; i < triangles; ++i) {
            const glm::uvec3 t = sheet.triangles[i] + corners;
            sheet.triangles.push_back({t.x, t.z, t.y});
            for (std::size_t c = 0; c < 3; ++c) sheet.cornerUvs.push_back(sheet.cornerUvs[i * 3 + c]);
        }
        sheet.parts = {{"sheet", 0, triangles * 2}};
        Groom groom = makeGroom(sheet);
        const std::vector<glm::vec3> points{{0, 0, 0}, {0, 1, 0}};
        for (std::uint32_t i = 0; i < triangles * 2; ++i) groom.guides.append({i, 0.3f, 0.3f}, 0, points);
        const GuideIndex index(groom);
        for (std::uint32_t i = 0; i < triangles * 2; ++i) {
            const SurfacePoint root{i, 0.1f, 0.7f};
            const glm::vec3 normal = normalAt(sheet, root);
            std::array<Neighbour, 3> found;
            const std::size_t count = index.nearest(0, positionAt(sheet, root), normal, 3, found);
            for (std::size_t j = 0; j < count; ++j) QVERIFY(glm::dot(found[j].root->normal, normal) > 0.9f);
        }
    }

    void takesFewNoneAndCoincidentGuides() {
        Groom groom = scattered(0, 1);
        std::array<Neighbour, 20> found;
        const glm::vec3 up(0, 1, 0);
        QCOMPARE(GuideIndex(groom).nearest(0, up, up, 3, found), std::size_t{0});
        QCOMPARE(GuideIndex(groom).nearest(7, up, up, 3, found), std::size_t{0});
        const std::vector<glm::vec3> points{{0, 0, 0}, {0, 1, 0}};
        for (int i = 0; i < 200; ++i) groom.guides.append({5, 0.3f, 0.3f}, 0, points);
        QCOMPARE(GuideIndex(groom).nearest(0, up, up, 3, found), std::size_t{3});
        for (std::uint32_t j = 0; j < 3; ++j) {
            QCOMPARE(found[j].guide, j);
            QVERIFY(std::abs(found[j].weight - 1.0f / 3.0f) < 1e-6f);
        }
        const GuideIndex index(groom);
        const GuideRoot& root = index.rootsOf(0)[0];
        QCOMPARE(index.nearest(0, root.position, root.normal, 2, found), std::size_t{2});
        QCOMPARE(found[0].weight, 0.5f);
    }
};

QTEST_APPLESS_MAIN(GuideIndexTest)
#include "guide_index_test.moc"
