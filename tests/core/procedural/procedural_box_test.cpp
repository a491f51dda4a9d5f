// SPDX-License-Identifier: Apache-2.0
// Laws of the boxes that a renderer asks for: around all that it draws, at any shutter and level of detail, and tight.
#include "core/hair/curve.h"
#include "core/surface/surface_point.h"
#include "tests/core/procedural/procedural_hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>

using namespace whorl;
using namespace whorl::testing;

namespace {

/// Long thick hair that moves, bent so that its curves swing beyond their vertices.
Groom swinging(bool strands, float skip) {
    Groom groom = groomOn(sphere(16, 24), 60, 5, 0.08f);
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) points[v].y += v % 2 == 0 ? 0.03f : -0.03f;
    }
    groom.counts.edit().hairs = 300;
    HairParams& params = groom.groups.edit()[0].params;
    params.general.segments = 5;
    params.general.keepOutside = false;
    params.general.rootThickness.value = 0.001f;
    params.general.tipThickness.value = 0.004f;
    params.general.skipThreshold = skip;
    params.frizz.tip.value = 0.05f;
    params.frizz.animation.value = 1.0f;
    params.frizz.speed.value = 2.0f;
    params.strands.hairs = strands ? 3 : 0;
    params.strands.tipSplay.value = 0.01f;
    return groom;
}

/// Box of the balls that a renderer sweeps along every curve, looked at in many places, between every two times.
Bounds drawn(const Filled& hair, std::size_t samples) {
    constexpr std::size_t steps = 40, between = 6;
    Bounds box;
    const std::size_t vertices = hair.widths.size();
    const auto place = [&](std::size_t sample, std::size_t v) {
        const float* p = &hair.positions[3 * (sample * vertices + v)];
        return glm::vec3(p[0], p[1], p[2]);
    };
    std::vector<glm::vec3> points;
    for (std::size_t i = 0, first = 0; i < hair.counts.size(); first += hair.counts[i++]) {
        const std::size_t count = hair.counts[i];
        for (std::size_t s = 0; s + 1 < std::max<std::size_t>(samples, 2); ++s) {
            for (std::size_t moment = 0; moment <= between; ++moment) {
                const float t = static_cast<float>(moment) / static_cast<float>(between);
                points.clear();
                for (std::size_t v = first; v < first + count; ++v)
                    points.push_back(samples > 1 ? glm::mix(place(s, v), place(s + 1, v), t) : place(0, v));
                for (std::size_t step = 0; step <= (count - 1) * steps; ++step) {
                    const float at = static_cast<float>(step) / static_cast<float>(steps);
                    const std::size_t piece = std::min(step / steps, count - 2);
                    const float radius = 0.5f * glm::mix(hair.widths[first + piece], hair.widths[first + piece + 1],
                                                         at - static_cast<float>(piece));
                    const glm::vec3 p = strandPoint(points, at);
                    box.add(p - glm::vec3(radius));
                    box.add(p + glm::vec3(radius));
                }
            }
        }
    }
    return box;
}

}  // namespace

class ProceduralBoxTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void boxesHoldWhatIsDrawnAndTouchIt_data() {
        QTest::addColumn<int>("times");
        QTest::addColumn<float>("share");
        QTest::addColumn<bool>("strands");
        QTest::addColumn<float>("skip");
        for (const int times : {1, 2, 4})
            for (const float share : {1.0f, 0.2f})
                QTest::addRow("%d times, share %g", times, double{share}) << times << share << (share < 1.0f) << 0.0f;
        QTest::newRow("skipped vertices") << 3 << 1.0f << true << 0.05f;
    }
    void boxesHoldWhatIsDrawnAndTouchIt() {
        QFETCH(int, times);
        QFETCH(float, share);
        QFETCH(bool, strands);
        QFETCH(float, skip);
        const Opened opened(exported(swinging(strands, skip), scratchFolder("procedural-box") / "a.groom", 3));
        QVERIFY2(opened, opened.error.text);
        const float moments[] = {0.1f, 0.16f, 0.2f, 0.31f};
        WhorlRequest request = WHORL_REQUEST_INIT;
        request.times = moments;
        request.time_count = static_cast<std::uint32_t>(times);
        request.share = share;
        for (request.part = 0; request.part < 3; ++request.part) {
            const Filled hair = fill(opened, request);
            QVERIFY2(hair.status == WHORL_OK && hair.ids.size() > 10, hair.error.text);
            float box[6];
            QCOMPARE(whorl_box(opened, &request, box, nullptr), WHORL_OK);
            const Bounds inside = drawn(hair, static_cast<std::size_t>(times));
            for (int axis = 0; axis < 3; ++axis) {
                const float low = box[2 * axis], high = box[2 * axis + 1], slack = 0.01f * (high - low);
                QVERIFY(inside.min[axis] >= low && inside.max[axis] <= high);
                QVERIFY2(inside.min[axis] <= low + slack && inside.max[axis] >= high - slack,
                         qPrintable(QString("%1: %2 to %3 in %4 to %5")
                                        .arg(axis)
                                        .arg(double{inside.min[axis]})
                                        .arg(double{inside.max[axis]})
                                        .arg(double{low})
                                        .arg(double{high})));
            }
        }
    }

    // Parts are pieces of the surface that a renderer may have or leave: about as round as pieces of that area can be.
    void partsAreCompact() {
        Groom groom = groomOn(sphere(40, 60), 200, 4, 0.001f);
        groom.counts.edit().hairs = 20000;
        groom.groups.edit()[0].params.general.segments = 2;
        const Opened opened(exported(groom, scratchFolder("procedural-compact") / "a.groom", 1));
        for (const std::uint32_t parts : {4u, 16u, 64u}) {
            // Of a disc of a part's area, places are two thirds of its radius from its middle on average.
            const double area = 4.0 * std::numbers::pi * 0.01 / parts;
            const double round = 2.0 / 3.0 * std::sqrt(area / std::numbers::pi);
            double sum = 0.0;
            std::uint32_t torn = 0;
            WhorlRequest request = WHORL_REQUEST_INIT;
            request.part_count = parts;
            for (request.part = 0; request.part < parts; ++request.part) {
                const Filled hair = fill(opened, request);
                std::vector<glm::dvec3> roots;
                for (std::size_t i = 0, at = 0; i < hair.counts.size(); at += hair.counts[i++])
                    roots.emplace_back(hair.positions[3 * at], hair.positions[3 * at + 1], hair.positions[3 * at + 2]);
                QVERIFY(roots.size() > 10000 / parts);
                glm::dvec3 middle(0.0);
                for (const glm::dvec3& root : roots) middle += root / static_cast<double>(roots.size());
                double away = 0.0;
                for (const glm::dvec3& root : roots)
                    away += glm::distance(root, middle) / static_cast<double>(roots.size());
                sum += away / parts;
                torn += away > 2.5 * round;
            }
            // The curve in space that orders the surface leaves it now and then: a part may lie in two places, few do.
            QVERIFY2(sum < 1.4 * round, qPrintable(QString("%1: %2 of %3").arg(parts).arg(sum).arg(round)));
            QVERIFY2(torn <= parts / 20, qPrintable(QString("%1 of %2").arg(torn).arg(parts)));
        }
    }
};

QTEST_APPLESS_MAIN(ProceduralBoxTest)
#include "procedural_box_test.moc"
