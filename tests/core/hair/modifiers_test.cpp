// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"
#include "core/base/simd.h"
#include "core/commands/modifier_edits.h"
#include "core/hair/curve.h"
#include "core/hair/generate.h"
#include "core/hair/modifiers/chain.h"
#include "core/hair/reference.h"
#include "core/model/modifiers/rows.h"
#include "core/param/path.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <cmath>

using namespace whorl;

namespace {

// Bent guides on a ball.
Groom bentGroom(int segments = 16) {
    Groom groom = testing::groomOn(testing::sphere(20, 40), 200, segments, 0.08f);
    groom.groups.edit()[0].params.general.segments = segments;
    groom.groups.edit()[0].params.general.keepOutside = false;
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size() - 1);
            points[v] += glm::vec3(0.01f * std::sin(7.0f * along + static_cast<float>(g)), -0.05f * along * along, 0);
        }
    }
    return groom;
}

Groom with(Groom groom, std::string_view kind, const std::vector<std::pair<std::string, ParamValue>>& values = {}) {
    const Result<int> place = addModifier(groom, 0, kind);
    if (!place) qFatal("%s", place.error().message.c_str());
    const std::string name = (*groom.groups)[0].params.modifiers.back().name;
    for (const auto& [id, value] : values) {
        const Result<void> set = setGroomValue(groom, "groups/hair/modifiers/" + name + "/" + id, value);
        if (!set) qFatal("%s", set.error().message.c_str());
    }
    return groom;
}

Strands grown(const Groom& groom, std::uint32_t count = 600) {
    return testing::grown(groom, {count});
}

std::span<const glm::vec3> pointsOf(const Strands& strands, std::size_t i) {
    return {&strands.positions[strands.firstVertex[i]], strands.firstVertex[i + 1] - strands.firstVertex[i]};
}

float lengthOf(std::span<const glm::vec3> points) {
    float length = 0;
    for (std::size_t v = 1; v < points.size(); ++v) length += glm::distance(points[v - 1], points[v]);
    return length;
}

// How much the directions of neighbouring pieces differ, summed.
float bentness(std::span<const glm::vec3> points) {
    float sum = 0;
    for (std::size_t v = 2; v < points.size(); ++v) {
        const glm::vec3 a = glm::normalize(points[v - 1] - points[v - 2]),
                        b = glm::normalize(points[v] - points[v - 1]);
        sum += std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
    }
    return sum;
}

void compareWithReference(const Groom& groom, float tolerance = 1e-5f) {
    Progress progress;
    const Strands fast = grown(groom, 300);
    const Result<Strands> slow =
        generateReference(groom, std::make_shared<const Surface>(groom.mesh), {300u}, progress);
    QVERIFY(slow && fast.count() > 100);
    QCOMPARE(fast.ids, slow->ids);
    QCOMPARE(fast.firstVertex, slow->firstVertex);
    for (std::size_t i = 0; i < fast.count(); ++i) {
        const auto a = pointsOf(fast, i), b = pointsOf(*slow, i);
        for (std::size_t v = 0; v < a.size(); ++v) {
            const float apart = glm::distance(a[v], b[v]);
            QVERIFY2(apart <= tolerance * lengthOf(b) + 2e-7f,
                     qPrintable(QString("hair %1 vertex %2: %3").arg(i).arg(v).arg(static_cast<double>(apart))));
            const std::size_t at = fast.firstVertex[i] + v;
            QVERIFY(std::abs(fast.widths[at] - slow->widths[at]) < 1e-7f);
        }
    }
}

std::vector<std::string_view> kindIds() {
    std::vector<std::string_view> ids;
    for (const BlockInfo& info : modifierKinds()) ids.push_back(info.id);
    return ids;
}

}  // namespace

class ModifiersTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void rowsAreThoseOfTheParameters() {
        const std::size_t counts[modifierKindCount] = {ClumpRows::count,      CurlRows::count,   NoiseRows::count,
                                                       BendRows::count,       LengthRows::count, SmoothRows::count,
                                                       StraightenRows::count, TaperRows::count};
        const auto row = [](std::size_t kind, std::string_view id) {
            Modifier modifier;
            modifier.params = defaultModifierParams(kind);
            std::size_t at = 0;
            for (const ParamRef& ref : paramsOf(modifier)) {
                if (ref.info.id == id) return at;
                at += std::holds_alternative<DrivenVector*>(ref.target) || std::holds_alternative<Vector*>(ref.target)
                          ? 3
                          : 1;
            }
            return at;
        };
        for (std::size_t kind = 0; kind < modifierKindCount; ++kind) {
            QCOMPARE(row(kind, ""), counts[kind]);
            QCOMPARE(row(kind, "amount"), std::size_t{1});
            // Values arrive in their rows.
            const Groom groom = with(bentGroom(), kindIds()[kind]);
            const ModifierChain chain(groom);
            const auto steps = kindIds()[kind] == "taper" ? chain.looks(0) : chain.shapes(0);
            QCOMPARE(steps.size(), std::size_t{1});
            QCOMPARE(steps[0].numbers.size(), counts[kind]);
        }
        const auto at = [&](std::string_view kind, std::string_view id) { return row(*modifierKind(kind), id); };
        QCOMPARE(at("clump", "tightness"), std::size_t{ClumpRows::Tightness});
        QCOMPARE(at("clump", "profile"), std::size_t{ClumpRows::Profile});
        QCOMPARE(at("clump", "noise"), std::size_t{ClumpRows::NoiseAmplitude});
        QCOMPARE(at("clump", "keep_length"), std::size_t{ClumpRows::KeepLength});
        QCOMPARE(at("clump", "seed"), std::size_t{ClumpRows::Seed});
        QCOMPARE(at("curl", "turns"), std::size_t{CurlRows::Turns});
        QCOMPARE(at("curl", "shared"), std::size_t{CurlRows::Shared});
        QCOMPARE(at("curl", "seed"), std::size_t{CurlRows::Seed});
        QCOMPARE(at("noise", "frequency"), std::size_t{NoiseRows::Frequency});
        QCOMPARE(at("noise", "correlation"), std::size_t{NoiseRows::Correlation});
        QCOMPARE(at("noise", "seed"), std::size_t{NoiseRows::Seed});
        QCOMPARE(at("bend", "strength"), std::size_t{BendRows::Strength});
        QCOMPARE(at("bend", "reference_length"), std::size_t{BendRows::ReferenceLength});
        QCOMPARE(at("length", "method"), std::size_t{LengthRows::Method});
        QCOMPARE(at("length", "seed"), std::size_t{LengthRows::Seed});
        QCOMPARE(at("smooth", "iterations"), std::size_t{SmoothRows::Iterations});
        QCOMPARE(at("straighten", "keep_length"), std::size_t{StraightenRows::KeepLength});
        QCOMPARE(at("taper", "profile"), std::size_t{TaperRows::Profile});
    }

    void eachEqualsTheReference() {
        for (const std::string_view kind : kindIds()) compareWithReference(with(bentGroom(), kind));
        compareWithReference(with(bentGroom(), "clump", {{"centres", std::string("Guides")}, {"noise", 0.01}}));
        compareWithReference(with(bentGroom(), "clump", {{"count", 40.0}, {"noise", 0.005}, {"keep_length", false}}));
        compareWithReference(with(bentGroom(), "curl", {{"flips", 0.5}, {"phase", 1.0}, {"turns", 9.0}}));
        compareWithReference(with(bentGroom(), "noise", {{"correlation", 0.3}, {"octaves", 3.0}}), 3e-5f);
        compareWithReference(with(bentGroom(), "bend", {{"by_length", 1.0}, {"by_thickness", 1.0}, {"strength", 3.0}}));
        compareWithReference(with(bentGroom(), "length", {{"mode", std::string("A length")}, {"length", 0.03}}));
        compareWithReference(
            with(bentGroom(), "length", {{"method", std::string("Cut the end")}, {"random", 0.6}, {"factor", 0.9}}));
        compareWithReference(with(bentGroom(), "straighten", {{"keep_length", false}, {"root", 0.2}}));
    }

    void allTogetherEqualTheReference() {
        Groom groom = bentGroom(20);
        groom = with(groom, "clump", {{"count", 60.0}});
        groom = with(groom, "clump", {{"count", 15.0}, {"tightness", 0.5}, {"seed", 3.0}});
        groom = with(groom, "curl", {{"flips", 0.5}});
        groom = with(groom, "bend");
        groom = with(groom, "smooth");
        groom = with(groom, "straighten", {{"amount", 0.3}});
        groom = with(groom, "length", {{"random", 0.4}});
        groom = with(groom, "noise", {{"tip_amplitude", 0.004}});
        groom = with(groom, "taper");
        groom.groups.edit()[0].params.frizz.tip.value = 0.01f;
        groom.groups.edit()[0].params.kink.tip.value = 0.002f;
        groom.groups.edit()[0].params.strands.hairs = 3;
        groom.groups.edit()[0].params.strands.twist.value = 5.0f;
        groom.groups.edit()[0].params.general.cut.value = 0.77f;
        compareWithReference(groom, 4e-5f);
        groom.groups.edit()[0].params.general.keepOutside = true;
        compareWithReference(groom, 1e-4f);
    }

    void theBytesAreTheSameOnEveryLevelThreadCountAndSplit() {
        Groom groom = bentGroom();
        for (const std::string_view kind : kindIds()) groom = with(groom, kind);
        groom.groups.edit()[0].params.strands.hairs = 2;
        Progress progress;
        const std::uint64_t expected = *hairDigest(groom, 1, 1000, progress);
        for (const std::uint32_t parts : {3u, 8u}) QCOMPARE(*hairDigest(groom, parts, 1000, progress), expected);
        for (const SimdLevel level : {SimdLevel::Plain, SimdLevel::Avx2, SimdLevel::Avx512}) {
            setSimdLevel(level);
            QCOMPARE(*hairDigest(groom, 1, 1000, progress), expected);
        }
        setSimdLevel(bestSimdLevel());
        const ThreadLimit limit(1);
        QCOMPARE(*hairDigest(groom, 1, 1000, progress), expected);
    }

    void nothingAskedNothingChanged() {
        const Groom groom = bentGroom();
        const std::uint64_t expected = testing::digestOf(grown(groom));
        for (const std::string_view kind : kindIds()) {
            QVERIFY2(testing::digestOf(grown(with(groom, kind))) != expected, std::string(kind).c_str());
            QCOMPARE(testing::digestOf(grown(with(groom, kind, {{"amount", 0.0}}))), expected);
            QCOMPARE(testing::digestOf(grown(with(groom, kind, {{"on", false}}))), expected);
            Groom black = with(groom, kind);
            black.maps.set("black", Map(4, 4, 1, TexelFormat::U8, 0.0f));
            const std::string path = "groups/hair/modifiers/" + std::string(kind) + "/amount/map";
            QVERIFY(setGroomValue(black, path, std::string("black")));
            QCOMPARE(testing::digestOf(grown(black)), expected);
        }
    }

    void aMapSaysWhere() {
        // Half black, half white: hairs of the black half keep their bytes although they share lanes with others.
        const Groom groom = bentGroom();
        Map halves(64, 64, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 64; ++y)
            for (int x = 32; x < 64; ++x) halves.setTexel(x, y, 0, 1.0f);
        const Strands before = grown(groom);
        for (const std::string_view kind : kindIds()) {
            Groom half = with(groom, kind);
            half.maps.set("halves", halves);
            QVERIFY(setGroomValue(half, "groups/hair/modifiers/" + std::string(kind) + "/amount/map",
                                  std::string("halves")));
            const Strands after = grown(half);
            QCOMPARE(after.ids, before.ids);
            std::size_t kept = 0, moved = 0;
            for (std::size_t i = 0; i < after.count(); ++i) {
                bool same = true;
                for (std::uint32_t v = after.firstVertex[i]; v < after.firstVertex[i + 1]; ++v)
                    same = same && after.positions[v] == before.positions[v] && after.widths[v] == before.widths[v];
                const float u = after.rootUvs[i].x - std::floor(after.rootUvs[i].x);
                if (u < 0.48f && u > 0.02f) QVERIFY2(same, std::string(kind).c_str());
                ++(same ? kept : moved);
            }
            QVERIFY(kept > 100 && moved > 100);
        }
    }

    void rootsStayAndLengthsAreKeptWherePromised() {
        const Strands before = grown(bentGroom());
        for (const std::string_view kind : kindIds()) {
            const Strands after = grown(with(bentGroom(), kind));
            QCOMPARE(after.ids, before.ids);
            for (std::size_t i = 0; i < after.count(); ++i) {
                const auto a = pointsOf(after, i), b = pointsOf(before, i);
                QCOMPARE(a[0], b[0]);
                if (kind == "length") continue;
                for (std::size_t v = 1; v < a.size(); ++v) {
                    const float was = glm::distance(b[v - 1], b[v]), is = glm::distance(a[v - 1], a[v]);
                    QVERIFY2(std::abs(was - is) < 1e-4f * was + 1e-7f, std::string(kind).c_str());
                }
            }
        }
    }

    void theOrderMatters() {
        const Groom groom = bentGroom();
        Groom one = with(with(groom, "clump", {{"count", 30.0}}), "curl");
        Groom other = one;
        QVERIFY(moveModifier(other, 0, "curl", 0));
        QVERIFY(testing::digestOf(grown(one)) != testing::digestOf(grown(other)));
    }

    void clumpsGather() {
        const auto spread = [](const Groom& groom) {
            const Strands strands = grown(groom, 2000);
            // Mean distance of tips from the nearest tip of another hair.
            double sum = 0;
            for (std::size_t i = 0; i < strands.count(); i += 7) {
                float nearest = 1e30f;
                for (std::size_t j = 0; j < strands.count(); ++j)
                    if (i != j)
                        nearest =
                            std::min(nearest, glm::distance(pointsOf(strands, i).back(), pointsOf(strands, j).back()));
                sum += double{nearest};
            }
            return sum;
        };
        const Groom groom = bentGroom();
        const double loose = spread(groom),
                     tight =
                         spread(with(groom, "clump",
                                     {{"count", 60.0}, {"tightness", 1.0}, {"flyaways", 0.0}, {"keep_length", false}}));
        QVERIFY2(tight < 0.1 * loose, qPrintable(QString("%1 against %2").arg(tight).arg(loose)));
    }

    void moreLocksLeaveTheOnesThere() {
        // The hairs of a lock that no new centre comes near go on as they were.
        const Groom few = with(bentGroom(), "clump", {{"count", 40.0}}),
                    more = with(bentGroom(), "clump", {{"count", 44.0}});
        const Strands a = grown(few), b = grown(more);
        std::size_t same = 0;
        for (std::size_t i = 0; i < a.count(); ++i) same += pointsOf(a, i).back() == pointsOf(b, i).back();
        QVERIFY2(same > a.count() * 3 / 4 && same < a.count(), qPrintable(QString::number(same)));
    }

    void curlsWindAndStraightenUnwinds() {
        const Groom curled =
            with(bentGroom(40), "curl", {{"turns", 5.0}, {"root_radius", 0.004}, {"tip_radius", 0.004}});
        const Strands plain = grown(bentGroom(40)), wound = grown(curled), straight = grown(with(curled, "straighten"));
        for (std::size_t i = 0; i < plain.count(); i += 5) {
            QVERIFY(bentness(pointsOf(wound, i)) > 5.0f + bentness(pointsOf(plain, i)));
            QVERIFY(bentness(pointsOf(straight, i)) < 0.01f);
        }
        const Strands smooth = grown(with(curled, "smooth", {{"strength", 1.0}, {"iterations", 30.0}}));
        for (std::size_t i = 0; i < plain.count(); i += 5)
            QVERIFY(bentness(pointsOf(smooth, i)) < 0.8f * bentness(pointsOf(wound, i)));
    }

    void gravityPullsDown() {
        const Strands before = grown(bentGroom()), after = grown(with(bentGroom(), "bend", {{"strength", 2.0}}));
        for (std::size_t i = 0; i < before.count(); ++i)
            QVERIFY(pointsOf(after, i).back().y <= pointsOf(before, i).back().y + 1e-5f);
        // Stiff hair bends less.
        const Strands stiff = grown(with(bentGroom(), "bend", {{"strength", 2.0}, {"stiffness", 0.9}}));
        double soft = 0, hard = 0;
        for (std::size_t i = 0; i < before.count(); ++i) {
            soft += double{glm::distance(pointsOf(after, i).back(), pointsOf(before, i).back())};
            hard += double{glm::distance(pointsOf(stiff, i).back(), pointsOf(before, i).back())};
        }
        QVERIFY(hard < 0.5 * soft);
    }

    void lengthsBecomeWhatIsAsked() {
        const Strands before = grown(bentGroom());
        const auto set = [](std::vector<std::pair<std::string, ParamValue>> values) {
            return grown(with(bentGroom(), "length", values));
        };
        const std::string length = "A length", cut = "Cut the end";
        const Strands half = set({{"factor", 0.5}}), fixed = set({{"mode", length}, {"length", 0.2}}),
                      trimmed = set({{"mode", length}, {"length", 0.04}, {"method", cut}}),
                      longer = set({{"factor", 3.0}, {"method", cut}});
        for (std::size_t i = 0; i < before.count(); ++i) {
            const float was = lengthOf(pointsOf(before, i));
            QVERIFY(std::abs(lengthOf(pointsOf(half, i)) - 0.5f * was) < 1e-5f);
            QVERIFY(std::abs(lengthOf(pointsOf(fixed, i)) - 0.2f) < 1e-5f);
            const float cutLength = lengthOf(pointsOf(trimmed, i));
            QVERIFY2(std::abs(cutLength - 0.04f) < 8e-4f, qPrintable(QString::number(static_cast<double>(cutLength))));
            QVERIFY(std::ranges::equal(pointsOf(longer, i), pointsOf(before, i)));
            // Cut hair lies on the old curve.
            float nearest = 1e30f;
            for (int k = 0; k <= 1600; ++k) {
                const glm::vec3 there = strandPoint(pointsOf(before, i), static_cast<float>(k) * 0.01f);
                nearest = std::min(nearest, glm::distance(pointsOf(trimmed, i).back(), there));
            }
            QVERIFY(nearest < 1e-4f);
        }
    }

    void tapersChangeWidthsOnly() {
        const Strands before = grown(bentGroom()), after = grown(with(bentGroom(), "taper", {{"tip", 0.5}}));
        QVERIFY(after.positions == before.positions && after.colours == before.colours);
        for (std::size_t i = 0; i < before.count(); ++i) {
            const std::uint32_t root = before.firstVertex[i], tip = before.firstVertex[i + 1] - 1;
            QCOMPARE(after.widths[root], before.widths[root]);
            QVERIFY(std::abs(after.widths[tip] - 0.5f * before.widths[tip]) < 1e-9f);
        }
    }
};

QTEST_APPLESS_MAIN(ModifiersTest)
#include "modifiers_test.moc"
