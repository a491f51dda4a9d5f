// SPDX-License-Identifier: Apache-2.0
// Law: a program that is killed while it saves, exports or keeps a journal leaves the old work or the new, whole.
// $WHORL_KILL_ROUNDS kills while saving (200), a quarter as many while exporting and journalling.
#include "core/base/random.h"
#include "core/io/document.h"
#include "core/io/journal.h"
#include "core/io/package.h"
#include "tests/support/shapes.h"

#include <sys/wait.h>
#include <unistd.h>

#include <QTest>
#include <csignal>
#include <cstdlib>
#include <cstring>

using namespace whorl;
namespace fs = std::filesystem;

namespace {

Groom groomWith(int hairs) {
    Groom groom = testing::groomOn(testing::sphere(16, 24), hairs / 2, 8);
    groom.groups.edit()[0].params.general.keepOutside = false;  // quick: no distance field
    groom.counts.edit().hairs = hairs;
    groom.maps.set("density", Map(300, 300, 1, TexelFormat::U16, 0.9f));
    for (int i = 0; i < 300; ++i) groom.maps.edit("density")->setTexel(i, (i * hairs) % 300, 0, 0.5f);
    return groom;
}
const int hairCounts[] = {200, 300};

bool isOneOfBoth(const Groom& groom) {
    const std::uint64_t digest = testing::groomDigest(groom);
    return digest == testing::groomDigest(groomWith(hairCounts[0])) ||
           digest == testing::groomDigest(groomWith(hairCounts[1]));
}

/// What the killed program does, for ever: one work after the other at the same place.
int writeForEver(const std::string& what, const fs::path& where) {
    const Groom grooms[] = {groomWith(hairCounts[0]), groomWith(hairCounts[1])};
    Progress progress;
    auto journal = what == "journal" ? Journal::create(where, "/a.whorl") : Result<Journal>(Error{"none"});
    for (int i = 0;; ++i) {
        const Groom& groom = grooms[i % 2];
        const auto done = what == "document"  ? saveDocument(groom, where, progress)
                          : what == "package" ? exportPackage(groom, where, 2, progress)
                          : journal           ? journal->write(groom, progress)
                                              : Result<void>(journal.error());
        if (!done) return 3;
        if (i == 0 && ::write(STDOUT_FILENO, "r", 1) != 1) return 4;
    }
}

/// Starts this program anew as that one, waits until it has written once, and kills it after a random time.
bool runAndKill(const std::string& what, const fs::path& where, std::uint32_t round, unsigned longest) {
    int ready[2];
    if (pipe(ready) != 0) return false;
    const std::string path = where.string();
    const char* arguments[] = {"kill_test", "--write", what.c_str(), path.c_str(), nullptr};
    const pid_t child = fork();
    if (child == 0) {
        dup2(ready[1], STDOUT_FILENO);
        close(ready[0]);
        close(ready[1]);
        execv("/proc/self/exe", const_cast<char* const*>(arguments));
        _exit(5);
    }
    close(ready[1]);
    char byte = 0;
    const bool wrote = ::read(ready[0], &byte, 1) == 1;
    if (wrote) usleep(static_cast<useconds_t>(randomBits(9, round, 0) % longest));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(ready[0]);
    return wrote && WIFSIGNALED(status);
}

int rounds() {
    const char* wish = std::getenv("WHORL_KILL_ROUNDS");
    return wish ? std::max(std::atoi(wish), 4) : 200;
}

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

class KillTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whileSaving() {
        const fs::path folder = testing::scratchFolder("kill-document");
        const fs::path file = folder / "a.whorl";
        Progress progress;
        int orphans = 0;
        for (int round = 0; round < rounds(); ++round) {
            QVERIFY(runAndKill("document", file, static_cast<std::uint32_t>(round), 30000));
            const auto opened = openDocument(file, progress);
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QVERIFY(isOneOfBoth(opened->groom));
            orphans += entries(folder) > 1;
            QVERIFY2(entries(folder) <= 3, "orphans are swept by the next program");
        }
        QVERIFY2(orphans > 0, "some kills came in the middle of saving");
        QVERIFY(saveDocument(groomWith(200), file, progress).ok());
        QCOMPARE(entries(folder), std::size_t{1});
    }

    void whileExporting() {
        const fs::path folder = testing::scratchFolder("kill-package");
        const fs::path package = folder / "a.groom";
        Progress progress;
        for (int round = 0; round < rounds() / 4; ++round) {
            QVERIFY(runAndKill("package", package, static_cast<std::uint32_t>(round), 100000));
            const auto opened = openPackage(package, progress);
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QVERIFY(isOneOfBoth(opened->groom));
            QVERIFY2(entries(folder) <= 2, "orphans are swept by the next program");
        }
        QVERIFY(exportPackage(groomWith(200), package, 1, progress).ok());
        QCOMPARE(entries(folder), std::size_t{1});
    }

    void whileJournalling() {
        const fs::path folder = testing::scratchFolder("kill-journal");
        Progress progress;
        for (int round = 0; round < rounds() / 4; ++round) {
            QVERIFY(runAndKill("journal", folder, static_cast<std::uint32_t>(round), 30000));
            const auto found = findRecoveries(folder);
            QCOMPARE(found.size(), std::size_t{1});
            QCOMPARE(found[0].document, fs::path("/a.whorl"));
            const auto opened = openRecovery(found[0], progress);
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QVERIFY(isOneOfBoth(opened->groom));
            deleteRecovery(found[0]);
            QCOMPARE(entries(folder), std::size_t{0});
        }
    }
};

int main(int argc, char** argv) {
    if (argc == 4 && std::strcmp(argv[1], "--write") == 0) return writeForEver(argv[2], argv[3]);
    KillTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "kill_test.moc"
