// SPDX-License-Identifier: Apache-2.0
// The whole thread on real meshes, through whorl-cli: new, generate, hash, render, export, and the package back.
#include "tests/support/run.h"
#include "tests/support/shapes.h"

#include <QtTest>
#include <filesystem>

using whorl::testing::run;

namespace {

const char* const meshes[] = {
    "heads/makehuman_derived/head_neutral_sub1.glb",
    "heads/makehuman_derived/head_caucasian_female_young.obj",
    "heads/makehuman_derived/head_african_male_young_sub1.glb",
    "heads/makehuman_derived/body_caucasian_female_young.obj",
    "animals/crane/spot/spot.obj",
    "animals/crane/bob/bob_tri.obj",
    "animals/odedstein/bunny/bunny.obj",
    "animals/odedstein/armadillo/armadillo.obj",
    "animals/odedstein/penguin/penguin.obj",
    "animals/odedstein/fish/fish.obj",
    "stanford/bun_zipper.ply",
    "stanford/paper_sizes/dragon_202520_boxuv.glb",
};

QString text(const whorl::testing::RunResult& result) {
    return QString::fromStdString(result.out + result.err).left(2000) +
           QString(" (status %1, signal %2)").arg(result.status).arg(result.signal);
}

std::string firstWord(const std::string& line) {
    return line.substr(0, line.find_first_of(" \n\t"));
}

}  // namespace

class RealMeshesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void threadThroughTheHouse_data() {
        QTest::addColumn<QString>("mesh");
        for (const char* mesh : meshes) QTest::newRow(mesh) << mesh;
    }
    void threadThroughTheHouse() {
        QFETCH(QString, mesh);
        const auto file = whorl::testing::realData(mesh.toStdString());
        if (!file) QSKIP("The folder of real data is not here.");
        const auto folder = whorl::testing::scratchFolder("real_meshes");
        const std::string document = (folder / "groom.whorl").string();
        const std::string package = (folder / "groom.groom").string();

        std::vector<std::string> arguments{"new", file->string(), "-o", document, "--guides", "300"};
        if (mesh.contains("head_")) {
            const auto scalp = whorl::testing::realData("heads/makehuman_derived/scalp_density_1024_8bit.png");
            arguments.insert(arguments.end(), {"--density", scalp->string()});
        }
        auto result = run("whorl-cli", arguments);
        QVERIFY2(result.status == 0, qPrintable(text(result)));

        result = run("whorl-cli", {"generate", document, "--count", "20000", "-o", (folder / "hair.ply").string()});
        QVERIFY2(result.status == 0, qPrintable(text(result)));
        // 20,000 hairs of 16 vertices take at least 3 floats each, unless the density took roots away.
        QVERIFY(std::filesystem::file_size(folder / "hair.ply") > 20000u * 16u * 12u * 9 / 10);

        std::string digest;
        for (const char* parts : {"1", "3", "8"}) {
            for (const char* threads : {"1", "2"}) {
                result = run("whorl-cli", {"hash", document, "--parts", parts, "--threads", threads});
                QVERIFY2(result.status == 0, qPrintable(text(result)));
                const std::string got = firstWord(result.out);
                QVERIFY2(got.size() == 16, got.c_str());
                if (digest.empty()) digest = got;
                QVERIFY2(got == digest, qPrintable(QString("parts %1, threads %2: %3 is not %4")
                                                       .arg(parts, threads, got.c_str(), digest.c_str())));
            }
        }

        result = run("whorl-cli", {"export", document, "-o", package, "--parts", "3"});
        QVERIFY2(result.status == 0, qPrintable(text(result)));
        for (const char* parts : {"1", "8"}) {
            result = run("whorl-cli", {"hash", package, "--parts", parts});
            QVERIFY2(result.status == 0, qPrintable(text(result)));
            QVERIFY2(firstWord(result.out) == digest, qPrintable(text(result)));
        }

        const auto picture = folder / "picture.png";
        result = run("whorl-cli", {"render", document, "-o", picture.string(), "--size", "400x400"});
        QVERIFY2(result.status == 0, qPrintable(text(result)));
        QVERIFY(std::filesystem::file_size(picture) > 20000);
    }
};

QTEST_GUILESS_MAIN(RealMeshesTest)
#include "real_meshes_test.moc"
