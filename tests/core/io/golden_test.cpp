// SPDX-License-Identifier: Apache-2.0
// Law: documents of every released format open for ever and mean what they meant.
#include "core/base/random.h"
#include "core/io/document.h"
#include "core/io/safe_file.h"
#include "tests/support/documents.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <cstdlib>

using namespace whorl;
namespace fs = std::filesystem;

class GoldenTest : public QObject {
    Q_OBJECT

private:
    /// tests/data/golden beside the resources of the tree.
    static fs::path folder() {
        const char* resources = std::getenv("WHORL_RESOURCES");
        return resources ? fs::path(resources).parent_path() / "tests" / "data" / "golden" : fs::path();
    }

private Q_SLOTS:
    /// Only when a new format is made: WHORL_WRITE_GOLDEN=v2 golden_test
    void initTestCase() {
        QVERIFY2(!folder().empty(), "WHORL_RESOURCES does not name the resources of the tree");
        const char* name = std::getenv("WHORL_WRITE_GOLDEN");
        if (!name) return;
        Progress progress;
        const fs::path file = folder() / (std::string(name) + ".whorl");
        QVERIFY2(!fs::exists(file), "golden documents are never overwritten");
        QVERIFY(saveDocument(testing::goldenGroom(), file, progress).ok());
    }

    void opens_data() {
        QTest::addColumn<QString>("file");
        QTest::newRow("v1") << "v1.whorl";
    }
    void opens() {
        QFETCH(QString, file);
        Progress progress;
        const auto opened = openDocument(folder() / file.toStdString(), progress);
        QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
        QVERIFY2(opened->problems.empty(), opened->problems.empty() ? "" : opened->problems[0].c_str());
        QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(testing::goldenGroom()));
    }

    void damagedBehindChecksums() {
        // The same changes that the fuzzer makes, at random.
        int accepted = 0;
        for (std::uint64_t round = 0; round < 4000; ++round) {
            std::vector<std::uint8_t> choices(11 * (1 + round % 4));
            for (std::size_t i = 0; i < choices.size(); ++i)
                choices[i] = static_cast<std::uint8_t>(randomBits(3, round, static_cast<std::uint32_t>(i)));
            const auto opened = documentFromBytes(testing::mutatedDocument(choices), "a");
            if (opened && !testing::obeysLaws(opened->groom)) QFAIL(checkGroom(opened->groom).front().c_str());
            accepted += opened.ok();
        }
        QVERIFY(accepted > 400 && accepted < 3800);
    }
};

QTEST_APPLESS_MAIN(GoldenTest)
#include "golden_test.moc"
