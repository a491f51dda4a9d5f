// SPDX-License-Identifier: Apache-2.0
#include "core/model/groom.h"
#include "core/param/json.h"
#include "core/param/path.h"

#include <nlohmann/json.hpp>

#include <QtTest>
#include <set>

using namespace whorl;

namespace {

Groom twoGroups() {
    Groom groom;
    groom.groups.edit().push_back({"brows"});
    groom.maps.set("length", Map(4, 4, 1, TexelFormat::U8, 1.0f));
    return groom;
}

}  // namespace

class ParamTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyPathReadsAndTakesItsOwnValue() {
        Groom groom = twoGroups();
        const auto paths = groomPaths(groom);
        QVERIFY(paths.size() > 40);
        for (const std::string& path : paths) {
            const auto value = groomValue(groom, path);
            QVERIFY2(value.ok(), path.c_str());
            const Groom before = groom;
            const auto set = setGroomValue(groom, path, *value);
            QVERIFY2(set.ok(), path.c_str());
            QVERIFY2(groom.sameAs(before), (path + " unshared the groom for no change").c_str());
            // As text, too: that is how scripts and undo texts pass it.
            QVERIFY2(setGroomValue(groom, path, paramText(*value)).ok(), path.c_str());
            QVERIFY2(*groomValue(groom, path) == *value, path.c_str());
        }
    }

    void idsAreUniqueAndTextsAreThere() {
        HairParams hair;
        HairParams::each(hair, [&](const BlockInfo& info, auto& block) {
            std::set<std::string_view> ids;
            QVERIFY(!info.label.empty() && !info.tip.empty());
            for (const ParamRef& ref : paramsOf(block)) {
                QVERIFY(ids.insert(ref.info.id).second);
                QVERIFY(!ref.info.label.empty() && !ref.info.tip.empty());
                QVERIFY(ref.info.min <= ref.info.max);
            }
        });
    }

    void valuesArriveWhereTheyBelong() {
        Groom groom = twoGroups();
        QVERIFY(setGroomValue(groom, "groups/brows/frizz/tip", 0.25).ok());
        QVERIFY(setGroomValue(groom, "groups/brows/frizz/tip/map", std::string("length")).ok());
        QVERIFY(setGroomValue(groom, "groups/hair/colour/root", std::string("#ffffff")).ok());
        QVERIFY(setGroomValue(groom, "groups/hair/frizz/frequency", std::string("1 2.5 3")).ok());
        QVERIFY(setGroomValue(groom, "groups/hair/general/interpolation", std::string("As they are")).ok());
        QVERIFY(setGroomValue(groom, "groups/hair/general/keep_outside", std::string("off")).ok());
        const auto& brows = (*groom.groups)[1].params;
        const auto& hair = (*groom.groups)[0].params;
        QCOMPARE(brows.frizz.tip.value, 0.25f);
        QCOMPARE(QString::fromStdString(brows.frizz.tip.map), QString("length"));
        QCOMPARE(hair.frizz.tip.value, 0.0f);
        QCOMPARE(hair.colour.root.value, glm::vec3(1.0f));
        QCOMPARE(hair.frizz.frequency.value, glm::vec3(1, 2.5f, 3));
        QCOMPARE(hair.general.interpolation.index, 1);
        QVERIFY(!hair.general.keepOutside);
    }

    void badValuesChangeNothing_data() {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QString>("value");
        QTest::addColumn<QString>("says");
        QTest::newRow("range") << "groups/hair/frizz/tip"
                               << "2"
                               << "from 0 to 1";
        QTest::newRow("nan") << "groups/hair/frizz/tip"
                             << "nan"
                             << "not-a-number";
        QTest::newRow("words") << "groups/hair/frizz/tip"
                               << "much"
                               << "a number";
        QTest::newRow("fraction") << "counts/hairs"
                                  << "1.5"
                                  << "whole number";
        QTest::newRow("choice") << "groups/hair/general/interpolation"
                                << "sideways"
                                << "Rotated to the surface";
        QTest::newRow("map") << "groups/hair/frizz/tip/map"
                             << "gone"
                             << "maps are length";
        QTest::newRow("no map here") << "groups/hair/general/segments/map"
                                     << "length"
                                     << "not driven";
        QTest::newRow("group") << "groups/crown/frizz/tip"
                               << "0"
                               << "groups are hair, brows";
        QTest::newRow("block") << "groups/hair/friz/tip"
                               << "0"
                               << "blocks are general, colour, frizz";
        QTest::newRow("parameter") << "groups/hair/frizz/top"
                                   << "0"
                                   << "parameters are root, tip";
        QTest::newRow("colour") << "groups/hair/colour/tip"
                                << "0.1 0.2"
                                << "three numbers";
        QTest::newRow("empty") << ""
                               << "0"
                               << "counts/";
    }
    void badValuesChangeNothing() {
        QFETCH(QString, path);
        QFETCH(QString, value);
        QFETCH(QString, says);
        Groom groom = twoGroups();
        const Groom before = groom;
        const auto set = setGroomValue(groom, path.toStdString(), value.toStdString());
        QVERIFY(!set.ok());
        QVERIFY2(QString::fromStdString(set.error().message).contains(says), set.error().message.c_str());
        QVERIFY(groom.sameAs(before));
    }

    void segmentsResampleTheGuidesOfTheirGroup() {
        Groom groom = twoGroups();
        std::vector<glm::vec3> points(16);
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = {0, static_cast<float>(i), 0};
        groom.guides.append({}, 0, points);
        groom.guides.append({}, 1, points);
        QVERIFY(setGroomValue(groom, "groups/hair/general/segments", 5.0).ok());
        QCOMPARE(groom.guides.points(0).size(), std::size_t{6});
        QCOMPARE(groom.guides.points(1).size(), std::size_t{16});
        QCOMPARE(groom.guides.points(0).back(), points.back());
    }

    void jsonComesBackEqual() {
        Groom groom = twoGroups();
        HairParams& params = groom.groups.edit()[0].params;
        params.frizz.tip = {0.1f, "length"};
        params.colour.root = {{0.1f, 0.2f, 0.3f}, "skin"};
        params.general.interpolation.index = 1;
        params.general.keepOutside = false;
        params.kink.frequency.value = {1, 2, 3};
        CountParams counts;
        counts.hairs = 123456;
        counts.groupMap.name = "areas";

        Problems problems;
        HairParams back;
        hairParamsFromJson(back, nlohmann::json::parse(hairParamsToJson(params).dump()), "groups/hair", problems);
        CountParams countsBack;
        countsFromJson(countsBack, nlohmann::json::parse(countsToJson(counts).dump()), "counts", problems);
        QVERIFY(problems.empty());
        QVERIFY(back == params);
        QVERIFY(countsBack == counts);
    }

    void jsonTellsWhatItDoesNotKnow() {
        Problems problems;
        HairParams params;
        const auto json = nlohmann::json::parse(
            R"({"frizz": {"tipp": 1, "tip": 5, "root": {"value": 0.5, "map": "m", "x": 1}}, "frozz": {}, "kink": 3})");
        hairParamsFromJson(params, json, "groups/hair", problems);
        QCOMPARE(problems.size(), std::size_t{5});
        QCOMPARE(params.frizz.root.value, 0.5f);
        QCOMPARE(params.frizz.tip.value, 0.0f);
    }

    void theReferenceNamesEveryParameter() {
        const std::string text = parameterReference();
        for (std::string path : groomPaths(Groom())) {
            if (const auto at = path.find("groups/hair/"); at == 0) path.replace(0, 12, "groups/GROUP/");
            QVERIFY2(text.find("`" + path + "`") != std::string::npos, path.c_str());
        }
        QVERIFY(text.find("0.09 mm") != std::string::npos);
    }

    void theShippedReferenceIsTrue() {
        const char* resources = std::getenv("WHORL_RESOURCES");
        QVERIFY2(resources, "ctest sets WHORL_RESOURCES");
        QFile file(QString(resources) + "/help/parameters.md");
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY2(file.readAll() == QByteArray::fromStdString(parameterReference()),
                 "run the command reference in whorl-cli and keep what it prints as resources/help/parameters.md");
    }
};

QTEST_APPLESS_MAIN(ParamTest)
#include "param_test.moc"
