// SPDX-License-Identifier: Apache-2.0
// Laws: files are known by what is in them; what starts no groom is refused with a sentence that names it.
#include "core/io/open.h"

#include "core/io/package.h"
#include "core/io/safe_file.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <fstream>

using namespace whorl;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

const std::string triangleObj = "# a triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace

class OpenTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void kindsByContent() {
        const fs::path folder = testing::scratchFolder("open-kinds");
        const auto kind = [&](const std::string& name, const std::string& text) {
            put(folder / name, text);
            return fileKind(folder / name);
        };
        QCOMPARE(kind("mesh.txt", triangleObj), FileKind::Mesh);
        QCOMPARE(kind("m.bin", "glTF\x02"), FileKind::Mesh);
        QCOMPARE(kind("m.json", " {\"asset\":{\"version\":\"2.0\"}}"), FileKind::Mesh);
        QCOMPARE(kind("m.dat", "ply\nformat ascii 1.0\n"), FileKind::Mesh);
        QCOMPARE(kind("late.obj", "# only a long comment\n"), FileKind::Mesh);
        QCOMPARE(kind("m.whorl", "HAIR...."), FileKind::HairCurves);
        QCOMPARE(kind("a.obj", "WHORLDOC...."), FileKind::Document);
        QCOMPARE(kind("empty.obj", ""), FileKind::Unknown);
        QCOMPARE(kind("text.whorl", "hello"), FileKind::Unknown);
        QCOMPARE(kind("list.json", "[1]"), FileKind::Unknown);
        QCOMPARE(fileKind(folder), FileKind::Unknown);
        QCOMPARE(fileKind(folder / "none"), FileKind::Unknown);
        QCOMPARE(fileKind(""), FileKind::Unknown);
        QCOMPARE(fileKind("/dev/zero"), FileKind::Unknown);
    }

    void opensAllThatStartAGroom() {
        const fs::path folder = testing::scratchFolder("open-all");
        Progress progress;
        Groom groom = testing::groomOn(testing::plane(2), 4, 4);
        groom.counts.edit().hairs = 50;
        QVERIFY(saveDocument(groom, folder / "document", progress).ok());
        QVERIFY(exportPackage(groom, folder / "package", 2, progress).ok());
        QCOMPARE(fileKind(folder / "package"), FileKind::Package);
        for (const char* name : {"document", "package"}) {
            const auto opened = openGroom(folder / name, progress);
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
        }
        put(folder / "a.obj", triangleObj);
        const auto opened = openGroom(folder / "a.obj", progress);
        QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
        QCOMPARE(opened->groom.mesh->triangleCount(), 1u);
        QVERIFY(checkGroom(opened->groom).empty());
        QVERIFY(opened->groom.guides.empty());
    }

    void othersAreRefused() {
        const fs::path folder = testing::scratchFolder("open-refused");
        Progress progress;
        put(folder / "text", "hello");
        put(folder / "h.hair", "HAIR");
        for (const char* name : {"text", "h.hair", "none", ""}) {
            const auto opened = openGroom(folder / name, progress);
            QVERIFY(!opened.ok());
            QVERIFY2(opened.error().message.find((folder / name).string()) != std::string::npos,
                     opened.error().message.c_str());
        }
        QVERIFY(!openGroom("", progress).ok());
    }

    void badPackagesOfTheCorpus() {
        const auto corpus = testing::realData("packages_bad");
        const auto hostile = testing::realData("hostile/package");
        if (!corpus || !hostile) QSKIP("the folder of bad packages is not here ($WHORL_TEST_DATA)");
        Progress progress;
        int tried = 0;
        for (const fs::path& root : {*corpus, *hostile}) {
            for (const auto& entry : fs::recursive_directory_iterator(root)) {
                if (!entry.is_regular_file()) continue;
                ++tried;
                QVERIFY(fileKind(entry.path()) != FileKind::Document && fileKind(entry.path()) != FileKind::Package);
                const auto opened = openGroom(entry.path(), progress);
                QVERIFY2(!opened.ok(), entry.path().c_str());
                QVERIFY(opened.error().message.size() > 20);
            }
        }
        QVERIFY(tried > 400);
    }
};

QTEST_APPLESS_MAIN(OpenTest)
#include "open_test.moc"
