// SPDX-License-Identifier: Apache-2.0
#include "core/hair/strands.h"

#include "core/base/random.h"
#include "core/hair/curve.h"
#include "core/hair/reference.h"
#include "tests/support/hair.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <cmath>

using namespace whorl;

namespace {

Strands randomStrands(std::uint32_t seed, std::uint32_t hairs) {
    Strands strands;
    std::uint64_t n = 0;
    const auto unit = [&] { return randomFloat(seed, n++, 5); };
    for (std::uint32_t i = 0; i < hairs; ++i) {
        const int vertices = 2 + static_cast<int>(unit() * 9.0f);
        glm::vec3 p(unit(), unit(), unit());
        for (int v = 0; v < vertices; ++v) {
            strands.positions.push_back(p);
            strands.normals.emplace_back(0, 1, 0);
            strands.widths.push_back(0.05f * unit());
            strands.colours.emplace_back(unit(), unit(), unit(), 1);
            p += glm::vec3(unit() - 0.5f, unit() - 0.5f, unit() - 0.5f);
        }
        strands.firstVertex.push_back(static_cast<std::uint32_t>(strands.positions.size()));
        strands.ids.push_back(i * 2);
        strands.roots.push_back({i, 0.25f, 0.25f});
        strands.rootUvs.emplace_back(unit(), unit());
        strands.groups.push_back(0);
    }
    return strands;
}

Strands slice(const Strands& all, std::size_t begin, std::size_t end) {
    Strands part;
    for (std::size_t i = begin; i < end; ++i) {
        for (std::uint32_t v = all.firstVertex[i]; v < all.firstVertex[i + 1]; ++v) {
            part.positions.push_back(all.positions[v]);
            part.normals.push_back(all.normals[v]);
            part.widths.push_back(all.widths[v]);
            part.colours.push_back(all.colours[v]);
        }
        part.firstVertex.push_back(static_cast<std::uint32_t>(part.positions.size()));
        part.ids.push_back(all.ids[i]);
        part.roots.push_back(all.roots[i]);
        part.rootUvs.push_back(all.rootUvs[i]);
        part.groups.push_back(all.groups[i]);
    }
    return part;
}

}  // namespace

class StrandsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theBoxHoldsTheCurveAndTouchesIt() {
        for (std::uint32_t seed = 0; seed < 60; ++seed) {
            const Strands strands = randomStrands(seed, 1 + seed % 3);
            const Bounds box = strands.bounds();
            Bounds sampled;
            for (std::size_t i = 0; i < strands.count(); ++i) {
                const std::size_t first = strands.firstVertex[i], count = strands.firstVertex[i + 1] - first;
                const std::span<const glm::vec3> points{&strands.positions[first], count};
                for (std::size_t step = 0; step <= (count - 1) * 200; ++step) {
                    const float at = static_cast<float>(step) / 200.0f;
                    const std::size_t piece = std::min(step / 200, count - 2);
                    const float t = at - static_cast<float>(piece);
                    const glm::vec3 p = strandPoint(points, at);
                    // Renderers take the width along the line or along the same spline.
                    const float* width = &strands.widths[first];
                    const float straight = 0.5f * glm::mix(width[piece], width[piece + 1], t);
                    const glm::vec3 before(width[piece > 0 ? piece - 1 : 0]), from(width[piece]), to(width[piece + 1]);
                    const glm::vec3 after(width[std::min(piece + 2, count - 1)]);
                    const float curved = 0.5f * catmullRom(before, from, to, after, t).x;
                    for (const float radius : {straight, curved}) {
                        sampled.add(p - glm::vec3(radius));
                        sampled.add(p + glm::vec3(radius));
                    }
                }
            }
            const glm::vec3 slack = box.size() * 0.01f;
            for (int axis = 0; axis < 3; ++axis) {
                QVERIFY(sampled.min[axis] >= box.min[axis]);
                QVERIFY(sampled.max[axis] <= box.max[axis]);
                QVERIFY(sampled.min[axis] <= box.min[axis] + slack[axis]);
                QVERIFY(sampled.max[axis] >= box.max[axis] - slack[axis]);
            }
        }
        QVERIFY(Strands().bounds().empty());
    }

    void theBoxOfManyIsThatOfEach() {
        // Pieces that lie inside already are left out, which changes nothing.
        for (std::uint32_t seed = 0; seed < 10; ++seed) {
            const Strands strands = randomStrands(100 + seed, 300);
            Bounds each;
            for (std::size_t i = 0; i < strands.count(); ++i) {
                const std::size_t first = strands.firstVertex[i], count = strands.firstVertex[i + 1] - first;
                each.add(strandBounds({&strands.positions[first], count}, {&strands.widths[first], count}));
            }
            QVERIFY(each.min == strands.bounds().min && each.max == strands.bounds().max);
        }
    }

    void theCurvePassesThroughItsVertices() {
        const Strands strands = randomStrands(8, 1);
        for (std::size_t v = 0; v < strands.vertexCount(); ++v)
            QVERIFY(glm::distance(strandPoint(strands.positions, static_cast<float>(v)), strands.positions[v]) < 1e-6f);
    }

    void theDigestDoesNotDependOnTheCut() {
        const Strands all = randomStrands(3, 20);
        for (const std::size_t cut : {0u, 1u, 7u, 20u}) {
            Hasher hasher;
            slice(all, 0, cut).addTo(hasher);
            slice(all, cut, 20).addTo(hasher);
            QCOMPARE(hasher.digest(), testing::digestOf(all));
            Strands joined = slice(all, 0, cut);
            joined.append(slice(all, cut, 20));
            QCOMPARE(testing::digestOf(joined), testing::digestOf(all));
            QCOMPARE(joined.firstVertex, all.firstVertex);
        }
        Strands changed = all;
        changed.normals.back().x = 0.5f;
        QVERIFY(testing::digestOf(changed) != testing::digestOf(all));
        Strands twice = all;
        twice.append(twice);
        QCOMPARE(twice.count(), std::size_t{40});
        QVERIFY(twice.bytes() > all.bytes());
        twice.clear();
        QCOMPARE(twice.count(), std::size_t{0});
        QCOMPARE(twice.firstVertex.size(), std::size_t{1});
    }

    // A circle is traversed without turning: after a flat curve the normal has the angle to its plane that it had.
    void normalsDoNotTwist() {
        std::vector<glm::vec3> arc;
        for (int i = 0; i <= 32; ++i) {
            const float angle = static_cast<float>(i) * 0.1f;
            arc.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
        }
        const std::vector<glm::vec3> normals = referenceNormals(arc, glm::normalize(glm::vec3(1, 0, 1)));
        for (const glm::vec3& normal : normals) QVERIFY(std::abs(normal.z - normals[0].z) < 1e-3f);
    }
};

QTEST_APPLESS_MAIN(StrandsTest)
#include "strands_test.moc"
