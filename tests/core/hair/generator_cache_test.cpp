// SPDX-License-Identifier: Apache-2.0
#include "core/base/random.h"
#include "core/hair/generate.h"
#include "tests/support/shapes.h"

#include <QtTest>

using namespace whorl;

namespace {

std::uint64_t digestOf(const Strands& strands) {
    Hasher hasher;
    strands.addTo(hasher);
    return hasher.digest();
}

// One random edit of the kinds that the editor makes.
void edit(Groom& groom, std::uint32_t seed, std::uint64_t step) {
    const auto random = [&](std::uint32_t channel, std::size_t below) {
        return static_cast<std::size_t>(randomBits(seed, step, channel) % std::max<std::size_t>(below, 1));
    };
    const auto unit = [&](std::uint32_t channel) { return randomFloat(seed, step, channel); };
    const std::size_t guides = groom.guides.count();
    HairParams& params = groom.groups.edit()[random(20, groom.groups->size())].params;
    switch (random(0, 15)) {
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
                const Result<Strands> got = used.generate(groom, options, progress);
                QVERIFY(expected && got);
                QVERIFY2(digestOf(*got) == digestOf(*expected),
                         qPrintable(QString("seed %1 step %2").arg(seed).arg(step)));
            }
        }
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
