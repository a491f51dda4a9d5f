// SPDX-License-Identifier: Apache-2.0
// Laws: written work is offered until somebody decides; what a living program holds is not offered or touched.
#include "core/io/journal.h"

#include "core/io/safe_file.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <cerrno>
#include <fstream>
#include <optional>

using namespace whorl;
namespace fs = std::filesystem;

namespace {

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string textOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

class JournalTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { setFileFault({}); }

    void livingJournalsAreNotOffered() {
        const fs::path folder = testing::scratchFolder("journal-alive") / "made" / "here";
        const Groom groom = testing::randomGroom(1);
        Progress progress;
        std::optional<Result<Journal>> journal(Journal::create(folder, "/somewhere/head.whorl"));
        QVERIFY(journal->ok());
        QVERIFY((*journal)->write(groom, progress).ok());
        QVERIFY(findRecoveries(folder).empty());
        const Recovery pretended{(*journal)->file(), {}, {}};
        deleteRecovery(pretended);
        QVERIFY(fs::exists(pretended.journal));

        journal.reset();  // the program ends without a word
        auto found = findRecoveries(folder);
        QCOMPARE(found.size(), std::size_t{1});
        QCOMPARE(found[0].document, fs::path("/somewhere/head.whorl"));
        QCOMPARE(found[0].when.size(), std::size_t{19});
        const auto opened = openRecovery(found[0], progress);
        QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
        QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(groom));
        QCOMPARE(findRecoveries(folder).size(), std::size_t{1});  // looking and opening takes nothing away
        deleteRecovery(found[0]);
        QVERIFY(findRecoveries(folder).empty());
        QCOMPARE(entries(folder), std::size_t{0});
    }

    void discardedOnesAreGone() {
        const fs::path folder = testing::scratchFolder("journal-discard");
        Progress progress;
        {
            auto journal = Journal::create(folder, {});
            QVERIFY(journal->write(testing::randomGroom(2), progress).ok());
            journal->discard();
            QVERIFY(!journal->write(testing::randomGroom(2), progress).ok());
        }
        QCOMPARE(entries(folder), std::size_t{0});
        { const auto unused = Journal::create(folder, {}); }
        QCOMPARE(entries(folder), std::size_t{0});
    }

    void everyInstanceHasItsOwn() {
        const fs::path folder = testing::scratchFolder("journal-two");
        Progress progress;
        const std::string document = "/a/" + std::string(3000, 'd') + "\xff 髪.whorl";
        {
            auto one = Journal::create(folder, document);
            auto two = Journal::create(folder, document);
            QVERIFY(one->file() != two->file());
            QVERIFY(one->write(testing::randomGroom(1), progress).ok());
            QVERIFY(two->write(testing::randomGroom(2), progress).ok());
            QVERIFY(one->write(testing::randomGroom(3), progress).ok());
            Journal moved = std::move(*one);
            QVERIFY(moved.write(testing::randomGroom(4), progress).ok());
        }
        const auto found = findRecoveries(folder);
        QCOMPARE(found.size(), std::size_t{2});
        std::vector<std::uint64_t> digests;
        for (const Recovery& recovery : found) {
            QCOMPARE(recovery.document.string(), document);
            digests.push_back(testing::groomDigest(openRecovery(recovery, progress)->groom));
        }
        std::vector<std::uint64_t> expected{testing::groomDigest(testing::randomGroom(4)),
                                            testing::groomDigest(testing::randomGroom(2))};
        std::sort(digests.begin(), digests.end());
        std::sort(expected.begin(), expected.end());
        QVERIFY(digests == expected);
    }

    void faultsKeepTheLastOne() {
        const fs::path folder = testing::scratchFolder("journal-fault");
        Progress progress;
        {
            auto journal = Journal::create(folder, {});
            QVERIFY(journal->write(testing::randomGroom(1), progress).ok());
            for (int k = 0; k < 50; ++k) {
                int step = 0;
                setFileFault([&](FileStep) { return step++ == k ? ENOSPC : 0; });
                const auto written = journal->write(testing::randomGroom(2), progress);
                setFileFault({});
                if (written) break;
                const auto opened = openRecovery({journal->file(), {}, {}}, progress);
                QVERIFY(opened.ok());
                QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(testing::randomGroom(1)));
            }
        }
        QCOMPARE(testing::groomDigest(openRecovery(findRecoveries(folder)[0], progress)->groom),
                 testing::groomDigest(testing::randomGroom(2)));
    }

    void damagedOnesAreRefused() {
        const fs::path folder = testing::scratchFolder("journal-bad");
        Progress progress;
        fs::path file;
        {
            auto journal = Journal::create(folder, "/a.whorl");
            QVERIFY(journal->write(testing::groomOn(testing::plane(1), 3, 2), progress).ok());
            file = journal->file();
        }
        const std::string good = textOf(file);
        const auto refused = [&](const std::string& bytes) {
            std::ofstream(file, std::ios::binary) << bytes;
            return findRecoveries(folder).size() == 1 && !openRecovery({file, {}, {}}, progress);
        };
        for (std::size_t length = 0; length < good.size(); length += 1 + length / 40)
            QVERIFY(refused(good.substr(0, length)));
        for (std::size_t at = 0; at < good.size(); at += 1 + at / 60) {
            std::string bad = good;
            bad[at] = static_cast<char>(bad[at] ^ 0x10);
            QVERIFY2(refused(bad), std::to_string(at).c_str());
        }
        QVERIFY(!refused(good));
    }

    void foldersThatCanNotBe() {
        const fs::path folder = testing::scratchFolder("journal-none");
        std::ofstream(folder / "file") << "x";
        QVERIFY(!Journal::create(folder / "file" / "in", {}).ok());
        QVERIFY(findRecoveries(folder / "none").empty());
        QVERIFY(findRecoveries(folder / "file").empty());
    }

    void folderFollowsTheEnvironment() {
        qputenv("XDG_STATE_HOME", "/state");
        QCOMPARE(journalFolder(), fs::path("/state/whorl/journals"));
        qputenv("XDG_STATE_HOME", "relative");
        qputenv("HOME", "/home/her");
        QCOMPARE(journalFolder(), fs::path("/home/her/.local/state/whorl/journals"));
    }
};

QTEST_APPLESS_MAIN(JournalTest)
#include "journal_test.moc"
