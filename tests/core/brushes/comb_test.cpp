// SPDX-License-Identifier: Apache-2.0
// The comb, its constraints, the index of guides, and what single brushes promise.
#include "core/base/random.h"
#include "core/brushes/brush_index.h"
#include "core/brushes/constraints.h"
#include "core/brushes/orbit_view.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <cmath>

using namespace whorl;
using namespace whorl::testing;

namespace {

const Groom& hairyBall() {
    static const Groom groom = groomOn(sphere(24, 48, 0.1f), 500, 15, 0.06f);
    return groom;
}

std::shared_ptr<const Surface> ballSurface() {
    static const auto surface = std::make_shared<const Surface>(hairyBall().mesh);
    return surface;
}

StrokeView viewOf(const Groom& groom, float azimuth = 0.0f, float elevation = 0.0f) {
    return orbitView(boundsOf(*groom.mesh), azimuth, elevation, {800.0f, 600.0f});
}

Groom stroked(std::string_view brush, const Groom& groom, const StrokeView& view, const BrushSettings& settings,
              const std::vector<glm::vec2>& path) {
    auto stroke = Stroke::begin(*findBrush(brush), groom, ballSurface(), view, settings);
    if (!stroke) qFatal("%s", stroke.error().message.c_str());
    for (const glm::vec2& pixel : path) stroke->moveTo({pixel, 1.0f});
    return stroke->finish();
}

float lengthError(const GuideSet& before, const GuideSet& after) {
    float largest = 0.0f;
    for (std::size_t i = 0; i < before.count(); ++i) {
        const auto a = before.points(i), b = after.points(i);
        for (std::size_t k = 1; k < a.size(); ++k) {
            largest = std::max(largest, std::abs(glm::length(a[k] - a[k - 1]) - glm::length(b[k] - b[k - 1])));
        }
    }
    return largest;
}

/// How deep the deepest point is inside the mesh, measured on the triangles, not on the field.
float deepest(const GuideSet& guides) {
    float depth = 0.0f;
    for (std::size_t i = 0; i < guides.count(); ++i) {
        const auto points = guides.points(i);
        for (std::size_t k = 1; k < points.size(); ++k) {
            const auto hit = ballSurface()->query.nearest(points[k]);
            const glm::vec3 normal = triangleNormal(ballSurface()->mesh(), hit->point.triangle);
            depth = std::max(depth, -glm::dot(points[k] - hit->position, normal));
        }
    }
    return depth;
}

}  // namespace

class CombTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void keepsLengthsAndStaysOutside() {
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 90.0f;
        for (const Reach reach : {Reach::Projected, Reach::Spherical}) {
            settings.reach = reach;
            Groom groom = hairyBall();
            // To and fro over the ball from several sides, pressing hair against it.
            for (int side = 0; side < 6; ++side) {
                const StrokeView view = viewOf(groom, static_cast<float>(side), 0.3f);
                groom =
                    stroked("comb", groom, view, settings,
                            {{150.0f, 250.0f}, {650.0f, 280.0f}, {300.0f, 350.0f}, {420.0f, 100.0f}, {400.0f, 560.0f}});
            }
            QVERIFY(groomDigest(groom) != groomDigest(hairyBall()));
            QVERIFY2(lengthError(hairyBall().guides, groom.guides) < 1e-5f,
                     qPrintable(QString::number(lengthError(hairyBall().guides, groom.guides))));
            QVERIFY2(deepest(groom.guides) <= 1e-6f, qPrintable(QString::number(deepest(groom.guides))));
            QVERIFY(checkGroom(groom).empty());
        }
    }

    void hairGoesWithThePointerAndTheTipFollows() {
        // One long guide at the right of the ball as seen from the front, its middle under the brush.
        Groom groom = hairyBall();
        groom.guides.clear();
        const auto hit = ballSurface()->query.nearest({0.2f, 0.0f, 0.0f});
        std::vector<glm::vec3> points;
        for (int i = 0; i <= 15; ++i)
            points.push_back(hit->position + glm::vec3(0.008f * static_cast<float>(i), 0.0f, 0.0f));
        groom.guides.append(hit->point, 0, points);
        const StrokeView view = viewOf(groom);
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 20.0f;
        settings.frontOnly = false;
        const glm::vec2 start = *view.pixelFromGroom(points[9]);
        const Groom after = stroked("comb", groom, view, settings, {start, start + glm::vec2(0.0f, 12.0f)});
        const auto moved = after.guides.points(0);
        const auto down = [&](std::size_t i) {
            return view.pixelFromGroom(moved[i])->y - view.pixelFromGroom(points[i])->y;
        };
        QVERIFY2(down(9) > 9.0f && down(9) < 12.1f, qPrintable(QString::number(down(9))));
        // Carried along at once: the tip is as far as the brushed point, and has not run ahead.
        QVERIFY2(std::abs(down(15) - down(9)) < 2.0f, qPrintable(QString::number(down(15))));
        QCOMPARE(moved[2], points[2]);  // before the brush nothing moves
        // In the plane facing the camera: the depth hardly changes.
        QVERIFY(std::abs(moved[9].z - points[9].z) < 2e-3f);
    }

    void withoutKeepingLengthPointsMoveExactlyWithThePointer() {
        Groom groom = hairyBall();
        const StrokeView view = viewOf(groom);
        BrushSettings settings;
        settings.keepLength = settings.keepOutside = settings.frontOnly = false;
        settings.strength = 1.0f;
        settings.radiusPixels = 30.0f;
        const glm::vec3 tip = groom.guides.points(0).back();
        const glm::vec2 start = *view.pixelFromGroom(tip);
        const Groom after = stroked("comb", groom, view, settings, {start, start + glm::vec2(16.0f, 0.0f)});
        const glm::vec2 moved = *view.pixelFromGroom(after.guides.points(0).back()) - start;
        // Within a spacing of the pointer, less what the falloff takes while the point lags.
        QVERIFY2(moved.x > 14.0f && moved.x < 16.1f, qPrintable(QString::number(moved.x)));
        QVERIFY(std::abs(moved.y) < 1e-2f);
    }

    void theIndexFindsWhatAPassOverAllPointsFinds() {
        Groom groom = hairyBall();
        BrushIndex index;
        BrushIndex::Selection selection;
        for (std::uint32_t round = 0; round < 60; ++round) {
            const auto random = [&](std::uint32_t channel) { return randomFloat(5, round, channel); };
            const StrokeView view = viewOf(groom, 6.0f * random(0), 2.0f * random(1) - 1.0f);
            BrushArea area{ScreenFrame(view),
                           round % 2 == 0 ? Reach::Projected : Reach::Spherical,
                           {800.0f * random(2), 600.0f * random(3)},
                           5.0f + 120.0f * random(4),
                           glm::vec3(random(5) - 0.5f, random(6) - 0.5f, random(7) - 0.5f) * 0.3f,
                           0.005f + 0.08f * random(8)};
            const bool frontOnly = round % 3 == 0;
            BrushIndex fresh;  // the view changed: visibility must be asked anew
            fresh.select(groom, *ballSurface(), area, view, frontOnly, false, selection);
            std::size_t next = 0;
            for (std::size_t i = 0; i < groom.guides.count(); ++i) {
                const auto points = groom.guides.points(i);
                float largest = 0.0f;
                for (const glm::vec3& p : points) largest = std::max(largest, area.weight(p));
                if (!(largest > 0.0f)) continue;
                if (frontOnly && !rootFacesEye(*ballSurface(), view, groom.guides.root(i))) continue;
                QVERIFY(next < selection.guides.size());
                const BrushIndex::Touched& touched = selection.guides[next++];
                QCOMPARE(std::size_t{touched.guide}, i);
                QCOMPARE(touched.largest, largest);
                for (std::size_t k = 0; k < points.size(); ++k) {
                    QCOMPARE(selection.weights[touched.firstWeight + k], area.weight(points[k]));
                }
            }
            QCOMPARE(next, selection.guides.size());

            // After an edit, an updated index must answer as a fresh one.
            index.follow(groom.guides);
            const auto guide = static_cast<std::uint32_t>(random(9) * 499.0f);
            for (glm::vec3& p : groom.guides.editPoints(guide).subspan(1))
                p += glm::vec3(0.03f * random(10), 0.02f, 0.0f);
            index.update(groom.guides, std::vector{guide});
            BrushIndex::Selection updated, again;
            index.select(groom, *ballSurface(), area, view, false, false, updated);
            BrushIndex().select(groom, *ballSurface(), area, view, false, false, again);
            QCOMPARE(updated.guides.size(), again.guides.size());
            QVERIFY(updated.weights == again.weights);
        }
    }

    void hiddenGuidesAreLeftAlone() {
        const Groom& groom = hairyBall();
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 300.0f;
        const Groom after = stroked("comb", groom, viewOf(groom), settings, {{300.0f, 300.0f}, {500.0f, 300.0f}});
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            if (positionAt(*groom.mesh, groom.guides.root(i)).z > 0.0f) continue;
            QVERIFY(std::ranges::equal(after.guides.points(i), groom.guides.points(i)));
        }
    }

    void scissorsCutAtTheBorderAndKeepTheCount() {
        Groom groom = hairyBall();
        const StrokeView view = viewOf(groom);
        BrushSettings settings;
        settings.radiusPixels = 15.0f;
        settings.frontOnly = false;
        // Beside the ball: the brush meets the upper half of guides that stick out there.
        const glm::vec2 place = *view.pixelFromGroom({0.15f, 0.0f, 0.0f});
        const Groom after = stroked("scissors", groom, view, settings, {place});
        const ScreenFrame frame(view);
        int cut = 0;
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const auto before = groom.guides.points(i), now = after.guides.points(i);
            QCOMPARE(now.size(), before.size());
            if (std::ranges::equal(before, now)) continue;
            ++cut;
            QVERIFY(curveLength(now) < curveLength(before));
            for (const glm::vec3& p : now) QVERIFY(glm::length(*view.pixelFromGroom(p) - place) > 14.9f);
            // The straight guide stays straight: what is left is where it was.
            QVERIFY(glm::length(glm::normalize(now.back() - now.front()) -
                                glm::normalize(before.back() - before.front())) < 1e-3f);
        }
        QVERIFY(cut > 0);
        // The second cut at the same place finds nothing.
        QVERIFY(groomDigest(stroked("scissors", after, view, settings, {place})) == groomDigest(after));
    }

    void scissorsLeaveAStub() {
        BrushSettings settings;
        settings.radiusPixels = 2000.0f;
        settings.frontOnly = false;
        const Groom after = stroked("scissors", hairyBall(), viewOf(hairyBall()), settings, {{400.0f, 300.0f}});
        for (std::size_t i = 0; i < after.guides.count(); ++i) {
            const float length = curveLength(after.guides.points(i));
            QVERIFY(length > 1e-4f && length < 3e-3f);
        }
    }

    void growingAndShrinkingUndoEachOther() {
        BrushSettings settings;
        settings.radiusPixels = 80.0f;
        settings.strength = 1.0f;
        const StrokeView view = viewOf(hairyBall());
        const std::vector<glm::vec2> path{{350.0f, 300.0f}, {400.0f, 300.0f}};
        const Groom longer = stroked("grow", hairyBall(), view, settings, path);
        int grown = 0;
        for (std::size_t i = 0; i < longer.guides.count(); ++i) {
            const float before = curveLength(hairyBall().guides.points(i)), now = curveLength(longer.guides.points(i));
            QVERIFY(now >= before * 0.999f);
            if (now > before * 1.05f) ++grown;
        }
        QVERIFY2(grown > 10, qPrintable(QString::number(grown)));
        settings.invert = true;
        const Groom shorter = stroked("grow", hairyBall(), view, settings, path);
        for (std::size_t i = 0; i < shorter.guides.count(); ++i) {
            const float product = curveLength(shorter.guides.points(i)) * curveLength(longer.guides.points(i));
            const float squared = curveLength(hairyBall().guides.points(i)) * curveLength(hairyBall().guides.points(i));
            QVERIFY(std::abs(product / squared - 1.0f) < 0.02f);
        }
    }

    void puffStandsHairUp() {
        BrushSettings settings;
        settings.strength = 1.0f;
        const StrokeView view = viewOf(hairyBall());
        const Groom combed = stroked("comb", hairyBall(), view, settings, {{250.0f, 300.0f}, {550.0f, 300.0f}});
        const auto upright = [](const Groom& groom) {
            double sum = 0.0;
            for (std::size_t i = 0; i < groom.guides.count(); ++i) {
                const auto p = groom.guides.points(i);
                sum += static_cast<double>(glm::dot(glm::normalize(p.back() - p.front()), glm::normalize(p.front())));
            }
            return sum;
        };
        std::vector<glm::vec2> path;
        for (int i = 0; i < 20; ++i) path.push_back({250.0f + 300.0f * static_cast<float>(i % 2), 300.0f});
        const Groom puffed = stroked("puff", combed, view, settings, path);
        QVERIFY(upright(puffed) > upright(combed) + 5.0);
        QVERIFY(lengthError(combed.guides, puffed.guides) < 1e-5f);
        settings.invert = true;
        QVERIFY(upright(stroked("puff", combed, view, settings, path)) < upright(combed));
    }

    void placeSetsGuidesARadiusApart() {
        Groom groom = hairyBall();
        groom.guides.clear();
        BrushSettings settings;
        settings.radiusPixels = 20.0f;
        const StrokeView view = viewOf(groom);
        QCOMPARE(stroked("place", groom, view, settings, {{400.0f, 300.0f}}).guides.count(), std::size_t{1});
        const Groom after = stroked("place", groom, view, settings, {{330.0f, 300.0f}, {470.0f, 300.0f}});
        QVERIFY(after.guides.count() >= 6 && after.guides.count() <= 8);
        const float spacing = 20.0f * view.metresPerPixel({0.0f, 0.0f, 0.1f}) * 0.95f;
        for (std::size_t i = 0; i < after.guides.count(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                QVERIFY(glm::length(after.guides.points(i)[0] - after.guides.points(k)[0]) > spacing);
            }
        }
        // Parts that grow no hair take no guides.
        Groom bald = groom;
        bald.partSettings.edit()[0].growsHair = false;
        QVERIFY(stroked("place", bald, view, settings, {{400.0f, 300.0f}}).guides.empty());
    }

    void newGuidesTakeAfterTheirNeighbours() {
        BrushSettings settings;
        settings.strength = 1.0f;
        settings.radiusPixels = 150.0f;
        const StrokeView view = viewOf(hairyBall());
        Groom combed = stroked("comb", hairyBall(), view, settings, {{250.0f, 300.0f}, {550.0f, 300.0f}});
        settings.radiusPixels = 2.0f;
        const Groom after = stroked("place", combed, view, settings, {{405.0f, 304.0f}});
        QCOMPARE(after.guides.count(), combed.guides.count() + 1);
        const auto points = after.guides.points(after.guides.count() - 1);
        QCOMPARE(points.size(), std::size_t{16});
        QVERIFY(points.back().x - points.front().x > 0.02f);  // combed to the right like the others
    }

    void viewMathsAgrees() {
        const StrokeView view = viewOf(hairyBall(), 0.7f, 0.4f);
        for (std::uint32_t i = 0; i < 100; ++i) {
            const glm::vec3 p =
                (glm::vec3(randomFloat(3, i, 0), randomFloat(3, i, 1), randomFloat(3, i, 2)) - 0.5f) * 0.2f;
            const auto pixel = view.pixelFromGroom(p);
            QVERIFY(pixel.has_value());
            const glm::vec3 origin = view.rayOrigin(*pixel), direction = view.rayDirection(*pixel);
            const glm::vec3 back = origin + direction * glm::dot(p - origin, direction);
            QVERIFY(glm::length(back - p) < 1e-5f);
            // A pixel to the right is metresPerPixel away, at the same depth.
            const ScreenFrame frame(view);
            const glm::vec3 moved = p + frame.movement({3.0f, -2.0f}, frame.depth(p));
            QVERIFY(glm::length(*view.pixelFromGroom(moved) - *pixel - glm::vec2(3.0f, -2.0f)) < 2e-2f);
            QVERIFY(std::abs(glm::length(frame.movement({1.0f, 0.0f}, frame.depth(p))) - view.metresPerPixel(p)) <
                    1e-7f);
        }
        QVERIFY(!view.pixelFromGroom(view.eyeGroom * 2.0f).has_value());
    }

    void viewsByName() {
        const Bounds bounds = boundsOf(*hairyBall().mesh);
        QVERIFY(namedOrbitView("front", bounds, {800.0f, 600.0f})->eyeGroom.z > 0.1f);
        QVERIFY(namedOrbitView("left", bounds, {800.0f, 600.0f})->eyeGroom.x > 0.1f);
        QVERIFY(namedOrbitView("90,0", bounds, {800.0f, 600.0f})->eyeGroom.x > 0.1f);
        for (const char* bad : {"", "up", "1", "1,", ",1", "1,2,3", "nan,0", "0,91"}) {
            QVERIFY2(!namedOrbitView(bad, bounds, {800.0f, 600.0f}).ok(), bad);
        }
    }
};

QTEST_APPLESS_MAIN(CombTest)
#include "comb_test.moc"
