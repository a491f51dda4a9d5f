// SPDX-License-Identifier: Apache-2.0
// Laws of hair texture over a whole mesh: it is that of the reference, whatever is made again and by whom.
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/base/simd.h"
#include "core/field/growing_area.h"
#include "core/io/open.h"
#include "core/lic/painter.h"
#include "core/lic/reference.h"
#include "core/surface/adjacency.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

namespace {

using Lines = std::vector<std::vector<glm::vec3>>;

/// A groom with all that a texture is painted from.
struct Scene {
    Groom groom;
    std::shared_ptr<const Surface> surface;
    DirectionField field;

    Scene(SurfaceMesh mesh, const Lines& lines, const Lines& partings = {}) : groom(makeGroom(std::move(mesh))) {
        surface = std::make_shared<const Surface>(groom.mesh);
        for (const auto& line : partings)
            groom.partings.edit().push_back({nextPartingId(*groom.partings), "", *tracedParting(*surface, line)});
        for (const auto& line : lines) groom.strokes.edit().emplace_back().points = *tracedParting(*surface, line);
        solve();
    }
    void solve() {
        Progress progress;
        const auto solver = FieldSolver::make(surface, growingTriangles(groom), *groom.partings, progress);
        field = *solver->solve(*groom.strokes, *groom.field, progress);
    }
    LicParams& lic() { return groom.lic.edit(); }
};

LicPainter painterFor(const Scene& scene, int size, LicLayout layout = LicLayout::Best) {
    Progress progress;
    return *LicPainter::make(scene.surface, size, progress, layout);
}

LicTexture painted(const LicPainter& painter, const Scene& scene, const LicTexture* before = nullptr) {
    Progress progress;
    return *painter.paint(scene.groom, scene.field, before, progress);
}

SurfaceMesh ball() {
    return testing::sphere(64, 96, 0.1f);
}

const Lines aroundTheBall{{{0.1f, 0, 0}, {0.08f, 0.05f, 0.03f}, {0.05f, 0.08f, 0.02f}},
                          {{-0.05f, 0.08f, 0.03f}, {-0.09f, 0.02f, 0.04f}},
                          {{0, -0.02f, -0.1f}, {0.03f, 0.01f, -0.09f}}};

struct Statistics {
    double mean = 0, deviation = 0;
};

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ma += a[i] / n;
        mb += b[i] / n;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - ma) * (a[i] - ma);
        bb += (b[i] - mb) * (b[i] - mb);
        ab += (a[i] - ma) * (b[i] - mb);
    }
    return ab / std::sqrt(aa * bb);
}

/// Number of a texel in the layers; nothing in the frame around.
std::optional<std::size_t> texelOf(const LicPainter& painter, const TexelAtlas::Slot& slot) {
    const auto side = static_cast<std::uint32_t>(painter.atlas().side());
    const auto size = static_cast<std::uint32_t>(painter.size());
    const std::uint32_t x = slot.texel % side - TexelAtlas::pad, y = slot.texel / side - TexelAtlas::pad;
    if (x >= size || y >= size) return std::nullopt;
    return std::size_t{y} * size + x;
}

/// Light at a place, by the texel that it lies in.
double lightAt(const LicPainter& painter, const LicTexture& texture, const SurfacePoint& at) {
    const std::vector<glm::vec2>& uvs = *texture.cornerUvs;
    const glm::vec2 uv = uvs[at.triangle * 3ull] * (1.0f - at.u - at.v) + uvs[at.triangle * 3ull + 1] * at.u +
                         uvs[at.triangle * 3ull + 2] * at.v;
    const int size = painter.size();
    const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(size)), 0, size - 1);
    const int y = std::clamp(static_cast<int>((1.0f - uv.y) * static_cast<float>(size)), 0, size - 1);
    return (*texture
                 .light)[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)] /
           255.0;
}

double agreement(const LicPainter& painter, const LicTexture& texture, const Scene& scene, std::size_t most = 1500) {
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
        std::optional<Scene> scene;
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
        Scene scene(ball(), aroundTheBall);
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
            const bool same = *next.light == *last.light && *next.cover == *last.cover;
            if (next.changedTo != glm::ivec2(0)) {
                for (int y = 0; y < next.size; ++y) {
                    for (int x = 0; x < next.size; ++x) {
                        if (x >= next.changedFrom.x && y >= next.changedFrom.y && x < next.changedTo.x &&
                            y < next.changedTo.y)
                            continue;
                        const auto at = static_cast<std::size_t>(y * next.size + x);
                        QCOMPARE((*next.light)[at], (*last.light)[at]);
                        QCOMPARE((*next.cover)[at], (*last.cover)[at]);
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
        Scene scene(ball(), aroundTheBall);
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
        Scene scene(std::move(mesh), {{{0.1f, 0, 0}, {0, 0, 0.1f}}, {{-0.1f, 0, 0}, {0, 0, -0.1f}}});
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
                    light[s] = lightAt(painter, texture, {here, shares[1], shares[2]});
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
        Scene scene(testing::plane(20, 0.2f),
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
        Scene scene(std::move(mesh), aroundTheBall);
        const LicPainter painter = painterFor(scene, 128);
        QCOMPARE(painter.atlas().ownUvs(), fault != "none");
        const LicTexture texture = painted(painter, scene);
        QCOMPARE(texture.cornerUvs->size(), scene.surface->mesh().triangles.size() * 3);
        for (const glm::vec2& uv : *texture.cornerUvs)
            QVERIFY(uv.x >= 0.0f && uv.y >= 0.0f && uv.x <= 1.0f && uv.y <= 1.0f);
        QCOMPARE(painterFor(scene, 128, LicLayout::Mesh).atlas().ownUvs(), false);
    }

    void theBorderFraysIntoHairs() {
        Scene scene(testing::plane(40, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0.02f}}});
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
        Scene scene(std::move(mesh), {{{-0.08f, 0, 0}, {0.08f, 0, 0.02f}}});
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
        Scene scene(testing::plane(10, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0.02f}}});
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

    void parametersDoWhatTheySay() {
        Scene scene(testing::plane(6, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0}}});
        const LicPainter painter = painterFor(scene, 256);
        const float texel = painter.atlas().usualTexel();
        QVERIFY(std::abs(texel - 0.2f / 256.0f) < 1e-6f);
        LicTexture texture;
        const auto paint = [&](float length, float grain, float white) {
            scene.lic().length.value = length * texel;
            scene.lic().grain.value = grain * texel;
            scene.lic().white = white;
            texture = painted(painter, scene);
        };
        const auto light = [&](int x, int y) {
            return (*texture.light)[static_cast<std::size_t>(y * 256 + x)] / 255.0;
        };
        const auto statistics = [&] {
            Statistics s;
            std::size_t count = 0;
            for (int y = 40; y < 216; ++y) {
                for (int x = 60; x < 196; ++x, ++count) {
                    s.mean += light(x, y);
                    s.deviation += light(x, y) * light(x, y);
                }
            }
            s.mean /= static_cast<double>(count);
            s.deviation = std::sqrt(s.deviation / static_cast<double>(count) - s.mean * s.mean);
            return s;
        };
        const auto alike = [&](int dx, int dy) {
            std::vector<double> a, b;
            for (int y = 40; y < 216; ++y) {
                for (int x = 60; x < 196; ++x) {
                    a.push_back(light(x, y));
                    b.push_back(light(x + dx, y + dy));
                }
            }
            return correlation(a, b);
        };
        // Share of white is the mean; mean and deviation are as announced.
        for (const float white : {0.1f, 0.5f, 0.85f}) {
            paint(20.0f, 2.0f, white);
            const Statistics s = statistics();
            QVERIFY2(std::abs(s.mean - static_cast<double>(white)) < 0.02, qPrintable(QString::number(s.mean)));
            QCOMPARE(texture.mean, white);
            QVERIFY2(std::abs(s.deviation / static_cast<double>(texture.deviation) - 1.0) < 0.25,
                     qPrintable(QString("%1 %2").arg(s.deviation).arg(static_cast<double>(texture.deviation))));
        }
        // Length: alike along the hair over more of it. Grain: alike across.
        paint(10.0f, 2.0f, 0.5f);
        const double shortAlong = alike(8, 0), thinAcross = alike(0, 2);
        paint(40.0f, 2.0f, 0.5f);
        const double longAlong = alike(8, 0);
        paint(20.0f, 6.0f, 0.5f);
        const double thickAcross = alike(0, 2);
        QVERIFY2(longAlong > 0.8 && longAlong > shortAlong + 0.2,
                 qPrintable(QString("%1 %2").arg(shortAlong).arg(longAlong)));
        QVERIFY2(thickAcross > 0.5 && std::abs(thinAcross) < 0.15,
                 qPrintable(QString("%1 %2").arg(thinAcross).arg(thickAcross)));
        // Over few texels soft ends change less than hard ones.
        paint(20.0f, 2.0f, 0.5f);
        const double soft = alike(4, 0);
        scene.lic().kernel.index = 1;
        paint(20.0f, 2.0f, 0.5f);
        const double box = alike(4, 0), farBox = alike(12, 0);
        QVERIFY2(std::abs(farBox - (1.0 - 12.0 / 41.0)) < 0.06 && soft > box + 0.01,
                 qPrintable(QString("%1 %2 %3").arg(soft).arg(box).arg(farBox)));
        const std::vector<std::uint8_t> first = *texture.light;
        scene.lic().seed = 2;
        paint(20.0f, 2.0f, 0.5f);
        QVERIFY(*texture.light != first);
        // No length: noise as it is.
        paint(0.0f, 4.0f, 0.5f);
        QVERIFY(std::abs(statistics().deviation - 0.45) < 0.05);
    }

    void mapsScaleLengthAndGrainPlaceByPlace() {
        Scene scene(testing::plane(6, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0}}});
        const LicPainter painter = painterFor(scene, 256);
        const float texel = painter.atlas().usualTexel();
        scene.lic().length = {30.0f * texel, "length"};
        scene.lic().grain = {4.0f * texel, "grain"};
        scene.groom.maps.set("length", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        scene.groom.maps.set("grain", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        const LicTexture all = painted(painter, scene);
        scene.groom.maps.set("length", Map(16, 16, 1, TexelFormat::F32, 0.2f));
        const LicTexture shorter = painted(painter, scene);
        scene.groom.maps.set("length", Map(16, 16, 1, TexelFormat::U8, 1.0f));
        scene.groom.maps.set("grain", Map(16, 16, 1, TexelFormat::F32, 0.5f));
        const LicTexture finer = painted(painter, scene);
        // As if the parameters said so themselves.
        scene.lic().grain = {2.0f * texel, ""};
        const LicTexture fine = painted(painter, scene);
        scene.lic().grain = {4.0f * texel, ""};
        scene.lic().length = {6.0f * texel, ""};
        const LicTexture brief = painted(painter, scene);
        const auto alike = [&](const LicTexture& a, const LicTexture& b) {
            std::vector<double> x, y;
            for (std::size_t i = 256 * 60; i < 256 * 200; ++i) {
                x.push_back((*a.light)[i]);
                y.push_back((*b.light)[i]);
            }
            return correlation(x, y);
        };
        QVERIFY2(alike(shorter, brief) > 0.97, qPrintable(QString::number(alike(shorter, brief))));
        QVERIFY(alike(all, brief) < 0.8);
        QVERIFY2(alike(finer, fine) > 0.9, qPrintable(QString::number(alike(finer, fine))));
        QVERIFY(alike(all, fine) < 0.3);
    }

    void smallTexturesLookLikeBigOnes() {
        Scene scene(ball(), aroundTheBall);
        scene.lic().grain.value = 0.0012f;
        scene.lic().length.value = 0.012f;
        const LicTexture big = painted(painterFor(scene, 1024), scene);
        const LicTexture little = painted(painterFor(scene, 256), scene);
        std::vector<double> averaged, made;
        for (int y = 64; y < 192; ++y) {
            for (int x = 4; x < 252; ++x) {
                double sum = 0;
                for (int i = 0; i < 16; ++i)
                    sum += (*big.light)[static_cast<std::size_t>((y * 4 + i / 4) * 1024 + x * 4 + i % 4)] / 16.0;
                averaged.push_back(sum);
                made.push_back((*little.light)[static_cast<std::size_t>(y * 256 + x)]);
            }
        }
        QVERIFY2(correlation(averaged, made) > 0.8, qPrintable(QString::number(correlation(averaged, made))));
        QVERIFY(std::abs(big.mean - little.mean) < 1e-6f && little.deviation < big.deviation);
    }

    void colourIsThatOfTheHair() {
        Scene scene(testing::plane(6, 0.2f), {{{-0.08f, 0, 0}, {0.08f, 0, 0}}});
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

    void emptyCancelledAndTiny() {
        Scene scene(testing::plane(3, 0.2f), {});
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
