// SPDX-License-Identifier: Apache-2.0
// Law: every number with a map is multiplied by its own map at the root of each hair, and by no other.
#include "core/base/random.h"
#include "core/commands/modifier_edits.h"
#include "core/hair/generate.h"
#include "core/hair/reference.h"
#include "core/param/path.h"
#include "tests/support/hair.h"
#include "tests/support/shapes.h"

#include <glm/geometric.hpp>

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <functional>

using namespace whorl;

namespace {

constexpr float lefts = 1.0f, rights = 0.25f;
constexpr double allOn = 0.45;  // share of the way from 0 to where a slider ends

/// The paths of all numbers, vectors and colours of the first group that a map may drive.
std::vector<std::string> drivenPaths(const Groom& groom) {
    std::vector<std::string> driven;
    for (const std::string& path : groomPaths(groom)) {
        Groom tried = groom;
        if (path.starts_with("groups/") && setGroomValue(tried, path + "/map", std::string("ones")).ok())
            driven.push_back(path);
    }
    return driven;
}

/// Bent guides on a plane, and every stage of the chain at work, with numbers that each leave a trace.
Groom everything() {
    Groom groom = testing::groomOn(testing::plane(16, 0.3f), 150, 12, 0.05f);
    for (std::size_t g = 0; g < groom.guides.count(); ++g) {
        const std::span<glm::vec3> points = groom.guides.editPoints(g);
        for (std::size_t v = 1; v < points.size(); ++v) {
            const float along = static_cast<float>(v) / static_cast<float>(points.size() - 1);
            points[v] += along * along * glm::vec3(0.02f * std::sin(static_cast<float>(g)), -0.01f, 0.015f);
        }
    }
    groom.counts.edit().hairs = 500;
    groom.maps.set("ones", Map(8, 8, 1, TexelFormat::F32, 1.0f));
    // White on the left half, darker on the right.
    Map halves(64, 64, 1, TexelFormat::F32, lefts);
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x) halves.setTexel(x, y, 0, rights);
    groom.maps.set("halves", halves);
    for (const BlockInfo& kind : modifierKinds()) static_cast<void>(addModifier(groom, 0, kind.id));
    HairParams& params = groom.groups.edit()[0].params;
    const auto set = [](const ParamRef& ref) {
        const double top = ref.info.softMax > 0.0 ? ref.info.softMax : ref.info.max;
        const auto value = static_cast<float>(allOn * top);
        if (const auto* number = std::get_if<Driven*>(&ref.target)) (*number)->value = value;
        if (const auto* vector = std::get_if<DrivenVector*>(&ref.target)) (*vector)->value = glm::vec3(value);
        if (const auto* colour = std::get_if<DrivenColour*>(&ref.target)) (*colour)->value = {0.2f, 0.5f, 0.7f};
    };
    HairParams::eachWithModifiers(params, [&](const BlockInfo&, auto& block) {
        for (const ParamRef& ref : paramsOf(block)) set(ref);
    });
    // Small locks, and ends that differ.
    const auto number = [&](const char* path, double value) {
        if (!setGroomValue(groom, std::string("groups/hair/modifiers/") + path, value)) qFatal("%s", path);
    };
    number("clump/count", 3000.0);
    number("clump/root_tightness", 0.1);
    number("taper/root", 1.0);
    params.general.segments = 12;
    params.general.keepOutside = false;
    params.general.cut.value = 0.8f;
    params.strands.hairs = 3;
    // By thickness says something only where a map makes hair thinner.
    groom.maps.set("thin", Map(8, 8, 1, TexelFormat::F32, 0.5f));
    params.general.rootThickness.map = "thin";
    return groom;
}

/// The number itself times a share, without a map.
Groom times(Groom groom, const std::string& path, float share) {
    const ParamValue value = *groomValue(groom, path);
    if (const auto* number = std::get_if<double>(&value)) {
        if (!setGroomValue(groom, path, *number * static_cast<double>(share))) qFatal("%s", path.c_str());
    } else if (const auto* vector = std::get_if<glm::vec3>(&value)) {
        if (!setGroomValue(groom, path, *vector * share)) qFatal("%s", path.c_str());
    } else {
        qFatal("%s is neither", path.c_str());
    }
    return groom;
}

Groom drivenBy(Groom groom, const std::string& path, const std::string& map) {
    if (!setGroomValue(groom, path + "/map", map)) qFatal("%s", path.c_str());
    return groom;
}

Strands grown(const Groom& groom) {
    GenerateOptions options;
    options.time = 0.7f;
    return testing::grown(groom, options);
}

}  // namespace

class DrivenTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyNumberHearsItsOwnMap_data() {
        QTest::addColumn<QString>("path");
        const std::vector<std::string> paths = drivenPaths(everything());
        // The table of the seed and the modifiers.
        QVERIFY(paths.size() > 60);
        for (const std::string& path : paths) QTest::newRow(path.c_str()) << QString::fromStdString(path);
    }
    void everyNumberHearsItsOwnMap() {
        QFETCH(QString, path);
        const std::string name = path.toStdString();
        Groom groom = everything();
        if (name.ends_with("root_thickness")) {
            // Gravity compares the thickness that the map gives with the group's own.
            QVERIFY(setGroomValue(groom, "groups/hair/modifiers/bend/by_thickness", 0.0).ok());
            groom.groups.edit()[0].params.general.rootThickness.map.clear();
        }
        if (name.ends_with("length/length")) {
            const ParamValue ofItsOwn = std::string("A length");
            QVERIFY(setGroomValue(groom, "groups/hair/modifiers/length/mode", ofItsOwn).ok());
        }
        // A map of which the left half is white and the right a quarter: hair on the left is that of the number alone,
        // hair on the right that of a quarter of it.
        const Strands both = grown(drivenBy(groom, name, "halves")), left = grown(groom),
                      right = grown(times(groom, name, rights));
        QVERIFY(both.count() > 600);
        if (name.ends_with("general/density")) {
            // Asked for less often on the right; the hairs that grow are as they were.
            std::size_t lefts = 0, rights = 0;
            for (const glm::vec2& uv : both.rootUvs) ++(uv.x < 0.5f ? lefts : rights);
            QVERIFY2(std::abs(static_cast<double>(lefts) / static_cast<double>(rights) - 4.0) < 0.6,
                     qPrintable(QString("%1 and %2").arg(lefts).arg(rights)));
            return;
        }
        QCOMPARE(both.ids, left.ids);
        QCOMPARE(both.ids, right.ids);
        std::size_t leftHairs = 0, rightHairs = 0, differ = 0;
        for (std::size_t i = 0; i < both.count(); ++i) {
            differ += !testing::sameHair(left, i, right, i);
            // Hairs next to the line may belong to a lock beyond it.
            const float u = both.rootUvs[i].x;
            if (u > 0.05f && u < 0.35f) {
                ++leftHairs;
                QVERIFY2(testing::sameHair(both, i, left, i), qPrintable(QString("hair %1 at %2").arg(i).arg(u)));
            } else if (u > 0.65f && u < 0.95f) {
                ++rightHairs;
                QVERIFY2(testing::sameHair(both, i, right, i), qPrintable(QString("hair %1 at %2").arg(i).arg(u)));
            }
        }
        QVERIFY(leftHairs > 150 && rightHairs > 150);
        // And the number matters.
        QVERIFY2(differ > both.count() / 20, qPrintable(QString("%1 of %2 differ").arg(differ).arg(both.count())));
    }

    // What the maps of the fast chain say is what those of the plain one say: all of them at once, each another one.
    void allMapsAtOnceAreThoseOfTheReference() {
        Groom groom = everything();
        std::uint32_t number = 0;
        for (const std::string& path : drivenPaths(groom)) {
            ++number;
            Map map(9, 7, 1, TexelFormat::F32, 1.0f);
            for (int y = 0; y < 7; ++y)
                for (int x = 0; x < 9; ++x)
                    map.setTexel(x, y, 0, 0.4f + 0.6f * randomFloat(number, static_cast<std::uint64_t>(y * 9 + x), 0));
            const std::string name = "map" + std::to_string(number);
            groom.maps.set(name, map);
            QVERIFY(setGroomValue(groom, path + "/map", name).ok());
        }
        Progress progress;
        GenerateOptions options;
        options.time = 0.7f;
        const Result<Strands> fast = Generator().generate(groom, options, progress);
        const Result<Strands> slow =
            generateReference(groom, std::make_shared<const Surface>(groom.mesh), options, progress);
        QVERIFY(fast.ok() && slow.ok() && fast->count() > 600);
        QCOMPARE(fast->ids, slow->ids);
        QCOMPARE(fast->firstVertex, slow->firstVertex);
        std::size_t near = 0;
        for (std::size_t v = 0; v < fast->vertexCount(); ++v) {
            near += glm::distance(fast->positions[v], slow->positions[v]) < 2e-5f;
            QVERIFY(std::abs(fast->widths[v] - slow->widths[v]) < 1e-6f);
            QVERIFY(glm::distance(fast->colours[v], slow->colours[v]) < 1e-5f);
        }
        // Tight curls and noise multiply the rounding of a few.
        QVERIFY2(near > fast->vertexCount() * 99 / 100, qPrintable(QString::number(near)));
    }
};

QTEST_APPLESS_MAIN(DrivenTest)
#include "driven_test.moc"
