// SPDX-License-Identifier: Apache-2.0
// Laws of where hair texture covers the skin, and of its colour.
#include "core/surface/surface_point.h"
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;
using namespace whorl::testing;

class LicCoverTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theBorderFraysIntoHairs() {
        LicScene scene(testing::plane(40, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0.02f}}});
        Map density(256, 256, 1, TexelFormat::U8, 1.0f);
        for (int y = 0; y < 256; ++y)
            for (int x = 128; x < 256; ++x) density.setTexel(x, y, 0, 0.0f);
        scene.groom.maps.set("density", density);
        scene.groom.groups.edit()[0].params.general.density.map = "density";
        scene.lic().border = 0.03f;  // 38 texels
        scene.lic().grain.value = 0.0016f;
        scene.solve();
        const LicPainter painter = painterFor(scene, 256);
        const LicTexture texture = painted(painter, scene);
        std::vector<double> columns(256, 0.0);
        int hard = 0, band = 0;
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) {
                const int cover = (*texture.cover)[static_cast<std::size_t>(y * 256 + x)];
                columns[static_cast<std::size_t>(x)] += cover / 255.0 / 256.0;
                if (x < 92 || x >= 126) continue;
                ++band;
                hard += cover < 32 || cover > 223;
            }
        }
        // No hair outside, all of it inside, ever more between.
        for (std::size_t x = 129; x < 256; ++x) QCOMPARE(columns[x], 0.0);
        for (std::size_t x = 0; x < 88; ++x) QCOMPARE(columns[x], 1.0);
        for (std::size_t x = 92; x < 120; x += 4) QVERIFY(columns[x] > columns[x + 8]);
        QVERIFY2(columns[118] > 0.25 && columns[118] < 0.6, qPrintable(QString::number(columns[118])));
        // Hair or skin rather than a mixture.
        QVERIFY2(hard > band * 2 / 3, qPrintable(QString("%1 of %2").arg(hard).arg(band)));
        // Without a soft border it ends at once.
        scene.lic().border = 0.0f;
        const LicTexture sharp = painted(painter, scene, &texture);
        for (int x = 0; x < 127; ++x) QCOMPARE(int{(*sharp.cover)[static_cast<std::size_t>(100 * 256 + x)]}, 255);
        for (int x = 129; x < 256; ++x) QCOMPARE(int{(*sharp.cover)[static_cast<std::size_t>(100 * 256 + x)]}, 0);
    }

    void theBorderIsAsWideAsAsked_data() {
        QTest::addColumn<int>("size");
        QTest::addColumn<bool>("uneven");
        for (const int size : {256, 1024})
            for (const bool uneven : {false, true})
                QTest::addRow("%d texels%s", size, uneven ? ", a corner of them finer" : "") << size << uneven;
    }

    // Over far more texels than hairs are long, hair thins out without a step, at any size of texture.
    void theBorderIsAsWideAsAsked() {
        QFETCH(int, size);
        QFETCH(bool, uneven);
        constexpr float width = 0.08f;  // of 0.2 m
        SurfaceMesh mesh = testing::plane(40, 0.2f);
        if (uneven) {
            // A band along the border takes three times the texels of the rest, across.
            for (glm::vec2& uv : mesh.cornerUvs)
                uv.x = uv.x < 0.45f ? uv.x * 0.8f : uv.x < 0.5f ? 0.36f + (uv.x - 0.45f) * 2.4f : 0.48f + (uv.x - 0.5f);
        }
        LicScene scene(std::move(mesh), {{{-0.08f, 0, 0}, {0.08f, 0, 0.02f}}});
        Map density(256, 8, 1, TexelFormat::U8, 1.0f);
        const float middle = uneven ? 0.48f : 0.5f;
        for (int y = 0; y < 8; ++y)
            for (int x = static_cast<int>(middle * 256.0f); x < 256; ++x) density.setTexel(x, y, 0, 0.0f);
        scene.groom.maps.set("density", density);
        scene.groom.groups.edit()[0].params.general.density.map = "density";
        scene.lic().border = width;
        scene.lic().grain.value = 0.002f;
        scene.solve();
        const LicPainter painter = painterFor(scene, size);
        // Mean cover by how far from the border, in forty steps over 0.09 m, of three coats.
        std::vector<double> sums(40, 0.0);
        std::vector<int> counts(40, 0);
        for (const int seed : {1, 2, 3}) {
            scene.lic().seed = seed;
            const LicTexture texture = painted(painter, scene);
            for (const TexelAtlas::Slot& slot : painter.atlas().slots()) {
                const auto texel = texelOf(painter, slot);
                const float away = -positionAt(scene.surface->mesh(), slot.point()).x;
                const auto step = static_cast<std::size_t>(std::max(away, 0.0f) / 0.09f * 40.0f);
                if (!texel || away <= 0.0f || step >= 40) continue;
                sums[step] += (*texture.cover)[*texel] / 255.0;
                ++counts[step];
            }
        }
        double before = 0.0;
        for (std::size_t k = 1; k < 40; ++k) {
            const double cover = sums[k] / counts[k];
            const double way = std::min((static_cast<double>(k) + 0.5) / 40.0 * 0.09 / double{width}, 1.0);
            const double expected = 1.0 - (1.0 - way) * (1.0 - way);
            const QString said = QString("step %1: %2 for %3 after %4").arg(k).arg(cover).arg(expected).arg(before);
            QVERIFY2(k == 1 || std::abs(cover - before) < 0.15, qPrintable(said));
            QVERIFY2(uneven || std::abs(cover - expected) < 0.1, qPrintable(said));
            before = cover;
        }
        QVERIFY(before > 0.97);
    }

    void densityAndOpacityAreCoverage() {
        LicScene scene(testing::plane(10, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0.02f}}});
        scene.lic().grain.value = 0.0016f;
        scene.lic().opacity.value = 0.5f;
        scene.groom.maps.set("half", Map(8, 8, 1, TexelFormat::U8, 0.5f));
        scene.groom.groups.edit()[0].params.general.density.map = "half";
        scene.solve();
        const LicTexture texture = painted(painterFor(scene, 256), scene);
        double mean = 0;
        for (const std::uint8_t cover : *texture.cover) {
            QVERIFY(cover <= 128);
            mean += cover / 255.0 / 65536.0;
        }
        QVERIFY2(std::abs(mean - 0.25) < 0.02, qPrintable(QString::number(mean)));
    }

    void colourIsThatOfTheHair() {
        LicScene scene(testing::plane(6, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0}}});
        const LicPainter painter = painterFor(scene, 128);
        ColourParams& colour = scene.groom.groups.edit()[0].params.colour;
        colour.root.value = {0.1f, 0.2f, 0.3f};
        colour.tip.value = {0.5f, 0.4f, 0.3f};
        scene.lic().colourPlace = 0.25f;
        const LicTexture plain = painted(painter, scene);
        for (std::size_t i = 0; i < plain.colours->size(); ++i) {
            const float expected = srgbFromLinear(std::array{0.2f, 0.25f, 0.3f}[i % 3]) * 255.0f;
            QVERIFY(std::abs(static_cast<float>((*plain.colours)[i]) - expected) <= 1.0f);
        }
        // A fifth of the hairs are odd ones.
        colour.mutants.value = 0.2f;
        colour.mutant.value = {1, 1, 1};
        scene.lic().grain.value = 3.0f * painter.atlas().usualTexel();
        const LicTexture odd = painted(painter, scene);
        double share = 0;
        for (std::size_t i = 0; i < odd.colours->size(); i += 3)
            share += ((*odd.colours)[i] > 190 ? 1.0 : 0.0) / (128.0 * 128.0);
        QVERIFY2(share > 0.13 && share < 0.27, qPrintable(QString::number(share)));
    }
};

QTEST_GUILESS_MAIN(LicCoverTest)
#include "lic_cover_test.moc"
