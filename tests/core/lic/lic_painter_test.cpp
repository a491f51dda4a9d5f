// SPDX-License-Identifier: Apache-2.0
// Laws of hair texture over a whole mesh: it is that of the reference, whatever is made again and by whom.
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/io/open.h"
#include "core/lic/reference.h"
#include "core/surface/parting_line.h"
#include "tests/support/lic_scene.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;
using namespace whorl::testing;

namespace {

SurfaceMesh ball() {
    return testing::sphere(64, 96, 0.1f);
}

double agreement(const LicPainter& painter, const LicTexture& texture, const LicScene& scene, std::size_t most = 1500) {
    const LicParams& lic = *scene.groom.lic;
    const LicReference reference(scene.surface, scene.field);
    const LicOptions options{lic.length.value, lic.grain.value, lic.white,
                             lic.kernel.index == 1 ? LicKernel::Box : LicKernel::Hann, lic.seed};
    const auto slots = painter.atlas().slots();
    std::vector<double> ours, theirs;
    for (std::uint32_t i = 0; ours.size() < most && i < 20 * most; ++i) {
        const TexelAtlas::Slot& slot =
            slots[static_cast<std::size_t>(randomFloat(7, i, 0) * static_cast<float>(slots.size()))];
        const auto texel = texelOf(painter, slot);
        if (!texel || slot.u < 0.0f || slot.v < 0.0f || slot.u + slot.v > 1.0f) continue;
        // Evenly over the skin, however the UVs stretch.
        const TexelAtlas::Gradients g = painter.atlas().gradients(slot.triangle);
        const float usual = painter.atlas().usualTexel();
        if (randomFloat(8, i, 0) * glm::length(glm::cross(g.x, g.y)) * 2.0f * usual * usual > 1.0f) continue;
        const auto expected = reference.at(slot.point(), options);
        if (!expected) continue;
        ours.push_back((*texture.light)[*texel] / 255.0);
        theirs.push_back(static_cast<double>(*expected));
    }
    return ours.size() < most / 2 ? 0.0 : correlation(ours, theirs);
}

/// Empty when all layers are equal, otherwise which one is not.
QString difference(const LicTexture& a, const LicTexture& b) {
    if (a.size != b.size || a.mean != b.mean || a.deviation != b.deviation) return "numbers";
    if (*a.light != *b.light) return "light";
    if (*a.cover != *b.cover) return "cover";
    if (*a.colours != *b.colours) return "colours";
    if (*a.cornerUvs != *b.cornerUvs) return "UVs";
    if (*a.tangents != *b.tangents) return "tangents";
    return {};
}

Map dabbed(Map map, glm::ivec2 middle, int radius, float value) {
    for (int y = middle.y - radius; y <= middle.y + radius; ++y)
        for (int x = middle.x - radius; x <= middle.x + radius; ++x) map.setTexel(x, y, 0, value);
    return map;
}

}  // namespace

class LicPainterTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void agreesWithTheReference_data() {
        QTest::addColumn<QString>("shape");
        QTest::addColumn<int>("direction");
        for (const char* shape : {"plane", "ball", "overlapping", "bust", "head"})
            for (int direction = 0; direction < 2; ++direction)
                QTest::newRow(qPrintable(QString("%1 %2").arg(shape).arg(direction))) << QString(shape) << direction;
    }

    void agreesWithTheReference() {
        QFETCH(QString, shape);
        QFETCH(int, direction);
        Progress progress;
        std::optional<LicScene> scene;
        if (shape == "plane") {
            scene.emplace(testing::plane(9, 0.2f), direction == 0 ? Lines{{{-0.05f, 0, -0.02f}, {0.05f, 0, 0.03f}}}
                                                                  : Lines{{{-0.04f, 0, 0.05f}, {-0.03f, 0, -0.05f}},
                                                                          {{0.03f, 0, 0.02f}, {0.06f, 0, 0.0f}}});
        } else if (shape == "bust" || shape == "head") {
            const auto real = testing::realData("heads/makehuman_derived/head_neutral_sub1.glb");
            if (shape == "head" && !real) QSKIP("no real heads here");
            const auto opened = openGroom(shape == "head" ? *real : WHORL_SAMPLES "/bust.whorl", progress);
            QVERIFY(opened.ok());
            scene.emplace(*opened->groom.mesh, Lines{});
            if (direction == 1) scene->groom.field.edit().gravity.value = {1.0f, 0.3f, 0.2f};
            scene->solve();
        } else {
            SurfaceMesh mesh = ball();
            // Both halves in one place, as mirrored meshes have them.
            if (shape == "overlapping")
                for (glm::vec2& uv : mesh.cornerUvs) uv.x = std::abs(uv.x - 0.5f) * 2.0f;
            Lines lines = aroundTheBall;
            if (direction == 1) lines = {{{0.1f, 0, 0}, {0, 0, 0.1f}, {-0.1f, 0, 0}, {0, 0, -0.1f}}};
            scene.emplace(std::move(mesh), lines);
        }
        const int size = shape == "plane" ? 256 : 512;
        const LicPainter painter = painterFor(*scene, size);
        QCOMPARE(painter.atlas().ownUvs(), shape == "overlapping");
        // Texels of the ball are twice as wide as high.
        scene->lic().grain.value = (shape == "ball" ? 4.0f : 3.0f) * painter.atlas().usualTexel();
        scene->lic().length.value = 20.0f * painter.atlas().usualTexel();
        scene->lic().kernel.index = direction;
        const LicTexture texture = painted(painter, *scene);
        const double same = agreement(painter, texture, *scene);
        QVERIFY2(same >= 0.9, qPrintable(QString::number(same)));
    }

    void onlyWhatChangedIsMadeAgainAndEqualsAll() {
        LicScene scene(ball(), aroundTheBall);
        const LicPainter painter = painterFor(scene, 256), other = painterFor(scene, 256);
        Groom& groom = scene.groom;
        for (const char* name : {"density", "length", "grain", "opacity", "tint", "groups"})
            groom.maps.set(name, Map(256, 256, 1, TexelFormat::U8, std::string(name) == "groups" ? 0.0f : 1.0f));
        groom.groups.edit().push_back(groom.groups->front());
        groom.groups.edit()[1].name = "other";
        groom.groups.edit()[1].params.colour.tip.value = {0.9f, 0.8f, 0.7f};
        groom.counts.edit().groupMap.name = "groups";
        for (Group& group : groom.groups.edit()) {
            group.params.general.density.map = "density";
            group.params.colour.tip.map = "tint";
        }
        scene.lic().length = {0.012f, "length"};
        scene.lic().grain = {0.002f, "grain"};
        scene.lic().opacity.map = "opacity";
        scene.solve();
        LicTexture last = painted(painter, scene);
        int step = 0;
        const auto check = [&](const char* what) {
            const LicTexture next = painted(painter, scene, &last);
            const LicTexture whole = painted(other, scene);
            const QString apart = difference(next, whole);
            QVERIFY2(apart.isEmpty(), qPrintable(QString("%1: %2").arg(what, apart)));
            // All that differs lies in the rectangle.
            const bool same =
                *next.light == *last.light && *next.cover == *last.cover && *next.colours == *last.colours;
            if (next.changedTo != glm::ivec2(0)) {
                for (int y = 0; y < next.size; ++y) {
                    for (int x = 0; x < next.size; ++x) {
                        if (x >= next.changedFrom.x && y >= next.changedFrom.y && x < next.changedTo.x &&
                            y < next.changedTo.y)
                            continue;
                        const auto at = static_cast<std::size_t>(y * next.size + x);
                        QCOMPARE((*next.light)[at], (*last.light)[at]);
                        QCOMPARE((*next.cover)[at], (*last.cover)[at]);
                        for (std::size_t c = 0; c < 3; ++c)
                            QCOMPARE((*next.colours)[3 * at + c], (*last.colours)[3 * at + c]);
                    }
                }
            } else {
                QVERIFY2(!same || next.light == last.light, what);
            }
            last = next;
            ++step;
        };
        const auto dab = [&](const char* map, glm::ivec2 at, float value) {
            groom.maps.set(map, dabbed(*groom.maps.find(map), at, 9, value));
        };
        dab("length", {100, 120}, 0.2f);
        check("length");
        QVERIFY(last.changedTo.x - last.changedFrom.x < 96);
        dab("grain", {240, 120}, 0.4f);  // at the seam of the UVs
        check("grain");
        dab("opacity", {30, 60}, 0.5f);
        check("opacity");
        QVERIFY(last.changedTo.x - last.changedFrom.x < 96);
        dab("density", {60, 100}, 0.0f);
        check("density, the field as it was");
        QVERIFY(last.changedTo.x - last.changedFrom.x < 200);
        scene.solve();
        check("density, field with a hole");
        dab("density", {245, 130}, 0.0f);
        check("density at the seam");
        dab("density", {245, 130}, 1.0f);
        check("density back");
        dab("tint", {90, 90}, 0.3f);
        const LicTexture before = last;
        check("tint");
        QVERIFY(last.light == before.light && last.colours != before.colours);
        dab("tint", {90, 60}, 0.4f);
        dab("opacity", {200, 120}, 0.6f);
        check("tint and opacity apart");
        dab("groups", {120, 90}, 1.0f / 255.0f);
        check("groups");
        for (Group& group : groom.groups.edit()) group.params.colour.hueVariation.value = 0.4f;
        check("variation");
        dab("grain", {100, 100}, 0.6f);
        check("grain under varied colours");
        groom.strokes.edit()[0].points =
            *tracedParting(*scene.surface, std::vector<glm::vec3>{{0, 0, 0.1f}, {0.05f, 0.05f, 0.08f}});
        groom.field.edit().reach = 0.02f;
        scene.solve();
        check("stroke");
        groom.partings.edit().push_back(
            {1, "", *tracedParting(*scene.surface, std::vector<glm::vec3>{{0, 0.08f, 0.05f}, {0.02f, 0.02f, 0.1f}})});
        scene.solve();
        check("parting");
        scene.lic().border = 0.02f;
        check("border");
        scene.lic().white = 0.3f;
        check("white");
        scene.lic().seed = 3;
        check("seed");
        scene.lic().kernel.index = 1;
        check("kernel");
        scene.lic().length.value = 0.02f;
        check("length of all");
        // A map of floats in which a dab is brighter than all was.
        groom.maps.set("density", Map(256, 256, 1, TexelFormat::F32, 0.5f));
        groom.maps.set("length", Map(256, 256, 1, TexelFormat::F32, 0.5f));
        check("maps of floats");
        dab("density", {100, 100}, 3.0f);
        check("bright dab of density");
        dab("length", {100, 100}, 3.0f);
        check("bright dab of length");
        scene.lic().contrast = 0.1f;
        const LicTexture same = painted(painter, scene, &last);
        QVERIFY(same.light == last.light && same.cover == last.cover && same.colours == last.colours &&
                same.tangents == last.tangents);
    }

    void sameBytesEverywhere() {
        LicScene scene(ball(), aroundTheBall);
        scene.lic().grain.value = 0.001f;
        const LicPainter painter = painterFor(scene, 192);
        const LicTexture expected = painted(painter, scene);
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            if (level > bestSimdLevel()) continue;
            setSimdLevel(level);
            for (const unsigned threads : {1u, 2u, 5u}) {
                const ThreadLimit limit(threads);
                QCOMPARE(difference(painted(painter, scene), expected), QString());
            }
        }
        setSimdLevel(bestSimdLevel());
    }

    void emptyCancelledAndTiny() {
        LicScene scene(testing::plane(3, 0.2f), {});
        const LicPainter painter = painterFor(scene, 5);
        Progress progress;
        const auto nothing = painter.paint(scene.groom, DirectionField(), nullptr, progress);
        QVERIFY(nothing.ok());
        QVERIFY(std::ranges::all_of(*nothing->cover, [](std::uint8_t c) { return c == 0; }));
        const LicTexture some = painted(painter, scene, &*nothing);
        QVERIFY(std::ranges::all_of(*some.cover, [](std::uint8_t c) { return c == 255; }));
        Progress cancelled;
        cancelled.cancel();
        QVERIFY(!LicPainter::make(scene.surface, 64, cancelled).ok());
        scene.lic().seed = 9;
        QVERIFY(!painter.paint(scene.groom, scene.field, &some, cancelled).ok());
        const LicTexture again = painted(painter, scene, &some);
        QCOMPARE(difference(again, painted(painterFor(scene, 5), scene)), QString());
        QCOMPARE(painted(painterFor(scene, 1), scene).light->size(), std::size_t{1});
    }
};

QTEST_GUILESS_MAIN(LicPainterTest)
#include "lic_painter_test.moc"
