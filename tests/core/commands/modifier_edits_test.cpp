// SPDX-License-Identifier: Apache-2.0
#include "core/commands/modifier_edits.h"

#include "core/commands/command.h"
#include "core/param/json.h"
#include "core/param/path.h"
#include "tests/support/shapes.h"

#include <nlohmann/json.hpp>

#include <QtTest>
#include <set>

using namespace whorl;

namespace {

const std::vector<Modifier>& list(const Groom& groom) {
    return (*groom.groups)[0].params.modifiers;
}

std::string names(const Groom& groom) {
    std::string text;
    for (const Modifier& modifier : list(groom)) text += modifier.name + " ";
    return text;
}

}  // namespace

class ModifierEditsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyKindIsMadeWithItsDefaults() {
        Groom groom = testing::groomOn(testing::sphere(8, 12), 0);
        const std::vector<BlockInfo> kinds = modifierKinds();
        QCOMPARE(kinds.size(), modifierKindCount);
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            QCOMPARE(*modifierKind(kinds[kind].id), kind);
            QCOMPARE(*addModifier(groom, 0, kinds[kind].id), static_cast<int>(kind));
            QCOMPARE(list(groom)[kind].kind(), kind);
            QVERIFY(list(groom)[kind].params == defaultModifierParams(kind));
            QCOMPARE(QString::fromStdString(list(groom)[kind].name), QString::fromUtf8(kinds[kind].id.data()));
        }
        QVERIFY(checkGroom(groom).empty());
        QCOMPARE(*addModifier(groom, 0, "curl"), static_cast<int>(modifierKindCount));
        QCOMPARE(QString::fromStdString(list(groom).back().name), QString("curl2"));
    }

    void idsOfOneKindAreUnique() {
        for (std::size_t kind = 0; kind < modifierKindCount; ++kind) {
            Modifier modifier;
            modifier.params = defaultModifierParams(kind);
            std::set<std::string_view> ids;
            for (const ParamRef& ref : paramsOf(modifier)) {
                QVERIFY(ids.insert(ref.info.id).second);
                QVERIFY(!ref.info.label.empty() && !ref.info.tip.empty());
                // Defaults are in their own range.
                QVERIFY2(setParamValue(ref, paramValue(ref)).ok(), std::string(ref.info.id).c_str());
            }
        }
    }

    void modifiersMoveAndAreRenamed() {
        Groom groom = testing::groomOn(testing::sphere(8, 12), 0);
        for (const char* kind : {"clump", "curl", "noise", "taper"}) QVERIFY(addModifier(groom, 0, kind));
        QVERIFY(moveModifier(groom, 0, "clump", 2));
        QCOMPARE(names(groom), std::string("curl noise clump taper "));
        QVERIFY(moveModifier(groom, 0, "taper", 0));
        QCOMPARE(names(groom), std::string("taper curl noise clump "));
        QVERIFY(moveModifier(groom, 0, "taper", 99));
        QCOMPARE(names(groom), std::string("curl noise clump taper "));
        QVERIFY(renameModifier(groom, 0, "noise", "waves"));
        QVERIFY(removeModifier(groom, 0, "clump"));
        QCOMPARE(names(groom), std::string("curl waves taper "));
        QCOMPARE(*addModifier(groom, 0, "bend", "hang", 1), 1);
        QCOMPARE(names(groom), std::string("curl hang waves taper "));
    }

    void whatCanNotBeDoneChangesNothing() {
        Groom groom = testing::groomOn(testing::sphere(8, 12), 0);
        QVERIFY(addModifier(groom, 0, "clump"));
        const Groom before = groom;
        QVERIFY(!addModifier(groom, 0, "plait"));
        QVERIFY(!addModifier(groom, 0, "curl", "clump"));
        QVERIFY(!addModifier(groom, 0, "curl", "two words"));
        QVERIFY(!addModifier(groom, 3, "curl"));
        QVERIFY(!removeModifier(groom, 0, "gone"));
        QVERIFY(!moveModifier(groom, 0, "gone", 0));
        QVERIFY(!renameModifier(groom, 0, "clump", ""));
        QVERIFY(!applyPreset(groom, 0, "{}", "x.json"));
        QVERIFY(!applyPreset(groom, 0, "[", "x.json"));
        QVERIFY(!applyPreset(groom, 0, R"({"whorl_preset": 1, "frozz": {}})", "x.json"));
        QVERIFY(!applyPreset(groom, 0, R"({"whorl_preset": 1, "modifiers": [{"kind": "plait"}]})", "x.json"));
        QVERIFY(groom.sameAs(before));
        for (std::size_t i = 1; i < Modifier::most; ++i) QVERIFY(addModifier(groom, 0, "smooth"));
        QVERIFY(!addModifier(groom, 0, "smooth"));
    }

    void parametersHavePaths() {
        Groom groom = testing::groomOn(testing::sphere(8, 12), 0);
        QVERIFY(addModifier(groom, 0, "clump", "locks"));
        groom.maps.set("wet", Map(4, 4, 1, TexelFormat::U8, 0.5f));
        QVERIFY(setGroomValue(groom, "groups/hair/modifiers/locks/tightness", 0.25).ok());
        QVERIFY(setGroomValue(groom, "groups/hair/modifiers/locks/amount/map", std::string("wet")).ok());
        QVERIFY(setGroomValue(groom, "groups/hair/modifiers/locks/on", std::string("off")).ok());
        QVERIFY(!setGroomValue(groom, "groups/hair/modifiers/curls/tightness", 0.25).ok());
        QVERIFY(!setGroomValue(groom, "groups/hair/modifiers/locks", 0.25).ok());
        const Modifier& locks = list(groom)[0];
        QCOMPARE(std::get<ClumpParams>(locks.params).tightness.value, 0.25f);
        QCOMPARE(locks.amount.map, std::string("wet"));
        QVERIFY(!locks.on);
    }

    void jsonComesBackEqual() {
        Groom groom = testing::groomOn(testing::sphere(8, 12), 0);
        for (const BlockInfo& kind : modifierKinds()) QVERIFY(addModifier(groom, 0, kind.id));
        HairParams params = (*groom.groups)[0].params;
        params.modifiers[0].on = false;
        params.modifiers[1].amount = {0.5f, "where"};
        std::get<BendParams>(params.modifiers[3].params).direction.value = {1.0f, 0.5f, -0.25f};
        params.strands.hairs = 7;
        Problems problems;
        HairParams back;
        hairParamsFromJson(back, nlohmann::json::parse(hairParamsToJson(params).dump()), "groups/hair", problems);
        QVERIFY(problems.empty());
        QVERIFY(back == params);
        // A list of modifiers is replaced, not added to.
        hairParamsFromJson(back, nlohmann::json::parse(hairParamsToJson(params).dump()), "groups/hair", problems);
        QVERIFY(back == params);
    }

    void jsonTellsWhatItDoesNotKnow() {
        const auto json = nlohmann::json::parse(R"([
            {"name": "a", "kind": "curl", "params": {"turns": 1e9, "tunrs": 1}},
            {"name": "a", "kind": "curl", "colour": 1},
            {"name": "b", "kind": "plait"}, 5])");
        Problems problems;
        std::vector<Modifier> list;
        modifiersFromJson(list, json, "groups/hair/modifiers", problems);
        QCOMPARE(list.size(), std::size_t{2});
        QCOMPARE(list[1].name, std::string("a2"));
        QCOMPARE(problems.size(), std::size_t{6});
        QCOMPARE(std::get<CurlParams>(list[0].params).turns.value, 3.0f);
    }

    void presetsApplyAndFitTheMesh() {
        QVERIFY(!presets().empty());
        for (const Preset& preset : presets()) {
            QVERIFY(!preset.label.empty() && !preset.tip.empty());
            Groom small = testing::groomOn(testing::sphere(8, 12, 0.15f), 10),
                  large = testing::groomOn(testing::sphere(8, 12, 1.75f), 10);
            const Result<void> done = applyPreset(small, 0, preset.text, preset.id);
            QVERIFY2(done.ok(), done.ok() ? "" : done.error().message.c_str());
            QVERIFY(applyPreset(large, 0, preset.text, preset.id));
            QVERIFY(checkGroom(small).empty() && checkGroom(large).empty());
            for (std::size_t i = 0; i < list(small).size(); ++i) {
                const auto* a = std::get_if<CurlParams>(&list(small)[i].params);
                const auto* b = std::get_if<CurlParams>(&list(large)[i].params);
                if (a) QVERIFY(std::abs(b->tipRadius.value - 10.0f * a->tipRadius.value) < 1e-5f);
            }
        }
    }

    void presetsChangeOnlyWhatTheyName() {
        Groom groom = testing::groomOn(testing::sphere(8, 12), 10);
        groom.groups.edit()[0].params.general.samples = 9;
        groom.groups.edit()[0].params.frizz.root.value = 0.5f;
        QVERIFY(
            applyPreset(groom, 0, R"({"whorl_preset": 1, "frizz": {"tip": 0.01}, "general": {"segments": 24}})", "x"));
        const HairParams& params = (*groom.groups)[0].params;
        QCOMPARE(params.general.samples, 9);
        QCOMPARE(params.frizz.root.value, 0.5f);
        QCOMPARE(params.frizz.tip.value, 0.01f);
        QCOMPARE(params.general.segments, 24);
        QCOMPARE(groom.guides.points(3).size(), std::size_t{25});
        QVERIFY(checkGroom(groom).empty());
    }

    void scriptsReachThem() {
        CommandContext context;
        context.groom = testing::groomOn(testing::sphere(8, 12), 5);
        context.hasGroom = true;
        Progress progress;
        const std::vector<Command> commands = coreCommands();
        const auto output = runScript(commands, context,
                                      "add-modifier hair clump locks\nadd-modifier hair curl\n"
                                      "move-modifier hair curl 1\nrename-modifier hair locks tufts\n"
                                      "set groups/hair/modifiers/tufts/count 20\nmodifiers hair\n"
                                      "remove-modifier hair curl\napply-preset hair ringlets\n",
                                      "script", progress);
        QVERIFY2(output.ok(), output.ok() ? "" : output.error().message.c_str());
        QCOMPARE(*output, std::string("curl curl on\ntufts clump on\n"));
        QVERIFY(list(context.groom).size() > 1);
        QVERIFY(!runScript(commands, context, "apply-preset hair nothing", "script", progress));
        QVERIFY(!runScript(commands, context, "add-modifier beard clump", "script", progress));
    }
};

QTEST_APPLESS_MAIN(ModifierEditsTest)
#include "modifier_edits_test.moc"
