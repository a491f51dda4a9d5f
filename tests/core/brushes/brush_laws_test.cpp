// SPDX-License-Identifier: Apache-2.0
// Laws that every brush in the list keeps.
#include "core/base/random.h"
#include "core/brushes/brush.h"
#include "core/brushes/orbit_view.h"
#include "core/commands/partings.h"
#include "core/commands/strokes.h"
#include "core/surface/parting_line.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace whorl;
using namespace whorl::testing;

namespace {

/// A sphere with bent guides all over and a map to paint.
Groom makeBentGroom() {
    Groom groom = groomOn(sphere(24, 48, 0.1f), 300, 15, 0.05f);
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        const auto points = groom.guides.editPoints(i);
        const glm::vec3 bend(randomFloat(7, i, 0) - 0.5f, randomFloat(7, i, 1) - 0.5f, randomFloat(7, i, 2) - 0.5f);
        for (std::size_t k = 1; k < points.size(); ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(points.size() - 1);
            points[k] += bend * (0.02f * t * t) + bend * (0.002f * std::sin(9.0f * t));
        }
    }
    // Lines for the parting brush to erase: round the ball a little above its middle, and over its top.
    const Surface surface(groom.mesh);
    const auto line = [&](const std::vector<glm::vec3>& places) {
        if (!addParting(groom, surface, places)) qFatal("no parting");
    };
    line({{0.1f, 0.012f, 0}, {0, 0.012f, 0.1f}, {-0.1f, 0.012f, 0}, {0, 0.012f, -0.1f}});
    line({{0.05f, 0.04f, 0.1f}, {0, 0.1f, 0}, {-0.05f, 0.03f, -0.1f}});
    // Short strokes all over, to move, align and erase.
    for (std::uint64_t i = 0; i < 600; ++i) {
        const glm::vec3 from = glm::normalize(
            glm::vec3(randomFloat(11, i, 0) - 0.5f, randomFloat(11, i, 1) - 0.5f, randomFloat(11, i, 2) - 0.5f));
        const glm::vec3 along(randomFloat(11, i, 3) - 0.5f, randomFloat(11, i, 4) - 0.5f, randomFloat(11, i, 5) - 0.5f);
        const std::array places{from * 0.1f, from * 0.1f + along * 0.012f};
        if (!addStroke(groom, surface, StrokeKind::Along, places)) qFatal("no stroke");
    }
    groom.maps.set("density", Map(300, 260, 1, TexelFormat::U16, 0.5f));
    return groom;
}

const Groom& bentGroom() {
    static const Groom groom = makeBentGroom();
    return groom;
}

/// The surface of a mesh that was asked for before is the same one, with its distance field.
std::shared_ptr<const Surface> surfaceOf(const Groom& groom) {
    static std::vector<std::shared_ptr<const Surface>> made;
    for (const auto& surface : made) {
        if (surface->shared.sameAs(groom.mesh)) return surface;
    }
    return made.emplace_back(std::make_shared<Surface>(groom.mesh));
}

BrushSettings settings() {
    BrushSettings result;
    result.radiusPixels = 60.0f;
    result.strength = 0.8f;
    result.map = "density";
    return result;
}

using Path = std::vector<StrokePoint>;
const Path across{{{300.0f, 250.0f}, 1.0f}, {{428.0f, 250.0f}, 0.5f}, {{428.0f, 346.0f}, 1.0f}};

Groom stroked(const BrushInfo& brush, const Groom& groom, const StrokeView& view, const BrushSettings& how,
              const Path& path) {
    auto stroke = Stroke::begin(brush, groom, surfaceOf(groom), view, how);
    if (!stroke) qFatal("%s", stroke.error().message.c_str());
    for (const StrokePoint& point : path) stroke->moveTo(point);
    return stroke->finish();
}

StrokeView viewOf(const Groom& groom, float azimuth = 0.4f, float elevation = 0.3f) {
    return orbitView(boundsOf(*groom.mesh), azimuth, elevation, {800.0f, 600.0f});
}

StrokeView reflected(StrokeView view) {
    view.clipFromGroom[0] = -view.clipFromGroom[0];
    view.eyeGroom.x = -view.eyeGroom.x;
    return view;
}

SurfaceMesh reflectedMesh(SurfaceMesh mesh) {
    for (auto& p : mesh.positions) p.x = -p.x;
    for (auto& n : mesh.normals) n.x = -n.x;
    for (auto& t : mesh.triangles) std::swap(t.y, t.z);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        std::swap(mesh.cornerUvs[3 * t + 1], mesh.cornerUvs[3 * t + 2]);
    return mesh;
}

/// Of a groom on the mesh of bentGroom or on its mirror image.
Groom reflected(const Groom& groom) {
    Groom other = groom;
    static const Cow<SurfaceMesh> sourceMesh = bentGroom().mesh;
    static Cow<SurfaceMesh> mirroredMesh;
    if (groom.mesh.sameAs(mirroredMesh)) {
        other.mesh = sourceMesh;
    } else {
        if (mirroredMesh->triangles.empty()) mirroredMesh = reflectedMesh(*sourceMesh);
        other.mesh = mirroredMesh;
    }
    for (std::size_t i = 0; i < other.guides.count(); ++i) {
        SurfacePoint root = other.guides.root(i);
        std::swap(root.u, root.v);
        other.guides.setRoot(i, root);
        for (glm::vec3& p : other.guides.editPoints(i)) p.x = -p.x;
    }
    for (Parting& parting : other.partings.edit())
        for (SurfacePoint& point : parting.points) std::swap(point.u, point.v);
    for (FieldStroke& stroke : other.strokes.edit())
        for (SurfacePoint& point : stroke.points) std::swap(point.u, point.v);
    return other;
}

float largestMapDifference(const Map& a, const Map& b) {
    float largest = 0.0f;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) largest = std::max(largest, std::abs(a.texel(x, y) - b.texel(x, y)));
    }
    return largest;
}

// Partings or strokes at the same places, in the same order.
template <class Line>
bool sameLines(const Groom& a, const std::vector<Line>& of, const Groom& b, const std::vector<Line>& other) {
    if (of.size() != other.size()) return false;
    for (std::size_t i = 0; i < of.size(); ++i) {
        if (of[i].points.size() != other[i].points.size()) return false;
        for (std::size_t k = 0; k < of[i].points.size(); ++k) {
            const glm::vec3 p = positionAt(*a.mesh, of[i].points[k]), q = positionAt(*b.mesh, other[i].points[k]);
            if (glm::length(p - q) > 2e-5f) return false;
        }
    }
    return true;
}

float largestGuideDifference(const GuideSet& a, const GuideSet& b) {
    float largest = 0.0f;
    for (std::size_t i = 0; i < a.count(); ++i) {
        const auto p = a.points(i), q = b.points(i);
        for (std::size_t k = 0; k < p.size(); ++k) largest = std::max(largest, glm::length(p[k] - q[k]));
    }
    return largest;
}

}  // namespace

class BrushLawsTest : public QObject {
    Q_OBJECT

    static void eachBrush() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<bool>("invert");
        for (const BrushInfo& info : brushes()) {
            const QString id = QString::fromUtf8(info.id.data(), static_cast<qsizetype>(info.id.size()));
            QTest::newRow(qPrintable(id)) << id << false;
            QTest::newRow(qPrintable(id + " inverted")) << id << true;
        }
    }
    static const BrushInfo& brush() {
        QFETCH(QString, id);
        return *findBrush(id.toStdString());
    }
    static BrushSettings how() {
        QFETCH(bool, invert);
        BrushSettings result = settings();
        result.invert = invert;
        return result;
    }

private Q_SLOTS:
    void idsAndShortcutsAreUnique() {
        QVERIFY(brushes().size() >= 8);
        for (const BrushInfo& a : brushes()) {
            QVERIFY(!a.id.empty() && !a.label.empty() && !a.tip.empty() && !a.undoText.empty() && a.make != nullptr);
            for (const BrushInfo& b : brushes()) {
                QVERIFY(&a == &b || (a.id != b.id && (a.shortcut.empty() || a.shortcut != b.shortcut)));
            }
            QCOMPARE(findBrush(a.id), &a);
        }
        QVERIFY(findBrush("no such brush") == nullptr);
    }

    void aStrokeDoesSomething_data() { eachBrush(); }
    void aStrokeDoesSomething() {
        Groom groom = bentGroom();
        if (brush().id == "place" && !how().invert) groom.guides.clear();
        const Groom after = stroked(brush(), groom, viewOf(groom), how(), across);
        QVERIFY(groomDigest(after) != groomDigest(groom));
    }

    void zeroStrengthChangesNothing_data() { eachBrush(); }
    void zeroStrengthChangesNothing() {
        const Groom groom = bentGroom();
        BrushSettings zero = how();
        zero.strength = 0.0f;
        QVERIFY(stroked(brush(), groom, viewOf(groom), zero, across).sameAs(groom));
        Path weightless = across;
        for (StrokePoint& point : weightless) point.pressure = 0.0f;
        QVERIFY(stroked(brush(), groom, viewOf(groom), how(), weightless).sameAs(groom));
    }

    void aStrokeOffEverythingChangesNothing_data() { eachBrush(); }
    void aStrokeOffEverythingChangesNothing() {
        const Groom groom = bentGroom();
        const Path beside{{{-300.0f, -300.0f}, 1.0f}, {{-200.0f, 900.0f}, 1.0f}};
        for (const Reach reach : {Reach::Projected, Reach::Spherical}) {
            BrushSettings off = how();
            off.reach = reach;
            QVERIFY(stroked(brush(), groom, viewOf(groom), off, beside).sameAs(groom));
        }
    }

    void hostilePointsChangeNothing_data() { eachBrush(); }
    void hostilePointsChangeNothing() {
        const Groom groom = bentGroom();
        const float nan = std::nanf("");
        const Path bad{{{nan, 3.0f}, 1.0f}, {{1e30f, 3.0f}, 1.0f}, {{300.0f, 300.0f}, nan}};
        QVERIFY(stroked(brush(), groom, viewOf(groom), how(), bad).sameAs(groom));
    }

    void emptyGroomsAreFine_data() { eachBrush(); }
    void emptyGroomsAreFine() {
        Groom groom = bentGroom();
        groom.guides.clear();
        const Groom after = stroked(brush(), groom, viewOf(groom), how(), across);
        QVERIFY(checkGroom(after).empty());
    }

    void lawsOfTheGroomHold_data() { eachBrush(); }
    void lawsOfTheGroomHold() {
        const Groom groom = bentGroom();
        for (const Reach reach : {Reach::Projected, Reach::Spherical}) {
            for (const bool keep : {false, true}) {
                BrushSettings use = how();
                use.reach = reach;
                use.keepLength = use.keepOutside = use.frontOnly = keep;
                const Groom after = stroked(brush(), groom, viewOf(groom), use, across);
                const Problems problems = checkGroom(after);  // roots on the skin, finite, equal vertex counts
                QVERIFY2(problems.empty(), problems.empty() ? "" : problems.front().c_str());
            }
        }
    }

    void mirroredInputGivesMirroredOutput_data() { eachBrush(); }
    void mirroredInputGivesMirroredOutput() {
        const Groom groom = bentGroom();
        const StrokeView view = viewOf(groom);
        const Groom there = stroked(brush(), reflected(groom), reflected(view), how(), across);
        const Groom expected = reflected(stroked(brush(), groom, view, how(), across));
        QCOMPARE(there.guides.count(), expected.guides.count());
        QVERIFY(largestGuideDifference(there.guides, expected.guides) < 2e-5f);
        QVERIFY(sameLines(there, *there.partings, expected, *expected.partings));
        QVERIFY(sameLines(there, *there.strokes, expected, *expected.strokes));
        QVERIFY(largestMapDifference(*there.maps.find("density"), *expected.maps.find("density")) < 1e-3f);
    }

    void mirrorDoesTheSameOnTheOtherSide_data() { eachBrush(); }
    void mirrorDoesTheSameOnTheOtherSide() {
        // Far from the plane of symmetry, the two sides do not meet: one after the other is the same as together.
        const Groom groom = bentGroom();
        const StrokeView view = viewOf(groom, 0.9f, 0.1f);
        BrushSettings use = how();
        use.radiusPixels = 30.0f;
        const Path path{{{420.0f, 300.0f}, 1.0f}, {{460.0f, 300.0f}, 1.0f}};
        const Groom twice = stroked(brush(), stroked(brush(), groom, view, use, path), reflected(view), use, path);
        use.mirrorX = true;
        Groom mirrored = stroked(brush(), groom, view, use, path);
        if (brush().id == "whorl" && !use.invert) {
            QCOMPARE(mirrored.strokes->back().kind, StrokeKind::ClockwiseWhorl);
            mirrored.strokes.edit().back().kind = StrokeKind::Whorl;
        }
        QVERIFY(groomDigest(mirrored) != groomDigest(groom) || brush().id == "place");
        QCOMPARE(mirrored.guides.count(), twice.guides.count());
        if (brush().id == "place" && !use.invert) return;  // order of the new guides differs
        QVERIFY(groomDigest(mirrored) == groomDigest(twice));
    }

    void theSplitIntoEventsDoesNotMatter_data() { eachBrush(); }
    void theSplitIntoEventsDoesNotMatter() {
        const Groom groom = bentGroom();
        const StrokeView view = viewOf(groom);
        const Groom whole = stroked(brush(), groom, view, how(), across);
        for (const int pieces : {2, 8, 64}) {
            Path path{across.front()};
            for (std::size_t i = 1; i < across.size(); ++i) {
                for (int k = 1; k <= pieces; ++k) {
                    const float t = static_cast<float>(k) / static_cast<float>(pieces);
                    path.push_back({across[i - 1].pixel + (across[i].pixel - across[i - 1].pixel) * t,
                                    across[i - 1].pressure + (across[i].pressure - across[i - 1].pressure) * t});
                }
            }
            QVERIFY(groomDigest(stroked(brush(), groom, view, how(), path)) == groomDigest(whole));
        }
    }

    void onlyWhatChangedIsUnshared_data() { eachBrush(); }
    void onlyWhatChangedIsUnshared() {
        const Groom groom = bentGroom();
        BrushSettings use = how();
        use.radiusPixels = 25.0f;
        const Path dab{{{400.0f, 300.0f}, 1.0f}, {{406.0f, 300.0f}, 1.0f}};
        const Groom after = stroked(brush(), groom, viewOf(groom), use, dab);
        QVERIFY(after.mesh.sameAs(groom.mesh) && after.groups.sameAs(groom.groups) &&
                after.counts.sameAs(groom.counts));
        const Map& before = *groom.maps.find("density");
        const Map& now = *after.maps.find("density");
        for (int row = 0; row < now.tileRows(); ++row) {
            for (int column = 0; column < now.tileColumns(); ++column) {
                QVERIFY(now.tileSameAs(column, row, before) ||
                        now.tileBytes(column, row) != before.tileBytes(column, row));
            }
        }
        if (after.guides.count() != groom.guides.count()) return;
        for (std::size_t b = 0; b < after.guides.blockCount(); ++b) {
            const bool same = after.guides.blockSameAs(b, groom.guides);
            QVERIFY(same || after.guides.block(b).points != groom.guides.block(b).points);
        }
        QVERIFY(after.bytesNotSharedWith(groom) <= groom.guides.bytesNotSharedWith({}) + before.bytesNotSharedWith({}));
    }

    void strokesSayWhetherTheyChanged_data() { eachBrush(); }
    void strokesSayWhetherTheyChanged() {
        const Groom groom = bentGroom();
        auto stroke = Stroke::begin(brush(), groom, surfaceOf(groom), viewOf(groom), how());
        QVERIFY(stroke.ok());
        for (const StrokePoint& point : across) {
            const Groom before = stroke->groom();
            const bool changed = stroke->moveTo(point);
            QCOMPARE(changed, groomDigest(before) != groomDigest(stroke->groom()));
        }
    }
};

QTEST_APPLESS_MAIN(BrushLawsTest)
#include "brush_laws_test.moc"
