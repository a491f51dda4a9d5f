// SPDX-License-Identifier: Apache-2.0
// Laws: after any failure the old file is as it was and nothing else is left; after success the new one is there.
#include "core/io/safe_file.h"

#include "core/io/file_steps.h"
#include "tests/support/packages.h"

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QTest>
#include <cerrno>
#include <fstream>

using namespace whorl;
namespace fs = std::filesystem;
using testing::entries;
using testing::put;
using testing::textOf;

namespace {

Result<void> save(const fs::path& file, const std::string& text) {
    auto safe = SafeFile::create(file);
    if (!safe) return safe.error();
    for (std::size_t at = 0; at < text.size(); at += 100000) {
        auto done = safe->write(text.data() + at, std::min<std::size_t>(100000, text.size() - at));
        if (!done) return done;
    }
    return safe->commit();
}

bool contains(const Result<void>& result, const char* words) {
    return !result && result.error().message.find(words) != std::string::npos;
}

/// What `body` returns in a child process, whose limits, rights and mounts end with it; -1 when it was killed.
template <class Body>
int inChild(Body&& body) {
    const pid_t child = fork();
    if (child == 0) _exit(body());
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

class SafeFileTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { setFileFault({}); }

    void writesAndReplaces() {
        const fs::path folder = testing::scratchFolder("safe-write");
        const fs::path file = folder / "a.whorl";
        const std::string big(3000000, 'x');
        for (const std::string& text : {std::string("first"), std::string(), big, std::string("last")}) {
            QVERIFY(save(file, text).ok());
            QCOMPARE(textOf(file), text);
            QCOMPARE(entries(folder), std::size_t{1});
        }
    }

    void withoutCommitNothingHappens() {
        const fs::path folder = testing::scratchFolder("safe-drop");
        put(folder / "a", "old");
        {
            auto safe = SafeFile::create(folder / "a");
            QVERIFY(safe.ok());
            QVERIFY(safe->write("new", 3).ok());
            QCOMPARE(entries(folder), std::size_t{2});
        }
        QCOMPARE(textOf(folder / "a"), std::string("old"));
        QCOMPARE(entries(folder), std::size_t{1});
    }

    void everyStepMayFail_data() {
        QTest::addColumn<bool>("exists");
        QTest::addColumn<int>("error");
        QTest::newRow("old file, full disk") << true << ENOSPC;
        QTest::newRow("old file, broken disk") << true << EIO;
        QTest::newRow("new file, full disk") << false << ENOSPC;
        QTest::newRow("new file, read-only disk") << false << EROFS;
    }
    void everyStepMayFail() {
        QFETCH(bool, exists);
        QFETCH(int, error);
        const fs::path folder = testing::scratchFolder("safe-fault");
        const fs::path file = folder / "a.whorl";
        if (exists) put(file, "old");
        const std::string text(2000000, 'y');
        int failures = 0;
        for (int k = 0;; ++k) {
            int step = 0;
            setFileFault([&](FileStep) { return step++ == k ? error : 0; });
            const auto saved = save(file, text);
            setFileFault({});
            if (saved) {
                QVERIFY2(step <= k, "a fault was swallowed");
                break;
            }
            ++failures;
            QVERIFY2(contains(saved, fileCause(error).c_str()), saved.error().message.c_str());
            QVERIFY(contains(saved, "a.whorl"));
            QVERIFY2(contains(saved, "byte"), saved.error().message.c_str());
            QCOMPARE(entries(folder), std::size_t{exists ? 1u : 0u});
            if (exists) QCOMPARE(textOf(file), std::string("old"));
        }
        QVERIFY2(failures >= 8, "open, some writes, sync, rename, folder");
        QCOMPARE(textOf(file), text);
    }

    void sizeLimitIsAnError() {
        const fs::path folder = testing::scratchFolder("safe-limit");
        const fs::path file = folder / "a";
        put(file, "old");
        QCOMPARE(inChild([&] {
                     const rlimit limit{50000, 50000};
                     setrlimit(RLIMIT_FSIZE, &limit);
                     return contains(save(file, std::string(1000000, 'z')), "size limit") ? 0 : 1;
                 }),
                 0);
        QCOMPARE(textOf(file), std::string("old"));
        QCOMPARE(entries(folder), std::size_t{1});
    }

    void fullDisk() {
        const fs::path folder = testing::scratchFolder("safe-full");
        // A small disk of its own, in a child: 0 as it should be, 1 not, 2 not allowed to make one.
        const int outcome = inChild([&] {
            if (unshare(geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS) != 0 ||
                mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
                mount("small", folder.c_str(), "tmpfs", 0, "size=256k") != 0)
                return 2;
            const fs::path file = folder / "a";
            if (!save(file, std::string(100000, 'o'))) return 1;
            const auto saved = save(file, std::string(1000000, 'z'));
            return contains(saved, "no space left") && contains(saved, "are free") && entries(folder) == 1 &&
                           textOf(file) == std::string(100000, 'o')
                       ? 0
                       : 1;
        });
        if (outcome == 2) QSKIP("making a small disk is not allowed here");
        QCOMPARE(outcome, 0);
    }

    void devicesAreRefused() {
        QVERIFY(!SafeFile::create("/dev/full").ok());
        QVERIFY(!SafeFile::create("/dev/null").ok());
    }

    void readOnlyFolder() {
        const fs::path folder = testing::scratchFolder("safe-readonly");
        put(folder / "a", "old");
        fs::permissions(folder, fs::perms(0555));
        const int outcome = inChild([&] {
            // The administrator may write everywhere, so be somebody else.
            if (geteuid() == 0 && setuid(65534) != 0) return 2;
            return contains(save(folder / "b", "new"), "permission") && !save(folder / "a", "new") ? 0 : 1;
        });
        fs::permissions(folder, fs::perms::owner_all);
        QCOMPARE(outcome, 0);
        QCOMPARE(textOf(folder / "a"), std::string("old"));
        QCOMPARE(entries(folder), std::size_t{1});
    }

    void missingFolderAndFolders() {
        const fs::path folder = testing::scratchFolder("safe-missing");
        QVERIFY(contains(save(folder / "no" / "a", "x"), "does not exist"));
        QVERIFY(contains(save(folder, "x"), "folder"));
        QVERIFY(!save(folder / "", "x").ok());
        QVERIFY(!save("", "x").ok());
        put(folder / "f", "x");
        QVERIFY(contains(save(folder / "f" / "a", "x"), "not a folder"));
    }

    void namesOfAnyLength() {
        const fs::path folder = testing::scratchFolder("safe-names");
        std::vector<std::string> names;
        for (std::size_t length = 195; length <= 255; length += 5) names.push_back(std::string(length, 'n'));
        std::string hair;
        while (hair.size() + 3 <= 255) hair += "髪";
        names.push_back(hair);
        names.push_back("e\xcc\x81 \xf0\x9f\x92\x87 \xd8\xb4\xd8\xb9\xd8\xb1.whorl");
        names.push_back("line\nbreak \"quotes\" 'n' $x *.whorl");
        names.push_back("bad utf-8 \xff\xfe.whorl");
        names.push_back("-rf");
        names.push_back(std::string(63, 'a') + "é" + std::string(60, 'b'));
        for (const std::string& name : names) {
            QVERIFY2(save(folder / name, "one").ok(), name.c_str());
            const auto saved = save(folder / name, "two");
            QVERIFY2(saved.ok(), name.c_str());
            QCOMPARE(textOf(folder / name), std::string("two"));
        }
        QCOMPARE(entries(folder), names.size());
        QVERIFY(contains(save(folder / std::string(256, 'n'), "x"), "too long"));
    }

    void linksAreFollowed() {
        const fs::path folder = testing::scratchFolder("safe-links");
        fs::create_directory(folder / "real");
        put(folder / "real" / "a", "old");
        fs::create_symlink("real/a", folder / "one");
        fs::create_symlink(folder / "one", folder / "two");
        fs::create_symlink("real/new", folder / "dangling");
        QVERIFY(save(folder / "two", "new").ok());
        QVERIFY(fs::is_symlink(folder / "two"));
        QVERIFY(fs::is_symlink(folder / "one"));
        QCOMPARE(textOf(folder / "real" / "a"), std::string("new"));
        QVERIFY(save(folder / "dangling", "made").ok());
        QCOMPARE(textOf(folder / "real" / "new"), std::string("made"));
        fs::create_symlink("circle", folder / "circle");
        QVERIFY(!save(folder / "circle", "x").ok());
    }

    void permissionsStay() {
        const fs::path folder = testing::scratchFolder("safe-modes");
        const fs::path file = folder / "a";
        for (const mode_t mode : {mode_t{0600}, mode_t{0644}, mode_t{0664}, mode_t{0755}}) {
            put(file, "old");
            ::chmod(file.c_str(), mode);
            QVERIFY(save(file, "new").ok());
            struct stat status {};
            ::stat(file.c_str(), &status);
            QCOMPARE(status.st_mode & 0777, mode);
        }
        const mode_t mask = umask(027);
        const auto saved = save(folder / "fresh", "x");
        umask(mask);
        QVERIFY(saved.ok());
        struct stat status {};
        ::stat((folder / "fresh").c_str(), &status);
        QCOMPARE(status.st_mode & 0777, mode_t{0640});
    }

    void sweepsOnlyWhatNobodyHolds() {
        const fs::path folder = testing::scratchFolder("safe-sweep");
        const fs::path file = folder / "a.whorl";
        const fs::path orphan = folder / temporaryName("a.whorl");
        const fs::path others = folder / temporaryName("b.whorl");
        const fs::path own = folder / ".a.whorl.backup";
        for (const fs::path& path : {file, orphan, others, own}) put(path, "x");
        auto held = SafeFile::create(file);  // sweeps, and holds its own
        QVERIFY(held.ok());
        QVERIFY(!fs::exists(orphan));
        QVERIFY(fs::exists(others));
        QVERIFY(fs::exists(own));
        QVERIFY(held->write("new", 3).ok());
        sweepOrphans(file);
        QVERIFY(held->commit().ok());
        QCOMPARE(textOf(file), std::string("new"));
    }

    void completeShowsWhatWillBeThere() {
        const fs::path folder = testing::scratchFolder("safe-complete");
        auto safe = SafeFile::create(folder / "a");
        QVERIFY(safe->write("new", 3).ok());
        const auto temporary = safe->complete();
        QVERIFY(temporary.ok());
        QCOMPARE(textOf(*temporary), std::string("new"));
        QVERIFY(!fs::exists(folder / "a"));
        QVERIFY(safe->commit().ok());
        QVERIFY(!safe->commit().ok());
        QVERIFY(!safe->write("x", 1).ok());
    }

    void reads() {
        const fs::path folder = testing::scratchFolder("safe-read");
        put(folder / "a", "hello");
        QCOMPARE(readFile(folder / "a", 5)->size(), std::size_t{5});
        QVERIFY(!readFile(folder / "a", 4).ok());
        QVERIFY(!readFile(folder / "none", 4).ok());
        QVERIFY(!readFile(folder, 4).ok());
        QVERIFY(!readFile("/dev/zero", 4).ok());
        QCOMPARE(mkfifo((folder / "pipe").c_str(), 0600), 0);
        QVERIFY(!readFile(folder / "pipe", 4).ok());
    }
};

QTEST_APPLESS_MAIN(SafeFileTest)
#include "safe_file_test.moc"
