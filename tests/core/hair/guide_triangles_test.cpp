// SPDX-License-Identifier: Apache-2.0
#include "core/hair/guide_triangles.h"

#include "core/base/random.h"
#include "core/commands/partings.h"
#include "core/hair/generate.h"
#include "core/hair/reference.h"
#include "core/surface/surface_point.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

using namespace whorl;

namespace {

using Neighbours = std::array<Neighbour, GuideIndex::maxNeighbours>;

const std::vector<glm::vec3> upright{{0, 0, 0}, {0, 1, 0}};

void fromTriangles(Groom& groom) {
    for (Group& group : groom.groups.edit()) group.params.general.guidesFrom.index = 1;
}

// Guides at random places, all of one group.
Groom scattered(SurfaceMesh mesh, int guides, std::uint32_t seed) {
    Groom groom = makeGroom(std::move(mesh));
    groom.groups.edit()[0].params.general.segments = 1;
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(guides); ++i) {
        const auto triangle = static_cast<std::uint32_t>(randomBits(seed, i, 0) % groom.mesh->triangleCount());
        const float u = randomFloat(seed, i, 1);
        groom.guides.append({triangle, u, (1.0f - u) * randomFloat(seed, i, 2)}, 0, upright);
    }
    fromTriangles(groom);
    return groom;
}

// Number of triangles at every edge.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesOf(std::span<const glm::uvec3> triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const glm::uvec3& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            ++edges[{std::min(a, b), std::max(a, b)}];
        }
    }
    return edges;
}

std::vector<float> weightsAt(const GuideIndex& index, std::size_t guides, const glm::vec3& place,
                             const glm::vec3& normal) {
    Neighbours found;
    std::vector<float> weights(guides, 0.0f);
    const std::size_t count = index.inTriangle(0, place, normal, found);
    for (std::size_t j = 0; j < count; ++j) weights[found[j].guide] = found[j].weight;
    return weights;
}

float largestJump(const std::vector<float>& a, const std::vector<float>& b) {
    float jump = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) jump = std::max(jump, std::abs(a[i] - b[i]));
    return jump;
}

}  // namespace

class GuideTrianglesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void coverABallOnce() {
        const Groom groom = scattered(testing::sphere(24, 48), 400, 3);
        const GuideIndex index(groom);
        const auto triangles = index.trianglesOf(0)->triangles();
        // Euler: a closed surface of one piece without handles.
        QCOMPARE(triangles.size(), std::size_t{2 * 400 - 4});
        for (const auto& [edge, count] : edgesOf(triangles)) QCOMPARE(count, 2);
    }

    // Guides on the corners of a grid, four on a circle everywhere: every cell is cut into two.
    void guidesOnVertices() {
        Groom groom = makeGroom(testing::plane(10));
        groom.groups.edit()[0].params.general.segments = 1;
        std::set<std::uint32_t> done;
        for (std::uint32_t t = 0; t < groom.mesh->triangleCount(); ++t) {
            for (int corner = 0; corner < 3; ++corner) {
                if (!done.insert(groom.mesh->triangles[t][corner]).second) continue;
                groom.guides.append({t, corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f}, 0, upright);
            }
        }
        fromTriangles(groom);
        const GuideIndex index(groom);
        const auto triangles = index.trianglesOf(0)->triangles();
        const auto roots = index.rootsOf(0);
        double area = 0.0;
        for (const glm::uvec3& t : triangles) {
            const glm::vec3 a = roots[t.x].position;
            area +=
                0.5 * static_cast<double>(glm::length(glm::cross(roots[t.y].position - a, roots[t.z].position - a)));
        }
        QCOMPARE(triangles.size(), std::size_t{200});
        QVERIFY(std::abs(area - 1.0) < 1e-5);
    }

    void weightsAreBarycentric() {
        const Groom groom = scattered(testing::plane(12), 200, 5);
        const GuideIndex index(groom);
        const glm::vec3 up(0, 1, 0);
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const glm::vec3 place(0.7f * randomFloat(1, i, 0) - 0.35f, 0.0f, 0.7f * randomFloat(1, i, 1) - 0.35f);
            Neighbours found;
            const std::size_t count = index.inTriangle(0, place, up, found);
            glm::vec3 sum(0.0f);
            float weights = 0.0f;
            for (std::size_t j = 0; j < count; ++j) sum += found[j].weight * found[j].root->position;
            for (std::size_t j = 0; j < count; ++j) weights += found[j].weight;
            QVERIFY(glm::distance(sum, place) < 1e-5f && std::abs(weights - 1.0f) < 1e-5f);
            // No guide lies in the circle around the triangle (Delaunay): none is nearer to its middle.
            if (count < 3) continue;
            const glm::vec3 a = found[0].root->position, b = found[1].root->position - a,
                            c = found[2].root->position - a;
            const glm::vec3 n = glm::cross(b, c);
            const glm::vec3 toMiddle =
                (glm::cross(n, b) * glm::dot(c, c) + glm::cross(c, n) * glm::dot(b, b)) / (2.0f * glm::dot(n, n));
            for (const GuideRoot& root : index.rootsOf(0))
                QVERIFY(glm::distance(root.position, a + toMiddle) > glm::length(toMiddle) * 0.9985f - 1e-5f);
        }
        for (const GuideRoot& root : index.rootsOf(0))
            QVERIFY(weightsAt(index, groom.guides.count(), root.position, up)[root.guide] > 0.9999f);
    }

    void weightsAreContinuous() {
        const Groom groom = scattered(testing::sphere(48, 96), 300, 4);
        const GuideIndex index(groom);
        std::vector<float> before;
        for (int step = 0; step < 20000; ++step) {
            const float angle = static_cast<float>(step) * 3e-4f;
            const glm::vec3 normal =
                glm::normalize(glm::vec3(std::cos(angle), 0.3f * std::sin(3 * angle), std::sin(angle)));
            std::vector<float> now = weightsAt(index, groom.guides.count(), normal * 0.1f, normal);
            if (step > 0) QVERIFY(largestJump(now, before) < 0.05f);
            before = std::move(now);
        }
    }

    // Beyond the outermost guides hair follows the two, or the one, of the border that are nearest.
    void goOnBeyondTheOutermost() {
        Groom groom = scattered(testing::plane(12), 150, 8);
        std::vector<std::size_t> outer;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const glm::vec3 p = positionAt(*groom.mesh, groom.guides.root(i));
            if (std::max(std::abs(p.x), std::abs(p.z)) > 0.25f) outer.push_back(i);
        }
        groom.guides.erase(outer);
        const GuideIndex index(groom);
        for (int step = 0; step < 2000; ++step) {
            const float angle = static_cast<float>(step) * 3.15e-3f;
            const glm::vec3 place(0.45f * std::cos(angle), 0, 0.45f * std::sin(angle));
            Neighbours found;
            const std::size_t count = index.inTriangle(0, place, {0, 1, 0}, found);
            QVERIFY(count == 1 || count == 2);
            float weights = 0.0f;
            glm::vec3 on(0.0f);
            for (std::size_t j = 0; j < count; ++j) weights += found[j].weight;
            for (std::size_t j = 0; j < count; ++j) on += found[j].weight * found[j].root->position;
            QVERIFY(std::abs(weights - 1.0f) < 1e-5f);
            for (const GuideRoot& root : index.rootsOf(0))
                QVERIFY(glm::distance(root.position, place) > glm::distance(on, place) - 1e-5f);
        }
    }

    void sidesOfASheetAreApart() {
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
        Groom groom = scattered(sheet, 300, 2);
        const GuideIndex index(groom);
        const auto roots = index.rootsOf(0);
        const auto made = index.trianglesOf(0)->triangles();
        QVERIFY(made.size() > 400);
        for (const glm::uvec3& t : made)
            QVERIFY(roots[t.x].normal.y == roots[t.y].normal.y && roots[t.y].normal.y == roots[t.z].normal.y);
    }

    void nothingCrossesPartings() {
        Groom groom = scattered(testing::plane(20), 500, 6);
        const Surface surface(groom.mesh);
        const std::vector<glm::vec3> line{{0, 0, -0.4f}, {0, 0, 0.0f}};
        QVERIFY(addParting(groom, surface, line).ok());
        const GuideIndex index(groom);
        const glm::vec3 up(0, 1, 0);
        for (std::uint64_t i = 0; i < 3000; ++i) {
            const glm::vec3 place(0.1f * randomFloat(3, i, 0) - 0.05f, 0, -0.1f - 0.25f * randomFloat(3, i, 1));
            Neighbours found;
            const std::size_t count = index.guidesOf(0, (*groom.groups)[0].params.general, place, up, found);
            QVERIFY(count > 0);
            for (std::size_t j = 0; j < count; ++j) QVERIFY(found[j].root->position.x * place.x > 0.0f);
        }
        for (const float radius : {0.1f, 0.02f}) {
            std::vector<float> before;
            for (int step = 1; step < 8000; ++step) {
                const float turn = static_cast<float>(step) / 8000.0f * 6.2831853f - 1.5707963f;
                std::vector<float> now = weightsAt(index, groom.guides.count(),
                                                   {radius * std::cos(turn), 0.0f, radius * std::sin(turn)}, up);
                if (step > 1) QVERIFY(largestJump(now, before) < 0.06f);
                before = std::move(now);
            }
        }
    }

    void groupsHaveTheirOwn() {
        Groom groom = scattered(testing::sphere(24, 48), 300, 9);
        groom.groups.edit().push_back({"other", (*groom.groups)[0].params});
        for (std::size_t i = 0; i < groom.guides.count(); i += 3) groom.guides.setGroup(i, 1);
        const GuideIndex index(groom);
        for (std::size_t g = 0; g < 2; ++g) {
            QCOMPARE(index.trianglesOf(g)->triangles().size(), 2 * index.rootsOf(g).size() - 4);
            for (std::uint64_t i = 0; i < 200; ++i) {
                const glm::vec3 n = glm::normalize(
                    glm::vec3(randomFloat(5, i, 0), randomFloat(5, i, 1), randomFloat(5, i, 2)) * 2.0f - 1.0f);
                Neighbours found;
                const std::size_t count = index.inTriangle(g, n * 0.1f, n, found);
                QVERIFY(count > 0);
                for (std::size_t j = 0; j < count; ++j) QCOMPARE(std::size_t{groom.guides.group(found[j].guide)}, g);
            }
        }
    }

    void fewAndCoincidentGuidesFallBackToTheNearest() {
        for (const int guides : {0, 1, 2}) {
            const Groom groom = scattered(testing::sphere(12, 24), guides, 1);
            const GuideIndex index(groom);
            Neighbours found;
            const GeneralParams& general = (*groom.groups)[0].params.general;
            QCOMPARE(index.guidesOf(0, general, {0, 0.1f, 0}, {0, 1, 0}, found), static_cast<std::size_t>(guides));
        }
        Groom groom = scattered(testing::sphere(12, 24), 0, 1);
        for (int i = 0; i < 50; ++i) groom.guides.append({5, 0.3f, 0.3f}, 0, upright);
        Neighbours found;
        const GuideIndex index(groom);
        QVERIFY(index.guidesOf(0, (*groom.groups)[0].params.general, {0, 0.1f, 0}, {0, 1, 0}, found) > 0);
    }

    // Kept and fresh, fast and plain: the same hair, also after the choice changes.
    void generatesAsTheReference() {
        Groom groom = scattered(testing::sphere(24, 48), 150, 7);
        groom.groups.edit()[0].params.general.keepOutside = false;
        groom.counts.edit().hairs = 2000;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const glm::vec3 root = positionAt(*groom.mesh, groom.guides.root(i));
            groom.guides.editPoints(i)[0] = root;
            groom.guides.editPoints(i)[1] = root * 1.5f + glm::vec3(0, 0.02f, 0);
        }
        Progress progress;
        const auto surface = std::make_shared<const Surface>(groom.mesh);
        Generator kept;
        Groom nearest = groom;
        nearest.groups.edit()[0].params.general.guidesFrom.index = 0;
        const auto other = kept.generate(nearest, {}, progress);
        const auto fast = kept.generate(groom, {}, progress);
        const auto slow = generateReference(groom, surface, {}, progress);
        QVERIFY(other.ok() && fast.ok() && slow.ok());
        QCOMPARE(fast->ids, slow->ids);
        QVERIFY(fast->positions != other->positions);
        for (std::size_t v = 0; v < fast->vertexCount(); ++v)
            QVERIFY(glm::distance(fast->positions[v], slow->positions[v]) < 1e-6f);
    }
};

QTEST_APPLESS_MAIN(GuideTrianglesTest)
#include "guide_triangles_test.moc"
