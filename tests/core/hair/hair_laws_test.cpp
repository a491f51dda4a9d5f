// SPDX-License-Identifier: Apache-2.0
// Laws of the generator over random grooms in which every stage is at work.
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/hair/generate.h"
#include "core/hair/reference.h"
#include "core/io/document.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <functional>

using namespace whorl;

namespace {

constexpr std::uint32_t hairs = 500;

float dice(std::uint32_t seed, std::uint32_t channel) {
    return randomFloat(seed, 5, channel);
}

// A random groom with a parting, and in its first group strands, kink, frizz that moves, a cut, a skip threshold and
// all modifiers; the second blends guides of triangles.
Groom everything(std::uint32_t seed) {
    Groom groom = testing::randomGroom(seed);
    std::vector<Group>& groups = groom.groups.edit();
    if (groups.size() < 2) {
        groups.push_back({"second", {}});
        groups[1].params.general.segments = groups[0].params.general.segments;
        for (std::size_t g = 0; g < groom.guides.count(); g += 2) groom.guides.setGroup(g, 1);
    }
    Map halves(32, 32, 1, TexelFormat::U8, 0.0f);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 16; ++x) halves.setTexel(x, y, 0, 1.0f / 255.0f);
    groom.maps.set("halves", halves);
    groom.counts.edit().groupMap.name = "halves";
    for (std::size_t g = 0; g < groups.size(); ++g) {
        HairParams& p = groups[g].params;
        p.general.density.value = 1.0f;
        p.general.density.map.clear();
        p.general.cut.value = 0.5f + 0.5f * dice(seed, 1);
        p.general.scale.value = 0.5f + dice(seed, 2);
        p.general.keepOutside = dice(seed, 3) < 0.5f;
        p.frizz.tip.value = 0.003f;
        p.frizz.animation.value = 0.5f;
        p.frizz.speed.value = 3.0f;
        p.kink.tip.value = 0.001f;
        if (g == 0) {
            p.strands.hairs = 2 + static_cast<int>(3.0f * dice(seed, 4));
            p.general.skipThreshold = 0.01f;
            p.modifiers.clear();
            for (std::size_t kind = 0; kind < modifierKindCount; ++kind) {
                Modifier modifier{freeModifierName(p.modifiers, modifierKinds()[kind].id)};
                modifier.params = defaultModifierParams(kind);
                modifier.amount.value = 0.3f + 0.7f * dice(seed, 10 + static_cast<std::uint32_t>(kind));
                p.modifiers.push_back(std::move(modifier));
            }
            std::swap(p.modifiers[seed % modifierKindCount], p.modifiers[(seed / 2) % modifierKindCount]);
        } else {
            p.general.guidesFrom.index = 1;
        }
    }
    if (groom.partings->empty()) {
        const std::uint32_t triangles = groom.mesh->triangleCount();
        groom.partings.edit().push_back({1, "line", {{0, 0.2f, 0.2f}, {triangles / 3, 0.3f, 0.3f}}});
    }
    return groom;
}

GenerateOptions moving(std::uint32_t part = 0, std::uint32_t parts = 1) {
    GenerateOptions options;
    options.hairCount = hairs;
    options.part = part;
    options.partCount = parts;
    options.time = 0.7f;
    return options;
}

using testing::digestOf;

// Digest of all hair made in parts, in blocks of so many.
std::uint64_t digestOf(const Groom& groom, std::uint32_t parts = 1, std::uint32_t block = 1000) {
    Generator generator;
    Progress progress;
    Hasher hasher;
    std::size_t count = 0;
    for (std::uint32_t part = 0; part < parts; ++part) {
        const Result<void> done = generator.stream(
            groom, moving(part, parts), block,
            [&](const Strands& some) {
                some.addTo(hasher);
                count += some.count();
                return true;
            },
            progress);
        if (!done) return 0;
    }
    return count > 100 ? hasher.digest() : 0;
}

Strands grown(const Groom& groom) {
    return testing::grown(groom, moving());
}

// Calm hair on a ball, to see one stage at a time.
Groom calmGroom(std::uint32_t seed) {
    Groom groom = testing::groomOn(testing::sphere(16, 32), 120, 9);
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        const auto number = static_cast<std::uint32_t>(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size());
            const float x = randomFloat(seed, number, 0) - 0.5f, z = randomFloat(seed, number, 1) - 0.5f;
            points[v] += along * along * glm::vec3(0.03f * x, -0.02f, 0.03f * z);
        }
    }
    HairParams& p = groom.groups.edit()[0].params;
    p.general.segments = 9;
    p.general.keepOutside = false;
    p.frizz.root.value = p.frizz.tip.value = p.kink.root.value = p.kink.tip.value = 0.0f;
    groom.counts.edit().seed = static_cast<int>(seed);
    return groom;
}

struct Stage {
    std::string name;
    std::function<void(Groom&, std::uint32_t)> set;
};

// Every stage of the chain with random numbers.
std::vector<Stage> stages() {
    const auto params = [](Groom& groom) -> HairParams& { return groom.groups.edit()[0].params; };
    std::vector<Stage> list{
        {"interpolation", [=](Groom& g, std::uint32_t s) { params(g).general.samples = 3 + static_cast<int>(s % 5); }},
        {"unturned", [=](Groom& g, std::uint32_t) { params(g).general.interpolation.index = 1; }},
        {"triangles", [=](Groom& g, std::uint32_t) { params(g).general.guidesFrom.index = 1; }},
        {"scale",
         [=](Groom& g, std::uint32_t s) {
             params(g).general.scale.value = 0.2f + 2.0f * dice(s, 20);
             params(g).general.randomScale.value = dice(s, 21);
         }},
        {"displacement",
         [=](Groom& g, std::uint32_t s) { params(g).general.displacement.value = 0.01f * dice(s, 22); }},
        {"cut", [=](Groom& g, std::uint32_t s) { params(g).general.cut.value = 0.15f + 0.8f * dice(s, 23); }},
        {"frizz",
         [=](Groom& g, std::uint32_t s) {
             params(g).frizz.root.value = 0.002f * dice(s, 24);
             params(g).frizz.tip.value = 0.01f * dice(s, 25);
             params(g).frizz.frequency.value = glm::vec3(30.0f + 2000.0f * dice(s, 26));
             params(g).frizz.animation.value = dice(s, 27);
             params(g).frizz.speed.value = 2.0f;
         }},
        {"kink",
         [=](Groom& g, std::uint32_t s) {
             params(g).kink.tip.value = 0.003f * dice(s, 28);
             params(g).kink.frequency.value = glm::vec3(50.0f, 120.0f, 20.0f + 100.0f * dice(s, 29));
         }},
        {"outside", [=](Groom& g, std::uint32_t) { params(g).general.keepOutside = true; }},
        {"skipped vertices", [=](Groom& g, std::uint32_t s) { params(g).general.skipThreshold = 0.02f * dice(s, 30); }},
        {"colours",
         [=](Groom& g, std::uint32_t s) {
             params(g).colour.hueVariation.value = dice(s, 31);
             params(g).colour.valueVariation.value = dice(s, 32);
             params(g).colour.mutants.value = 0.3f;
         }},
        {"strands",
         [=](Groom& g, std::uint32_t s) {
             params(g).strands.hairs = 1 + static_cast<int>(6.0f * dice(s, 33));
             params(g).strands.twist.value = 6.0f * dice(s, 34) - 3.0f;
             params(g).strands.offset.value = 0.002f * dice(s, 35);
             params(g).strands.randomise.value = dice(s, 36);
             params(g).strands.aspect.value = 0.5f + dice(s, 37);
             params(g).general.cut.value = 0.6f + 0.4f * dice(s, 38);
         }},
    };
    for (std::size_t kind = 0; kind < modifierKindCount; ++kind) {
        list.push_back({std::string(modifierKinds()[kind].id), [=](Groom& g, std::uint32_t s) {
                            Modifier modifier{"one"};
                            modifier.params = defaultModifierParams(kind);
                            modifier.amount.value = 0.2f + 0.8f * dice(s, 39);
                            params(g).modifiers = {modifier};
                        }});
    }
    return list;
}

}  // namespace

class HairLawsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyLevelThreadCountSplitAndBlockGivesTheSameBytes() {
        for (std::uint32_t seed = 1; seed <= 5; ++seed) {
            const Groom groom = everything(seed);
            const std::uint64_t expected = digestOf(groom);
            QVERIFY(expected != 0);
            for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
                setSimdLevel(level);
                QCOMPARE(digestOf(groom), expected);
            }
            setSimdLevel(bestSimdLevel());
            for (const unsigned threads : {1u, 2u, 5u}) {
                const ThreadLimit limit(threads);
                QCOMPARE(digestOf(groom), expected);
            }
            for (std::uint32_t i = 0; i < 3; ++i) {
                const auto parts = 1 + static_cast<std::uint32_t>(20.0f * dice(seed, 50 + i));
                const auto block = 1 + static_cast<std::uint32_t>(300.0f * dice(seed, 60 + i));
                QCOMPARE(digestOf(groom, parts, block), expected);
            }
            QCOMPARE(digestOf(grown(groom)), expected);
        }
    }

    void aDocumentKeepsTheHair() {
        for (std::uint32_t seed = 1; seed <= 6; ++seed) {
            const Groom groom = everything(seed);
            const Result<OpenedDocument> opened = documentFromBytes(documentBytes(groom), "memory");
            QVERIFY(opened);
            QVERIFY(opened->problems.empty());
            QCOMPARE(digestOf(opened->groom), digestOf(groom));
        }
    }

    void theHairMadeBeforeLeavesNoTrace() {
        // One generator for grooms that differ in everything gives what fresh ones give.
        Generator kept;
        Progress progress;
        for (std::uint32_t i = 0; i < 12; ++i) {
            const Groom groom = everything(1 + i * 5 % 7);
            const auto made = kept.generateShared(groom, moving(), progress);
            QVERIFY(made);
            QCOMPARE(digestOf(**made), digestOf(groom));
        }
    }

    void eachStageAloneEqualsTheReference() {
        for (const Stage& stage : stages()) {
            for (std::uint32_t seed = 1; seed <= 3; ++seed) {
                Groom groom = calmGroom(seed);
                const auto surface = std::make_shared<const Surface>(groom.mesh);
                const std::uint64_t without = digestOf(grown(groom));
                stage.set(groom, seed);
                Progress progress;
                const Strands fast = grown(groom);
                const Result<Strands> slow = generateReference(groom, surface, moving(), progress);
                QVERIFY(slow);
                QVERIFY(fast.count() > 300);
                QVERIFY2(digestOf(fast) != without || stage.name == "interpolation" || stage.name == "outside",
                         stage.name.c_str());
                QCOMPARE(fast.ids, slow->ids);
                QCOMPARE(fast.members, slow->members);
                QCOMPARE(fast.firstVertex, slow->firstVertex);
                for (std::size_t v = 0; v < fast.vertexCount(); ++v) {
                    // 1e-5 of 0.1 m.
                    QVERIFY2(glm::distance(fast.positions[v], slow->positions[v]) < 1e-6f, stage.name.c_str());
                    QVERIFY2(glm::distance(fast.normals[v], slow->normals[v]) < 1e-2f, stage.name.c_str());
                    QVERIFY(std::abs(fast.widths[v] - slow->widths[v]) < 1e-7f);
                    QVERIFY(glm::distance(fast.colours[v], slow->colours[v]) < 1e-5f);
                }
            }
        }
    }

    void hairOfAGroupHearsNothingOfOthers() {
        // All stages on, locks too: guides of the second group move, hair of the first keeps its bytes; then the other
        // way round.
        for (std::uint32_t seed = 1; seed <= 6; ++seed) {
            const Groom groom = everything(seed);
            const Strands before = grown(groom);
            for (const std::uint8_t moved : {std::uint8_t{0}, std::uint8_t{1}}) {
                Groom other = groom;
                for (std::size_t g = 0; g < other.guides.count(); ++g) {
                    if (other.guides.group(g) != moved) continue;
                    for (glm::vec3& p : other.guides.editPoints(g).subspan(1)) p += glm::vec3(0.01f, 0.004f, -0.006f);
                }
                const Strands after = grown(other);
                std::size_t same = 0, different = 0, j = 0;
                // Vertices may be skipped elsewhere now, but no hair comes or goes.
                QCOMPARE(after.ids, before.ids);
                for (std::size_t i = 0; i < before.count(); ++i, ++j) {
                    const std::size_t first = before.firstVertex[i], count = before.firstVertex[i + 1] - first;
                    const std::size_t other_first = after.firstVertex[j];
                    const bool equal = after.firstVertex[j + 1] - other_first == count &&
                                       std::equal(before.positions.begin() + static_cast<std::ptrdiff_t>(first),
                                                  before.positions.begin() + static_cast<std::ptrdiff_t>(first + count),
                                                  after.positions.begin() + static_cast<std::ptrdiff_t>(other_first));
                    if (before.groups[i] != moved) QVERIFY(equal);
                    ++(equal ? same : different);
                }
                QVERIFY(different > 20);
                QVERIFY(same > 20);
            }
        }
    }
};

QTEST_APPLESS_MAIN(HairLawsTest)
#include "hair_laws_test.moc"
