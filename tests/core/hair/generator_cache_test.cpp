// SPDX-License-Identifier: Apache-2.0
#include "core/base/random.h"
#include "core/hair/changes.h"
#include "core/hair/generate.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <QtTest>

using namespace whorl;

namespace {

// One random edit of the kinds that the editor makes.
void edit(Groom& groom, std::uint32_t seed, std::uint64_t step) {
    const auto random = [&](std::uint32_t channel, std::size_t below) {
        return static_cast<std::size_t>(randomBits(seed, step, channel) % std::max<std::size_t>(below, 1));
    };
    const auto unit = [&](std::uint32_t channel) { return randomFloat(seed, step, channel); };
    const std::size_t guides = groom.guides.count();
    HairParams& params = groom.groups.edit()[random(20, groom.groups->size())].params;
    switch (random(0, 22)) {
        case 0:
        case 1:
        case 2:
        case 3:  // comb
            for (std::size_t g = random(1, guides); g < guides; g += 1 + random(2, 40)) {
                for (glm::vec3& p : groom.guides.editPoints(g).subspan(1)) p.x += 0.01f * unit(3);
            }
            break;
        case 4:
            if (guides > 3) {
                const std::vector<std::size_t> doomed{random(4, guides)};
                groom.guides.erase(doomed);
            }
            break;
        case 5: {
            const std::vector<glm::vec3> points(groom.guides.points(0).begin(), groom.guides.points(0).end());
            groom.guides.append({static_cast<std::uint32_t>(random(5, groom.mesh->triangleCount())), 0.2f, 0.2f},
                                groom.guides.group(0), points);
            break;
        }
        case 6:
            groom.guides.setGroup(random(6, guides), static_cast<std::uint8_t>(random(7, groom.groups->size())));
            break;
        case 7:
            params.general.density.value = 0.1f + unit(8);
            break;
        case 8:
            params.general.samples = 1 + static_cast<int>(random(9, 8));
            break;
        case 9:
            params.general.interpolation.index = 1 - params.general.interpolation.index;
            break;
        case 10:
            params.general.keepOutside = !params.general.keepOutside;
            break;
        case 11:
            params.frizz.tip.value = 0.02f * unit(10);
            break;
        case 12:
            groom.counts.edit().seed = static_cast<int>(random(11, 3));
            break;
        case 13:
            if (!groom.maps.entries().empty()) {
                const std::string name = groom.maps.entries()[random(12, groom.maps.entries().size())].name;
                for (int x = 0; x < 3; ++x) groom.maps.edit(name)->setTexel(x, 1, 0, unit(13));
            }
            break;
        case 14:
            params.colour.tip.value = {unit(15), unit(16), unit(17)};
            break;
        case 15:
            params.general.rootThickness.value = 0.001f * unit(18);
            break;
        case 16:
            params.general.skipThreshold = random(21, 2) ? 0.1f * unit(19) : 0.0f;
            break;
        case 17:
            params.strands.hairs = static_cast<int>(random(22, 4));
            break;
        case 18:
            if (params.modifiers.size() < 5) {
                const std::size_t kind = random(23, modifierKindCount);
                Modifier modifier{freeModifierName(params.modifiers, modifierKinds()[kind].id)};
                modifier.params = defaultModifierParams(kind);
                params.modifiers.push_back(std::move(modifier));
            }
            break;
        case 19:
            if (!params.modifiers.empty()) params.modifiers.erase(params.modifiers.begin());
            break;
        case 20:
            for (Modifier& modifier : params.modifiers) modifier.amount.value = unit(24);
            break;
        default:
            params.general.cut.value = unit(14);
            break;
    }
}

}  // namespace

class GeneratorCacheTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aUsedGeneratorGivesWhatAFreshOneGives() {
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            Groom groom = testing::randomGroom(seed);
            Generator used;
            SurfaceCache surfaces;
            std::vector<std::pair<std::shared_ptr<const Strands>, std::uint64_t>> held;
            for (std::uint64_t step = 0; step < 60; ++step) {
                edit(groom, seed, step);
                if (step % 30 == 29) groom = testing::randomGroom(seed + static_cast<std::uint32_t>(step));
                GenerateOptions options;
                options.hairCount = step % 10 == 0 ? 300u : 250u;
                Progress progress;
                if (step % 13 == 5) {
                    QVERIFY(used.stream(
                        groom, options, 64, [](const Strands&) { return true; }, progress));
                }
                Generator fresh;
                // The used one keeps its own surface.
                fresh.setSurface(surfaces.get(groom.mesh));
                const Result<Strands> expected = fresh.generate(groom, options, progress);
                const Result<std::shared_ptr<const Strands>> got = used.generateShared(groom, options, progress);
                QVERIFY(expected && got);
                QVERIFY2(
                    testing::digestOf(**got) == testing::digestOf(*expected),
                    qPrintable(
                        QString("seed %1 step %2 edit %3").arg(seed).arg(step).arg(randomBits(seed, step, 0) % 22)));
                // Held for none, one or a few steps; what is held never changes.
                if (step % 7 != 3) held.emplace_back(*got, testing::digestOf(*expected));
                for (const auto& [strands, digest] : held) QCOMPARE(testing::digestOf(*strands), digest);
                if (step % 3 == 0) held.clear();
            }
        }
    }

    void whatNobodyHoldsIsNotCopied() {
        Groom groom = testing::groomOn(testing::sphere(12, 20), 100);
        Generator generator;
        Progress progress;
        const auto next = [&] {
            for (glm::vec3& p : groom.guides.editPoints(10).subspan(1)) p.x += 0.001f;
            return *generator.generateShared(groom, {500u}, progress);
        };
        const glm::vec3* const first = next()->positions.data();
        QCOMPARE(next()->positions.data(), first);
        // As a viewport does: it holds the newest. Two of them take turns.
        std::shared_ptr<const Strands> shown = next();
        QCOMPARE(shown->positions.data(), first);
        shown = next();
        const glm::vec3* const second = shown->positions.data();
        QVERIFY(second != first);
        shown = next();
        QCOMPARE(shown->positions.data(), first);
        shown = next();
        QCOMPARE(shown->positions.data(), second);
        // Nothing changed: the same again.
        QVERIFY(*generator.generateShared(groom, {500u}, progress) == shown);
    }

    void coloursAndWidthsChangeNoShape() {
        Groom groom = testing::groomOn(testing::sphere(12, 20), 100);
        groom.maps.set("tint", Map(8, 8, 3, TexelFormat::U8, 0.5f));
        groom.maps.set("unused", Map(8, 8, 1, TexelFormat::U8, 0.5f));
        HairParams& params = groom.groups.edit()[0].params;
        params.colour.tip.map = "tint";
        params.frizz.tip.value = 0.01f;
        const auto changed = [&](auto&& change) {
            Groom other = groom;
            change(other, other.groups.edit()[0].params);
            return std::pair(!sameShapeParameters(groom, other), !sameLookParameters(groom, other));
        };
        using Both = std::pair<bool, bool>;
        const Both nothing{false, false}, look{false, true}, shape{true, false};
        QCOMPARE(changed([](Groom&, HairParams&) {}), nothing);
        QCOMPARE(changed([](Groom&, HairParams& p) { p.colour.root.value.x = 0.5f; }), look);
        QCOMPARE(changed([](Groom&, HairParams& p) { p.colour.mutants.value = 0.5f; }), look);
        QCOMPARE(changed([](Groom&, HairParams& p) { p.general.tipThickness.value = 0.5f; }), look);
        QCOMPARE(changed([](Groom& g, HairParams&) { g.maps.edit("tint")->setTexel(1, 1, 0, 1.0f); }), look);
        QCOMPARE(changed([](Groom& g, HairParams&) { g.maps.edit("unused")->setTexel(1, 1, 0, 1.0f); }), nothing);
        QCOMPARE(changed([](Groom&, HairParams& p) { p.general.cut.map = "unused"; }), shape);
        QCOMPARE(changed([](Groom&, HairParams& p) { p.frizz.tip.value = 0.02f; }), shape);
        QCOMPARE(changed([](Groom&, HairParams& p) { p.general.keepOutside = false; }), shape);

        Generator generator;
        Progress progress;
        const Strands before = *generator.generate(groom, {500u}, progress);
        groom.groups.edit()[0].params.colour.root.value.x += 0.25f;
        const Strands after = *generator.generate(groom, {500u}, progress);
        QVERIFY(before.positions == after.positions && before.normals == after.normals);
        QVERIFY(before.colours != after.colours);
    }

    void aCombMovesOnlyHairsOfItsGuidesAndLocks() {
        Groom groom = testing::groomOn(testing::sphere(20, 40), 640);
        Modifier clump{"locks"};
        std::get<ClumpParams>(clump.params).count = 400;
        groom.groups.edit()[0].params.modifiers.push_back(clump);
        groom.groups.edit()[0].params.general.keepOutside = false;
        Generator generator;
        Progress progress;
        const Strands before = *generator.generate(groom, {4000u}, progress);
        for (glm::vec3& p : groom.guides.editPoints(100).subspan(1)) p.x += 0.01f;
        const Strands after = *generator.generate(groom, {4000u}, progress);
        std::size_t moved = 0;
        for (std::size_t i = 0; i < before.count(); ++i) {
            const std::uint32_t tip = before.firstVertex[i + 1] - 1;
            moved += before.positions[tip] != after.positions[tip];
        }
        QVERIFY2(moved > 0 && moved < before.count() / 10, qPrintable(QString::number(moved)));
        Generator fresh;
        QCOMPARE(testing::digestOf(after), testing::digestOf(*fresh.generate(groom, {4000u}, progress)));
    }

    void aCombMovesOnlyHairsOfItsGuides() {
        Groom groom = testing::groomOn(testing::sphere(20, 40), 640);
        Generator generator;
        Progress progress;
        const Strands before = *generator.generate(groom, {4000u}, progress);
        for (glm::vec3& p : groom.guides.editPoints(100).subspan(1)) p.x += 0.01f;
        const Strands after = *generator.generate(groom, {4000u}, progress);
        std::size_t moved = 0;
        for (std::size_t i = 0; i < before.count(); ++i) {
            const std::uint32_t tip = before.firstVertex[i + 1] - 1;
            moved += before.positions[tip] != after.positions[tip];
        }
        QVERIFY(moved > 0 && moved < before.count() / 20);
    }
};

QTEST_APPLESS_MAIN(GeneratorCacheTest)
#include "generator_cache_test.moc"
