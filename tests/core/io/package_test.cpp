// SPDX-License-Identifier: Apache-2.0
// Laws: a package gives the very hair of the groom, whatever its parts; a fault leaves the old one; a bad one is
// refused.
#include "core/io/package.h"

#include "core/hair/generate.h"
#include "core/io/file_steps.h"
#include "core/io/json_text.h"
#include "core/io/package_files.h"
#include "core/io/safe_file.h"
#include "tests/support/packages.h"

#include <QTest>
#include <cerrno>
#include <fstream>

using namespace whorl;
namespace fs = std::filesystem;
using testing::entries;
using testing::put;
using testing::rewrite;
using testing::smallGroom;
using testing::textOf;

namespace {

std::uint64_t digestOf(const Groom& groom) {
    Progress progress;
    return *hairDigest(groom, 1, std::nullopt, progress);
}

}  // namespace

class PackageTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { setFileFault({}); }

    void givesTheSameHair() {
        const fs::path folder = testing::scratchFolder("package-same");
        Progress progress;
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const Groom groom = testing::randomGroom(seed);
            // Strokes and what spreads from them stay at home.
            Groom sent = groom;
            sent.strokes = {};
            sent.setDefaults();
            const fs::path package = folder / ("a" + std::to_string(seed) + ".groom");
            const std::uint32_t parts = seed % 4;
            const auto exported = exportPackage(groom, package, parts, progress);
            QVERIFY2(exported.ok(), exported.ok() ? "" : exported.error().message.c_str());
            QVERIFY(isPackage(package));
            const auto opened = openPackage(package, progress);
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QVERIFY(opened->problems.empty());
            QCOMPARE(opened->parts.size(), static_cast<std::size_t>(parts ? parts : groom.counts->parts));
            QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(sent));
            QCOMPARE(opened->digest, digestOf(groom));
            QCOMPARE(digestOf(opened->groom), digestOf(groom));
        }
        QCOMPARE(entries(folder), std::size_t{4});
    }

    void sameGroomSameBytes() {
        const fs::path folder = testing::scratchFolder("package-bytes");
        Progress progress;
        const Groom groom = smallGroom();
        for (const char* name : {"a.groom", "b.groom"}) QVERIFY(exportPackage(groom, folder / name, 3, progress).ok());
        QCOMPARE(entries(folder / "a.groom"), std::size_t{6});
        for (const auto& entry : fs::directory_iterator(folder / "a.groom"))
            // The example for RenderMan names the folder.
            QVERIFY(entry.path().filename() == "groom.rib" ||
                    textOf(entry.path()) == textOf(folder / "b.groom" / entry.path().filename()));
    }

    void partsTellWhatTheyHold() {
        const fs::path package = testing::scratchFolder("package-parts") / "a.groom";
        Progress progress;
        const Groom groom = testing::randomGroom(5);
        QVERIFY(exportPackage(groom, package, 4, progress).ok());
        const auto opened = openPackage(package, progress);
        Generator generator;
        std::uint32_t next = 0;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const PackagePart& part = opened->parts[i];
            const auto hair = generator.generate(opened->groom, {.part = i, .partCount = 4}, progress);
            QCOMPARE(part.range.first, next);
            next = part.range.last;
            QCOMPARE(part.hairs, std::uint64_t{hair->count()});
            QCOMPARE(part.vertices, std::uint64_t{hair->vertexCount()});
            QCOMPARE(part.bytes, std::uint64_t{fs::file_size(package / part.file)});
            QVERIFY(part.bounds.min == hair->bounds().min && part.bounds.max == hair->bounds().max);
            Hasher hasher;
            hair->addTo(hasher);
            QCOMPARE(part.digest, hasher.digest());
            QVERIFY(std::is_sorted(part.triangles.begin(), part.triangles.end()));
            for (const SurfacePoint& root : hair->roots)
                QVERIFY(std::binary_search(part.triangles.begin(), part.triangles.end(), root.triangle));
        }
        QCOMPARE(next, SurfaceCurve::end);
    }

    void nothingGrows() {
        const fs::path package = testing::scratchFolder("package-none") / "a.groom";
        Progress progress;
        for (const Groom& groom : {smallGroom(0), makeGroom(testing::plane(1))}) {
            const auto exported = exportPackage(groom, package, 3, progress);
            QVERIFY2(exported.ok(), exported.ok() ? "" : exported.error().message.c_str());
            const auto opened = openPackage(package, progress);
            QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
            QVERIFY(opened->parts[1].bounds.empty());
        }
        QVERIFY(!exportPackage(smallGroom(), package, 4097, progress).ok());
    }

    void everyFaultKeepsTheOldPackage_data() {
        QTest::addColumn<bool>("exists");
        QTest::newRow("replacing") << true;
        QTest::newRow("new") << false;
    }
    void everyFaultKeepsTheOldPackage() {
        QFETCH(bool, exists);
        const fs::path folder = testing::scratchFolder("package-fault");
        const fs::path package = folder / "a.groom";
        Progress progress;
        const Groom first = smallGroom(100), second = smallGroom(200);
        if (exists) QVERIFY(exportPackage(first, package, 2, progress).ok());
        for (int k = 0; k < 200; ++k) {
            int step = 0;
            setFileFault([&](FileStep) { return step++ == k ? ENOSPC : 0; });
            const auto exported = exportPackage(second, package, 2, progress);
            setFileFault({});
            if (exported) {
                QVERIFY(k > 15);
                QCOMPARE(testing::groomDigest(openPackage(package, progress)->groom), testing::groomDigest(second));
                QCOMPARE(entries(folder), std::size_t{1});
                return;
            }
            QVERIFY(exported.error().message.find("no space left") != std::string::npos);
            QCOMPARE(entries(folder), std::size_t{exists ? 1u : 0u});
            if (exists)
                QCOMPARE(testing::groomDigest(openPackage(package, progress)->groom), testing::groomDigest(first));
        }
        QFAIL("never exported");
    }

    void disksWithoutExchange() {
        const fs::path folder = testing::scratchFolder("package-exchange");
        const fs::path package = folder / "a.groom";
        Progress progress;
        QVERIFY(exportPackage(smallGroom(100), package, 1, progress).ok());
        // The last rename of an export changes places; refused once, it goes another way.
        const auto withFaults = [&](std::vector<int> errors) {
            int renames = 0;
            setFileFault([&, errors](FileStep step) {
                if (step != FileStep::Rename || ++renames <= 4) return 0;
                const auto at = static_cast<std::size_t>(renames - 5);
                return at < errors.size() ? errors[at] : 0;
            });
            const auto done = exportPackage(smallGroom(200), package, 1, progress);
            setFileFault({});
            return done.ok();
        };
        for (const std::vector<int>& errors : {std::vector{ENOSYS, EIO}, std::vector{EINVAL, 0, EIO}}) {
            QVERIFY(!withFaults(errors));
            QCOMPARE(openPackage(package, progress)->groom.counts->hairs, 100);
            QCOMPARE(entries(folder), std::size_t{1});
        }
        QVERIFY(withFaults({EINVAL}));
        QCOMPARE(openPackage(package, progress)->groom.counts->hairs, 200);
        QCOMPARE(entries(folder), std::size_t{1});

        // A crash between the two renames.
        fs::rename(package, folder / (temporaryStart("a.groom") + "old"));
        QVERIFY(isPackage(package));
        QCOMPARE(openPackage(package, progress)->groom.counts->hairs, 200);
    }

    void cancelledExportsChangeNothing() {
        const fs::path folder = testing::scratchFolder("package-cancel");
        Progress progress;
        QVERIFY(exportPackage(smallGroom(100), folder / "a.groom", 2, progress).ok());
        for (const float when : {0.0f, 0.2f, 0.5f, 0.7f}) {
            Progress* self = nullptr;
            Progress stopping([&](float fraction, std::string_view) {
                if (fraction >= when) self->cancel();
            });
            self = &stopping;
            const auto exported = exportPackage(smallGroom(200), folder / "a.groom", 2, stopping);
            QVERIFY(!exported.ok() && exported.error().cancelled);
            QCOMPARE(entries(folder), std::size_t{1});
            QCOMPARE(openPackage(folder / "a.groom", progress)->groom.counts->hairs, 100);
        }
    }

    void foreignFilesAreNotReplaced() {
        const fs::path folder = testing::scratchFolder("package-foreign");
        Progress progress;
        fs::create_directory(folder / "a.groom");
        QVERIFY(exportPackage(smallGroom(), folder / "a.groom", 1, progress).ok());
        put(folder / "a.groom" / "notes.txt", "mine");
        const auto exported = exportPackage(smallGroom(), folder / "a.groom", 1, progress);
        QVERIFY(!exported.ok() && exported.error().message.find("notes.txt") != std::string::npos);
        QCOMPARE(textOf(folder / "a.groom" / "notes.txt"), std::string("mine"));
        put(folder / "file", "mine");
        QVERIFY(!exportPackage(smallGroom(), folder / "file", 1, progress).ok());
        QVERIFY(!exportPackage(smallGroom(), folder / "none" / "a.groom", 1, progress).ok());
        QVERIFY(!exportPackage(smallGroom(), "", 1, progress).ok());
        QVERIFY(!exportPackage(smallGroom(), "/", 1, progress).ok());
    }

    void linkedAndLongNames() {
        const fs::path folder = testing::scratchFolder("package-names");
        Progress progress;
        fs::create_directory(folder / "real");
        fs::create_symlink("real", folder / "link.groom");
        QVERIFY(exportPackage(smallGroom(), folder / "link.groom" / "", 1, progress).ok());
        QVERIFY(fs::is_symlink(folder / "link.groom"));
        QVERIFY(isPackage(folder / "real"));
        for (const std::string& name :
             {std::string(255, 'n'), std::string(249, 'm') + ".groom", std::string("髪 \xff")}) {
            const auto exported = exportPackage(smallGroom(), folder / name, 1, progress);
            QVERIFY2(exported.ok(), exported.ok() ? "" : exported.error().message.c_str());
            QVERIFY(openPackage(folder / name, progress).ok());
        }
    }

    void damagedPackagesAreRefused() {
        const fs::path folder = testing::scratchFolder("package-bad");
        const fs::path good = folder / "good.groom";
        Progress progress;
        QVERIFY(exportPackage(smallGroom(), good, 2, progress).ok());
        const fs::path bad = folder / "bad.groom";
        const auto refused = [&](auto&& damage) {
            fs::remove_all(bad);
            fs::copy(good, bad);
            damage();
            const auto opened = openPackage(bad, progress);
            return !opened.ok() && opened.error().message.find("bad.groom") != std::string::npos;
        };
        QVERIFY(!refused([] {}));
        // Packages of earlier versions have no example.
        QVERIFY(!refused([&] { fs::remove(bad / "groom.rib"); }));
        QVERIFY(!refused([&] { rewrite(bad, [](nlohmann::json&) {}); }));
        for (const char* name : {"groom.json", "shared.bin", "part-0000.bin", "part-0001.bin"}) {
            const std::string bytes = textOf(good / name);
            QVERIFY(refused([&] { fs::remove(bad / name); }));
            QVERIFY(refused([&] { put(bad / name, ""); }));
            QVERIFY(refused([&] { put(bad / name, bytes + "x"); }) || std::string(name) == "groom.json");
            QVERIFY(refused([&] {
                fs::remove(bad / name);
                fs::create_symlink(good / name, bad / name);
            }));
            QVERIFY(refused([&] {
                fs::remove(bad / name);
                fs::create_directory(bad / name);
            }));
            for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 60) {
                QVERIFY(refused([&] { put(bad / name, bytes.substr(0, at)); }));
                std::string flipped = bytes;
                flipped[at] = static_cast<char>(flipped[at] ^ 4);
                const bool same =
                    std::string(name) == "groom.json" && std::isspace(static_cast<unsigned char>(bytes[at]));
                QVERIFY2(refused([&] { put(bad / name, flipped); }) || same, name);
            }
        }
        QVERIFY(refused([&] {
            fs::copy_file(good / "part-0001.bin", bad / "part-0000.bin", fs::copy_options::overwrite_existing);
        }));
        const auto rewritten = [&](auto&& change) { return refused([&] { rewrite(bad, change); }); };
        using nlohmann::json;
        QVERIFY(rewritten([](json& m) { m["version"] = 3; }));
        QVERIFY(rewritten([](json& m) { m["version"] = 1; }));
        QVERIFY(rewritten([](json& m) { m["version"] = 0; }));
        QVERIFY(rewritten([](json& m) { m["format"] = "other"; }));
        QVERIFY(rewritten([](json& m) { m["parts"] = json::array(); }));
        QVERIFY(rewritten([](json& m) { m["parts"].erase(1); }));
        QVERIFY(rewritten([](json& m) { m["parts"][0]["file"] = "../good.groom/part-0000.bin"; }));
        QVERIFY(rewritten([](json& m) { m["shared"]["file"] = "/etc/passwd"; }));
        QVERIFY(rewritten([](json& m) { m["parts"][1]["first_unit"] = 0; }));
        QVERIFY(rewritten([](json& m) { m["parts"][1]["bounds"] = nullptr; }));
        QVERIFY(rewritten([](json& m) { m["counts"]["hairs"] = 77; }));
        QVERIFY(rewritten([](json& m) { m.erase("groups"); }));
        QVERIFY(rewritten([](json& m) { m.erase("digest"); }));
        QVERIFY(!openPackage(folder, progress).ok());
        QVERIFY(!isPackage(folder) && !isPackage(good / "groom.json"));
    }

    void unknownKeysAreTold() {
        const fs::path package = testing::scratchFolder("package-keys") / "a.groom";
        Progress progress;
        QVERIFY(exportPackage(smallGroom(), package, 2, progress).ok());
        rewrite(package, [](nlohmann::json& m) { m["surprise"] = 1; });
        const auto opened = openPackage(package, progress);
        QVERIFY(opened.ok());
        QCOMPARE(opened->problems.size(), std::size_t{1});
        QVERIFY(opened->problems[0].find("surprise") != std::string::npos);
    }

    void realBadFilesAreRefused() {
        const auto corpus = testing::realData("packages_bad");
        const auto hostile = testing::realData("hostile/package");
        if (!corpus || !hostile) QSKIP("the folder of bad packages is not here ($WHORL_TEST_DATA)");
        const fs::path folder = testing::scratchFolder("package-corpus");
        Progress progress;
        int tried = 0;
        for (const fs::path& root : {*corpus, *hostile}) {
            for (const auto& entry : fs::recursive_directory_iterator(root)) {
                if (!entry.is_regular_file()) continue;
                ++tried;
                QVERIFY(!openPackage(entry.path(), progress).ok());
                fs::copy_file(entry.path(), folder / "groom.json", fs::copy_options::overwrite_existing);
                const auto opened = openPackage(folder, progress);
                QVERIFY2(!opened.ok() && !opened.error().message.empty(), entry.path().c_str());
                fs::permissions(folder / "groom.json", fs::perms::owner_all);
            }
        }
        QVERIFY(tried > 400);
    }
};

QTEST_APPLESS_MAIN(PackageTest)
#include "package_test.moc"
