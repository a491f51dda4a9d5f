// SPDX-License-Identifier: Apache-2.0
// A host of the RenderMan interface that loads the library as renderers do and records what it is told.
#include "core/hair/curve.h"
#include "core/hair/generate.h"
#include "core/hair/thin.h"
#include "tests/core/procedural/procedural_hair.h"
#include "tests/support/shapes.h"

#include <dlfcn.h>

#include <QTest>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <thread>

using namespace whorl;
using namespace whorl::testing;
namespace fs = std::filesystem;

namespace {

struct Curves {
    std::string type, wrap;
    std::vector<int> vertices;
    std::map<std::string, std::vector<float>> floats;
    std::map<std::string, std::vector<int>> ints;
};

/// What one thread of the host was told.
struct Recording {
    int depth = 0;
    int deepest = 0;
    bool faults = false;  ///< out of order
    float basis[4][4]{};
    int step = 0;
    std::vector<std::vector<float>> motions;
    std::vector<std::vector<Curves>> blocks;  ///< one entry a motion sample
    std::size_t samplesLeft = 0;
    void* context = nullptr;
    std::vector<std::string> errors;
};

thread_local Recording recorded;
thread_local bool basisKnown = false;

Recording taken() {
    Recording recording = std::exchange(recorded, Recording{});
    basisKnown = false;
    return recording;
}

}  // namespace

extern "C" {

void RiAttributeBegin() {
    recorded.deepest = std::max(recorded.deepest, ++recorded.depth);
}
void RiAttributeEnd() {
    --recorded.depth;
}
void RiBasis(float u[4][4], int uStep, float v[4][4], int vStep) {
    recorded.faults |= recorded.depth == 0 || uStep != vStep || std::memcmp(u, v, 64) != 0;
    std::memcpy(recorded.basis, v, 64);
    recorded.step = vStep;
    basisKnown = true;
}
void RiMotionBeginV(int n, float* times) {
    recorded.faults |= recorded.samplesLeft != 0;
    recorded.motions.push_back({times, times + n});
    recorded.samplesLeft = static_cast<std::size_t>(n);
    recorded.blocks.emplace_back();
}
void RiMotionEnd() {
    recorded.faults |= recorded.samplesLeft != 0;
}
void RiContext(void* context) {
    recorded.context = context;
}
void RiErrorPrint(int, int, char* message) {
    recorded.errors.emplace_back(message);
}
void RiCurvesV(char* type, int count, int* vertices, char* wrap, int n, char** tokens, void** values) {
    recorded.faults |= !basisKnown || recorded.depth == 0;
    Curves curves{type, wrap, {vertices, vertices + count}, {}, {}};
    std::size_t all = 0;
    for (const int of : curves.vertices) all += static_cast<std::size_t>(of);
    const auto hairs = static_cast<std::size_t>(count);
    for (int i = 0; i < n; ++i) {
        // "varying color Cs": how many values there must be follows from the curves.
        const QStringList words = QString(tokens[i]).split(' ');
        const std::string name = words[2].toStdString();
        const std::size_t places = words[0] == "vertex" ? all : words[0] == "varying" ? all - 2 * hairs : hairs;
        const std::size_t each = words[1] == "float" || words[1] == "int" ? 1 : 3;
        if (words[1] == "int") {
            const int* from = static_cast<const int*>(values[i]);
            curves.ints[name].assign(from, from + places);
        } else {
            const float* from = static_cast<const float*>(values[i]);
            curves.floats[name].assign(from, from + places * each);
        }
    }
    if (recorded.samplesLeft > 0) {
        --recorded.samplesLeft;
    } else {
        recorded.blocks.emplace_back();
    }
    recorded.blocks.back().push_back(std::move(curves));
}

}  // extern "C"

namespace {

struct Library {
    void* handle = dlopen((fs::path(std::getenv("WHORL_BIN")).parent_path() / "lib" / "libwhorl_procedural.so").c_str(),
                          RTLD_NOW | RTLD_LOCAL);
    template <class Function>
    Function* find(const char* name) const {
        return reinterpret_cast<Function*>(dlsym(handle, name));
    }
    void* (*convert)(char*) = find<void*(char*)>("ConvertParameters");
    void (*subdivide)(void*, float) = find<void(void*, float)>("Subdivide");
    void (*free)(void*) = find<void(void*)>("Free");
    void (*subdivide2)(void*, float, int, char* const*,
                       void* const*) = find<void(void*, float, int, char* const*, void* const*)>("Subdivide2");
    void (*bound)(int, char* const*, void* const*,
                  float (*)[6]) = find<void(int, char* const*, void* const*, float (*)[6])>("Bound");
};

const Library& library() {
    static const Library loaded;
    return loaded;
}

constexpr float everything = std::numeric_limits<float>::infinity();

Recording drawn(const std::string& text, float detail = everything) {
    taken();
    void* data = library().convert(const_cast<char*>(text.c_str()));
    library().subdivide(data, detail);
    library().free(data);
    return taken();
}

/// One sample of all blocks, one after another.
Curves joined(const Recording& recording, std::size_t sample = 0) {
    Curves all;
    for (const std::vector<Curves>& block : recording.blocks) {
        const Curves& one = block.at(sample);
        all.vertices.insert(all.vertices.end(), one.vertices.begin(), one.vertices.end());
        for (const auto& [name, values] : one.floats)
            all.floats[name].insert(all.floats[name].end(), values.begin(), values.end());
        for (const auto& [name, values] : one.ints)
            all.ints[name].insert(all.ints[name].end(), values.begin(), values.end());
    }
    return all;
}

/// True when the curves are these strands, with the first and the last vertex twice, with normals or without.
bool same(Curves curves, const Strands& strands, bool withNormals = true) {
    std::vector<float> positions, widths, normals, colours, opacities, s, t;
    std::vector<int> counts, ids, members, groups;
    const auto three = [](std::vector<float>& to, const glm::vec3& v) { to.insert(to.end(), {v.x, v.y, v.z}); };
    for (std::size_t i = 0; i < strands.count(); ++i) {
        const std::uint32_t first = strands.firstVertex[i], end = strands.firstVertex[i + 1];
        for (std::uint32_t v = first; v < end; ++v) {
            for (int times = v == first || v + 1 == end ? 2 : 1; times > 0; --times) {
                three(positions, strands.positions[v]);
                widths.push_back(strands.widths[v]);
            }
            three(normals, strands.normals[v]);
            three(colours, glm::vec3(strands.colours[v]));
            three(opacities, glm::vec3(strands.colours[v].w));
        }
        counts.push_back(static_cast<int>(end - first) + 2);
        ids.push_back(static_cast<int>(strands.ids[i] & 0x7fffffffu));
        members.push_back(strands.members[i]);
        groups.push_back(strands.groups[i]);
        s.push_back(strands.rootUvs[i].x);
        t.push_back(strands.rootUvs[i].y);
    }
    auto& f = curves.floats;
    const std::size_t given = f.size();
    if (!withNormals) normals.clear();
    return curves.vertices == counts && f["P"] == positions && f["width"] == widths && f["N"] == normals &&
           f["Cs"] == colours && f["Os"] == opacities && f["s"] == s && f["t"] == t && curves.ints["hair_id"] == ids &&
           curves.ints["hair_member"] == members && curves.ints["hair_group"] == groups && f.size() == 7 &&
           given == (withNormals ? 7u : 6u) && curves.ints.size() == 3;
}

Strands hairOf(const Groom& groom, const GenerateOptions& options) {
    // Keeps what the next call with the same groom can use.
    static Generator generator;
    Progress progress;
    return *generator.generate(groom, options, progress);
}

Groom movingGroom() {
    Groom groom = groomOn(sphere(8, 12), 30, 9);
    groom.counts.edit().hairs = 500;
    HairParams& params = groom.groups.edit()[0].params;
    params.general.keepOutside = false;
    params.frizz.tip.value = 0.02f;
    params.frizz.animation.value = 1.0f;
    params.frizz.speed.value = 1.0f;
    return groom;
}

}  // namespace

class RendermanTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() {
        QVERIFY2(library().handle, dlerror());
        QVERIFY(library().convert && library().subdivide && library().free && library().subdivide2 && library().bound);
    }

    void theClassicInterfaceGivesTheHair() {
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            const Groom groom = randomGroom(seed);
            const fs::path package = exported(groom, scratchFolder("renderman-classic") / "my head.groom", 3);
            for (std::uint32_t part = 0; part < 3; ++part) {
                const Recording told = drawn("'" + package.string() + "' part=" + std::to_string(part));
                QVERIFY(told.errors.empty() && !told.faults && told.depth == 0 && told.deepest == 1);
                QVERIFY(told.motions.empty());
                for (const auto& block : told.blocks)
                    QVERIFY(block[0].type == "cubic" && block[0].wrap == "nonperiodic");
                QVERIFY(same(joined(told), hairOf(groom, {.part = part, .partCount = 3}), wantsNormals(groom)));
            }
            // Without a part the whole, also in other numbers of parts.
            QVERIFY(same(joined(drawn("'" + package.string() + "'")), hairOf(groom, {}), wantsNormals(groom)));
            QVERIFY(same(joined(drawn("'" + package.string() + "' part=6 parts=7")),
                         hairOf(groom, {.part = 6, .partCount = 7}), wantsNormals(groom)));
        }
    }

    void theBasisIsThatOfTheCurves() {
        const Recording told = drawn(exported(movingGroom(), scratchFolder("renderman-basis") / "a.groom", 1).string());
        QCOMPARE(told.step, 1);
        const glm::vec3 points[4] = {{1, 2, 3}, {4, -1, 0}, {2, 2, 5}, {0, 7, 1}};
        for (const float t : {0.0f, 0.25f, 0.7f, 1.0f}) {
            const float powers[4] = {t * t * t, t * t, t, 1.0f};
            glm::vec3 point(0.0f);
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) point += powers[i] * told.basis[i][j] * points[j];
            QVERIFY(glm::distance(point, catmullRom(points[0], points[1], points[2], points[3], t)) < 1e-5f);
        }
    }

    void procedural2GivesTheSame() {
        const Groom groom = randomGroom(7);
        const fs::path package = exported(groom, scratchFolder("renderman-two") / "a.groom", 4);
        const std::string name = package.string();
        const char* path = name.c_str();
        int part = 2, context = 0;
        float bad = 7.0f;
        char* tokens[] = {const_cast<char*>("string package"), const_cast<char*>("uniform int part"),
                          const_cast<char*>("float[6] __bound"), const_cast<char*>("__dsoname")};
        void* values[] = {&path, &part, &bad, &path};
        taken();
        library().subdivide2(&context, everything, 4, tokens, values);
        Recording told = taken();
        QVERIFY(told.errors.empty() && !told.faults && told.context == &context);
        QVERIFY(same(joined(told), hairOf(groom, {.part = 2, .partCount = 4}), wantsNormals(groom)));

        float boxes[2][6];
        library().bound(4, tokens, values, boxes);
        const Bounds bounds = hairOf(groom, {.part = 2, .partCount = 4}).bounds();
        for (const auto& box : boxes)
            for (int axis = 0; axis < 3; ++axis)
                QVERIFY(box[2 * axis] == bounds.min[axis] && box[2 * axis + 1] == bounds.max[axis]);

        const char* overrides = R"({"counts/hairs": 50})";
        char* bare[] = {const_cast<char*>("package"), const_cast<char*>("part"), const_cast<char*>("parts"),
                        const_cast<char*>("overrides")};
        int parts = 1;
        part = 0;
        void* others[] = {&path, &part, &parts, &overrides};
        library().subdivide2(nullptr, everything, 4, bare, others);
        told = taken();
        Groom fewer = groom;
        fewer.counts.edit().hairs = 50;
        QVERIFY(told.errors.empty() && same(joined(told), hairOf(fewer, {}), wantsNormals(groom)));
    }

    void everyHairHasItsOwnNumbers() {
        // Hairs that keep apart have ids from 2^31 on, which no signed number holds; here they and others grow
        // together.
        Groom groom = movingGroom();
        std::vector<Group>& groups = groom.groups.edit();
        groups[0].params.strands.hairs = 3;
        groups.push_back(groups[0]);
        groups[1].name = "even";
        groups[1].params.general.even = true;
        Map numbers(64, 64, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 64; ++y)
            for (int x = 32; x < 64; ++x) numbers.setTexel(x, y, 0, 1.0f / 255.0f);
        groom.maps.set("numbers", numbers);
        groom.counts.edit().groupMap.name = "numbers";
        for (std::size_t i = 0; i < groom.guides.count(); ++i)
            groom.guides.setGroup(i, static_cast<std::uint8_t>(i % 2));
        const fs::path folder = scratchFolder("renderman-numbers");
        Curves curves = joined(drawn(exported(groom, folder / "a.groom", 2).string()));
        std::set<std::array<int, 3>> seen;
        for (std::size_t i = 0; i < curves.vertices.size(); ++i) {
            QVERIFY(curves.ints["hair_id"][i] >= 0);
            seen.insert({curves.ints["hair_group"][i], curves.ints["hair_id"][i], curves.ints["hair_member"][i]});
        }
        QVERIFY(curves.vertices.size() > 1200);
        QCOMPARE(seen.size(), curves.vertices.size());
        const Strands all = hairOf(groom, {});
        QVERIFY(std::ranges::any_of(all.ids, [](std::uint32_t id) { return id > 0x7fffffffu; }));
        QVERIFY(same(curves, all));
        // Normals of all when one group asks for them, of none when none does.
        groom.groups.edit()[0].params.general.writeNormals = false;
        QVERIFY(same(joined(drawn(exported(groom, folder / "b.groom", 1).string())), all));
        groom.groups.edit()[1].params.general.writeNormals = false;
        QVERIFY(same(joined(drawn(exported(groom, folder / "c.groom", 1).string())), all, false));
    }

    void hairMovesInMotionBlocks() {
        const Groom groom = movingGroom();
        const fs::path package = exported(groom, scratchFolder("renderman-motion") / "a.groom", 1);
        const Recording told = drawn(package.string() + " frame=5 fps=25 shutter=0,0.5 samples=3");
        QVERIFY(told.errors.empty() && !told.faults && !told.blocks.empty());
        QCOMPARE(told.motions.size(), told.blocks.size());
        for (const auto& times : told.motions) QVERIFY(times == (std::vector{0.0f, 0.25f, 0.5f}));
        for (std::size_t s = 0; s < 3; ++s) {
            const auto seconds = static_cast<float>((5.0 + 0.25 * static_cast<double>(s)) / 25.0);
            QVERIFY(same(joined(told, s), hairOf(groom, {.time = seconds})));
        }
        // Without a shutter the frame stands still; hair that does not move needs no samples.
        const Recording still = drawn(package.string() + " frame=5 fps=25");
        QVERIFY(still.motions.empty() && same(joined(still), hairOf(groom, {.time = 0.2f})));
        Groom stiff = groom;
        stiff.groups.edit()[0].params.frizz.animation.value = 0.0f;
        const fs::path other = exported(stiff, scratchFolder("renderman-still") / "a.groom", 1);
        QVERIFY(drawn(other.string() + " frame=5 shutter=0,0.5").motions.empty());
    }

    void smallerInThePictureIsFewer() {
        const Groom groom = movingGroom();
        const std::string package = exported(groom, scratchFolder("renderman-lod") / "a.groom", 1).string();
        const Curves all = joined(drawn(package));
        std::size_t before = all.vertices.size();
        for (const float detail : {1e9f, 1e4f, 2000.0f, 100.0f}) {
            const Recording told = drawn(package, detail);
            Curves some = joined(told);
            QVERIFY(told.errors.empty());
            QVERIFY(some.vertices.size() <= before);
            before = some.vertices.size();
            std::vector<int>& ids = some.ints["hair_id"];
            const std::vector<int>& known = all.ints.at("hair_id");
            for (const int id : ids) QVERIFY(std::ranges::find(known, id) != known.end());
        }
        QVERIFY(before < all.vertices.size() / 4);
        QCOMPARE(joined(drawn(package + " lod=0", 100.0f)).vertices.size(), all.vertices.size());
        QVERIFY(joined(drawn(package + " lod=4", 2000.0f)).vertices.size() >
                joined(drawn(package, 2000.0f)).vertices.size());
        const std::size_t half = joined(drawn(package + " share=0.5")).vertices.size();
        QVERIFY(half > 200 && half < 300);
    }

    void theExampleOfThePackageWorks() {
        const Groom groom = movingGroom();
        const fs::path folder = scratchFolder("renderman-example");
        Progress progress;
        const PackageFrames frames{10, 12, 25.0};
        QVERIFY(exportPackage(groom, folder / "a b.groom", 4, progress, nullptr, frames).ok());
        const Bounds whole = hairOf(groom, {.time = 0.4f}).bounds();
        std::ifstream rib(folder / "a b.groom" / "groom.rib");
        std::size_t hairs = 0, primitives = 0;
        Bounds all;
        fs::current_path(folder);
        for (std::string line; std::getline(rib, line);) {
            if (!line.starts_with("Procedural ")) continue;
            ++primitives;
            const QString text = QString::fromStdString(line);
            QVERIFY(text.startsWith("Procedural \"DynamicLoad\" [\"libwhorl_procedural.so\" \""));
            const Recording told = drawn(text.section('"', 5, 5).toStdString());
            QVERIFY2(told.errors.empty(), told.errors.empty() ? "" : told.errors[0].c_str());
            const Curves curves = joined(told);
            hairs += curves.vertices.size();
            const QStringList box = text.section('[', 2).remove(']').split(' ');
            QCOMPARE(box.size(), 6);
            for (std::size_t v = 0; v < curves.floats.at("P").size(); ++v) {
                const float x = curves.floats.at("P")[v], r = 0.5f * curves.floats.at("width")[v / 3];
                const auto axis = static_cast<qsizetype>(2 * (v % 3));
                QVERIFY(box[axis].toFloat() <= x - r && x + r <= box[axis + 1].toFloat());
            }
            all.add(glm::vec3(box[0].toFloat(), box[2].toFloat(), box[4].toFloat()));
            all.add(glm::vec3(box[1].toFloat(), box[3].toFloat(), box[5].toFloat()));
        }
        fs::current_path("/");
        QCOMPARE(primitives, std::size_t{4});
        QCOMPARE(hairs, hairOf(groom, {}).count());
        QVERIFY(all.min == whole.min && all.max == whole.max);
    }

    void manyPrimitivesAtOnce() {
        const Groom groom = movingGroom();
        const fs::path package = exported(groom, scratchFolder("renderman-threads") / "a.groom", 8);
        constexpr std::uint32_t primitives = 24;
        std::vector<Recording> made(primitives);
        std::vector<std::thread> threads;
        for (std::uint32_t i = 0; i < primitives; ++i) {
            // Some share a groom, some have one of their own; all open theirs at once.
            const std::string own = i % 3 == 0 ? " overrides='{\"counts/hairs\": 300}'" : "";
            threads.emplace_back([&, i, own] {
                made[i] = drawn(package.string() + " parts=8 frame=3 part=" + std::to_string(i % 8) + own);
            });
        }
        for (std::thread& thread : threads) thread.join();
        Groom fewer = groom;
        fewer.counts.edit().hairs = 300;
        for (std::uint32_t i = 0; i < primitives; ++i) {
            QVERIFY(made[i].errors.empty() && !made[i].faults);
            QVERIFY(same(joined(made[i]),
                         hairOf(i % 3 == 0 ? fewer : groom, {.part = i % 8, .partCount = 8, .time = 0.125f})));
        }
    }

    void faultsAreToldToTheHost_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("sentence");
        QTest::newRow("no package") << "/none/a.groom part=0"
                                    << "/none/a.groom";
        QTest::newRow("nothing") << ""
                                 << "no package";
        QTest::newRow("unknown") << "PACKAGE colour=3"
                                 << "no parameter colour";
        QTest::newRow("no value") << "PACKAGE part"
                                  << "NAME=VALUE";
        QTest::newRow("no number") << "PACKAGE part=two"
                                   << "part";
        QTest::newRow("not finite") << "PACKAGE share=nan"
                                    << "share";
        QTest::newRow("too far") << "PACKAGE part=9"
                                 << "no part 9";
        QTest::newRow("huge") << "PACKAGE part=1e30"
                              << "part";
        QTest::newRow("shutter") << "PACKAGE shutter=1,0"
                                 << "shutter";
        QTest::newRow("overrides") << "PACKAGE overrides='{\"counts/hair\": 1}'"
                                   << "overrides";
    }
    void faultsAreToldToTheHost() {
        QFETCH(QString, text);
        QFETCH(QString, sentence);
        const fs::path package = exported(movingGroom(), scratchFolder("renderman-faults") / "a.groom", 2);
        const Recording told = drawn(text.replace("PACKAGE", QString::fromStdString(package.string())).toStdString());
        QVERIFY(told.blocks.empty() && told.depth == 0);
        QCOMPARE(told.errors.size(), std::size_t{1});
        QVERIFY2(told.errors[0].find(sentence.toStdString()) != std::string::npos, told.errors[0].c_str());
    }

    void nullsAreNothing() {
        taken();
        library().free(library().convert(nullptr));
        library().subdivide(nullptr, 1.0f);
        library().free(nullptr);
        library().subdivide2(nullptr, 1.0f, 0, nullptr, nullptr);
        library().bound(0, nullptr, nullptr, nullptr);
        QVERIFY(taken().blocks.empty());
    }
};

QTEST_APPLESS_MAIN(RendermanTest)
#include "renderman_test.moc"
