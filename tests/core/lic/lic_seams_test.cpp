// SPDX-License-Identifier: Apache-2.0
// Laws of hair texture at seams of the UVs, partings and borders: the first are not seen, nothing crosses the others.
#include "core/surface/adjacency.h"
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

}  // namespace

class LicSeamsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void seamsAreNotSeen_data() {
        QTest::addColumn<bool>("own");
        QTest::newRow("UVs cut from pole to pole") << false;
        QTest::newRow("own atlas of many charts") << true;
    }

    void seamsAreNotSeen() {
        QFETCH(bool, own);
        SurfaceMesh mesh = ball();
        if (own)
            for (glm::vec2& uv : mesh.cornerUvs) uv.x = std::abs(uv.x - 0.5f) * 2.0f;
        LicScene scene(std::move(mesh), {{{0.1f, 0, 0}, {0, 0, 0.1f}}, {{-0.1f, 0, 0}, {0, 0, -0.1f}}});
        const LicPainter painter = painterFor(scene, 512);
        scene.lic().grain.value = 4.0f * painter.atlas().usualTexel();
        scene.lic().length.value = 20.0f * painter.atlas().usualTexel();
        const LicTexture texture = painted(painter, scene);
        // Places a texel on both sides of every edge: those that are seams in these UVs, and all others.
        const auto across = trianglesAcross(scene.surface->mesh());
        const SurfaceMesh& m = scene.surface->mesh();
        double sums[2] = {0, 0};
        int counts[2] = {0, 0};
        for (std::uint32_t t = 0; t < m.triangleCount(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t other = across[t][k];
                if (other == noTriangle || other < t) continue;
                const std::uint32_t a = m.triangles[t][k], b = m.triangles[t][(k + 1) % 3];
                const glm::vec3 middle = 0.5f * (m.positions[a] + m.positions[b]);
                if (std::abs(middle.y) > 0.07f) continue;  // texels of the poles are stretched
                double light[2];
                bool seam = false;
                for (int s = 0; s < 2; ++s) {
                    const std::uint32_t here = s == 0 ? t : other;
                    float shares[3];
                    for (int c = 0; c < 3; ++c) {
                        const std::uint32_t v = m.triangles[here][c];
                        const bool shared = v == a || v == b;
                        const float height =
                            glm::length(glm::cross(m.positions[b] - m.positions[a], m.positions[v] - m.positions[a])) /
                            glm::distance(m.positions[a], m.positions[b]);
                        const float into = shared ? 0.0f : 0.75f * painter.atlas().usualTexel() / height;
                        shares[c] = shared ? -1.0f : into;
                    }
                    const float rest = (1.0f - std::max({shares[0], shares[1], shares[2]})) * 0.5f;
                    for (float& share : shares) share = share < 0.0f ? rest : share;
                    light[s] = (*texture.light)[texelAt(texture, {here, shares[1], shares[2]})] / 255.0;
                    for (int c = 0; c < 3 && s == 1; ++c) {
                        for (int d = 0; d < 3; ++d) {
                            if (m.triangles[t][d] != m.triangles[other][c]) continue;
                            const glm::vec2 apart = (*texture.cornerUvs)[t * 3ull + static_cast<std::size_t>(d)] -
                                                    (*texture.cornerUvs)[other * 3ull + static_cast<std::size_t>(c)];
                            seam = seam || glm::length(apart) > 1e-4f;
                        }
                    }
                }
                sums[seam] += std::abs(light[0] - light[1]);
                ++counts[seam];
            }
        }
        QVERIFY(counts[0] > 1000 && counts[1] > 20);
        const double inside = sums[0] / counts[0], over = sums[1] / counts[1];
        QVERIFY2(inside > 0.0 && over < 1.1 * inside, qPrintable(QString("%1 %2").arg(over).arg(inside)));
    }

    void nothingComesOverAPartingOrABorder_data() {
        QTest::addColumn<QString>("between");
        for (const char* between : {"nothing", "parting", "border"}) QTest::newRow(between) << QString(between);
    }

    // Other noise on the right: what changes on the left?
    void nothingComesOverAPartingOrABorder() {
        QFETCH(QString, between);
        const std::vector<glm::vec3> middle{{0, 0, -0.1f}, {0, 0, 0.1f}};
        LicScene scene(testing::plane(20, 0.2f),
                       {{{-0.09f, 0, 0.01f}, {-0.03f, 0, 0}}, {{0.03f, 0, 0.01f}, {0.09f, 0, 0}}},
                       between == "parting" ? Lines{middle} : Lines{});
        Groom& groom = scene.groom;
        Map density(200, 200, 1, TexelFormat::U8, 1.0f), grain = density;
        for (int y = 0; y < 200; ++y) {
            // No hair on two columns of triangles, of 10 texels each.
            for (int x = 95; x < 125; ++x) density.setTexel(x, y, 0, 0.0f);
            for (int x = between == "border" ? 112 : 101; x < 200; ++x) grain.setTexel(x, y, 0, 0.45f);
        }
        if (between == "border") {
            groom.maps.set("density", density);
            groom.groups.edit()[0].params.general.density.map = "density";
        }
        groom.maps.set("grain", Map(200, 200, 1, TexelFormat::U8, 1.0f));
        scene.lic().length.value = 0.03f;
        scene.lic().grain = {0.003f, "grain"};
        scene.solve();
        const LicPainter painter = painterFor(scene, 200);
        const LicTexture before = painted(painter, scene);
        groom.maps.set("grain", grain);
        const LicTexture after = painted(painter, scene);
        int left = 0, right = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 200; ++x) {
                const auto at = static_cast<std::size_t>(y * 200 + x);
                const bool differs = (*before.light)[at] != (*after.light)[at];
                left += x < 100 && differs;
                right += x > 125 && differs;
            }
        }
        QVERIFY2(right > 10000, qPrintable(QString::number(right)));
        QVERIFY2(between == "nothing" ? left > 2000 : left == 0, qPrintable(QString::number(left)));
    }

    void uvsThatNeedAnAtlasGetOne_data() {
        QTest::addColumn<QString>("fault");
        for (const char* fault : {"none", "mirrored halves", "outside", "missing", "no room at seams"})
            QTest::newRow(fault) << QString(fault);
    }

    void uvsThatNeedAnAtlasGetOne() {
        QFETCH(QString, fault);
        SurfaceMesh mesh = testing::sphere(24, 32, 0.1f);
        for (std::size_t i = 0; i < mesh.cornerUvs.size(); ++i) {
            glm::vec2& uv = mesh.cornerUvs[i];
            if (fault == "mirrored halves") uv.x = std::abs(uv.x - 0.5f) * 2.0f;
            if (fault == "outside") uv.x += 0.3f;
            if (fault == "missing") uv = glm::vec2(0.0f);
            // Squares moved about: each touches others than its neighbours on the skin.
            if (fault == "no room at seams") {
                const glm::vec2 first = mesh.cornerUvs[i];
                static_cast<void>(first);
                const std::size_t square = i / 6;
                uv = glm::vec2(static_cast<float>(square * 7 % 32) / 32.0f, static_cast<float>(square % 24) / 24.0f) +
                     glm::vec2(i % 3 == 1 ? 1.0f / 32.0f : 0.0f, i % 3 == 2 ? 1.0f / 24.0f : 0.0f);
            }
        }
        LicScene scene(std::move(mesh), aroundTheBall);
        const LicPainter painter = painterFor(scene, 128);
        QCOMPARE(painter.atlas().ownUvs(), fault != "none");
        const LicTexture texture = painted(painter, scene);
        QCOMPARE(texture.cornerUvs->size(), scene.surface->mesh().triangles.size() * 3);
        for (const glm::vec2& uv : *texture.cornerUvs)
            QVERIFY(uv.x >= 0.0f && uv.y >= 0.0f && uv.x <= 1.0f && uv.y <= 1.0f);
        QCOMPARE(painterFor(scene, 128, LicLayout::Mesh).atlas().ownUvs(), false);
    }
};

QTEST_GUILESS_MAIN(LicSeamsTest)
#include "lic_seams_test.moc"
