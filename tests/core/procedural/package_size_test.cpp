// SPDX-License-Identifier: Apache-2.0
// Law: a package is smaller than a tenth of the hair that it stands for, at 100,000 hairs, both compressed alike.
#include "core/hair/generate.h"
#include "core/io/container.h"
#include "core/io/document.h"
#include "core/io/package.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <cstdlib>

using namespace whorl;
namespace fs = std::filesystem;

class PackageSizeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aTenthOfTheHair_data() {
        QTest::addColumn<QString>("sample");
        QTest::newRow("bust") << "bust";
        QTest::newRow("creature") << "creature";
    }
    void aTenthOfTheHair() {
        QFETCH(QString, sample);
        const fs::path file =
            fs::path(std::getenv("WHORL_BIN")).parent_path() / "samples" / (sample.toStdString() + ".whorl");
        if (!fs::exists(file)) QSKIP("the samples were not made");
        Progress progress;
        auto opened = openDocument(file, progress);
        QVERIFY(opened.ok());
        opened->groom.counts.edit().hairs = 100000;
        // Outside or not, the numbers are as many; the distance field takes long.
        for (Group& group : opened->groom.groups.edit()) group.params.general.keepOutside = false;
        const fs::path package = testing::scratchFolder("package-size") / "a.groom";
        QVERIFY(exportPackage(opened->groom, package, 4, progress).ok());
        std::uint64_t small = 0;
        for (const auto& entry : fs::directory_iterator(package)) small += entry.file_size();

        const auto hair = Generator().generate(opened->groom, {}, progress);
        QVERIFY(hair->count() > 99000 && hair->count() < 101000);
        ContainerWriter writer;
        writer.addArray(hair->firstVertex);
        writer.addArray(hair->ids);
        writer.addArray(hair->groups);
        writer.addArray(hair->rootUvs);
        writer.addArray(hair->positions);
        writer.addArray(hair->normals);
        writer.addArray(hair->widths);
        writer.addArray(hair->colours);
        const auto large = writer.finish({"WHORLRAW", 1, "hair as it is"}, "{}", progress);
        QVERIFY2(large->size() > 10 * small,
                 (std::to_string(large->size()) + " bytes of hair, package of " + std::to_string(small)).c_str());
    }
};

QTEST_APPLESS_MAIN(PackageSizeTest)
#include "package_size_test.moc"
