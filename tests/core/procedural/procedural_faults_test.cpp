// SPDX-License-Identifier: Apache-2.0
// Laws: bad packages and documents and too little memory give a sentence through the C interface, never a crash.
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/io/document.h"
#include "core/io/json_text.h"
#include "tests/core/procedural/procedural_hair.h"
#include "tests/support/documents.h"
#include "tests/support/packages.h"

#include <QTest>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>

using namespace whorl;
using namespace whorl::testing;
namespace fs = std::filesystem;
using testing::put;
using testing::rewrite;
using testing::smallGroom;
using testing::textOf;

namespace {

// Allocations of all of the program, the library's among them, fail from the one with this number on. Not small ones:
// the JSON library takes up to some kilobytes in a destructor, where no failure can be told.
constexpr std::size_t leastToFail = 4096;
std::atomic<long> allocationsLeft{-1};

void* allocate(std::size_t size) {
    if (size >= leastToFail && allocationsLeft.load(std::memory_order_relaxed) >= 0 &&
        allocationsLeft.fetch_sub(1, std::memory_order_relaxed) <= 0) {
        allocationsLeft.store(0, std::memory_order_relaxed);
        throw std::bad_alloc();
    }
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size);
}
void* operator new[](std::size_t size) {
    return allocate(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace {

/// Refused with a sentence that names the file.
bool refused(const fs::path& path) {
    const Opened opened(path);
    return !opened && opened.status == WHORL_BAD_FILE &&
           std::string_view(opened.error.text).find(path.filename().string()) != std::string_view::npos;
}

/// Opened and made into hair, or refused with a sentence: nothing else may happen.
bool survives(const Opened& opened) {
    if (!opened) return std::strlen(opened.error.text) > 10;
    WhorlRequest request = WHORL_REQUEST_INIT;
    request.part_count = 1;
    request.share = whorl_share_for_count(opened, 2000);
    float box[6];
    WhorlError error{""};
    const WhorlStatus status = whorl_box(opened, &request, box, &error);
    return status == WHORL_OK || std::strlen(error.text) > 10;
}

}  // namespace

class ProceduralFaultsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void damagedPackages() {
        const fs::path folder = scratchFolder("procedural-bad");
        const fs::path good = exported(smallGroom(), folder / "good.groom", 2);
        const fs::path bad = folder / "bad.groom";
        const auto damaged = [&](auto&& damage) {
            fs::remove_all(bad);
            fs::copy(good, bad);
            damage();
            return refused(bad);
        };
        QVERIFY(!damaged([] {}));
        for (const char* name : {"groom.json", "shared.bin", "part-0000.bin", "part-0001.bin"}) {
            const std::string bytes = textOf(good / name);
            const bool manifest = std::string(name) == "groom.json";
            QVERIFY(damaged([&] { fs::remove(bad / name); }));
            QVERIFY(damaged([&] { put(bad / name, bytes + "x"); }) || manifest);
            QVERIFY(damaged([&] {
                fs::remove(bad / name);
                fs::create_symlink(good / name, bad / name);
            }));
            QVERIFY(damaged([&] {
                fs::remove(bad / name);
                fs::create_symlink("/dev/zero", bad / name);
            }));
            QVERIFY(damaged([&] {
                fs::remove(bad / name);
                fs::create_directory(bad / name);
            }));
            for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 25) {
                QVERIFY(damaged([&] { put(bad / name, bytes.substr(0, at)); }));
                std::string flipped = bytes;
                flipped[at] = static_cast<char>(flipped[at] ^ 4);
                QVERIFY(damaged([&] { put(bad / name, flipped); }) || (manifest && std::isspace(bytes[at])));
            }
        }
    }

    void packagesThatLieUnderRightChecksums() {
        const fs::path folder = scratchFolder("procedural-lies");
        const fs::path good = exported(smallGroom(), folder / "good.groom", 2);
        const fs::path bad = folder / "bad.groom";
        using nlohmann::json;
        const auto lying = [&](auto&& change) {
            fs::remove_all(bad);
            fs::copy(good, bad);
            rewrite(bad, change);
            return refused(bad);
        };
        QVERIFY(lying([](json& m) { m["version"] = 1; }));
        QVERIFY(lying([](json& m) { m["version"] = 99; }));
        QVERIFY(lying([](json& m) { m["version"] = -1; }));
        QVERIFY(lying([](json& m) { m["parts"] = json::array(); }));
        QVERIFY(lying([](json& m) { m["parts"].erase(1); }));
        QVERIFY(lying([](json& m) { m["parts"] = 4e9; }));
        QVERIFY(lying([](json& m) { m["parts"][0]["file"] = "../good.groom/part-0000.bin"; }));
        QVERIFY(lying([](json& m) { m["parts"][0]["file"] = "/dev/zero"; }));
        QVERIFY(lying([](json& m) { m["shared"]["file"] = "../good.groom/shared.bin"; }));
        QVERIFY(lying([](json& m) { m["shared"]["bytes"] = 1e18; }));
        QVERIFY(lying([](json& m) { m["parts"][0]["bytes"] = 0xffffffffffffffffull; }));
        QVERIFY(lying([](json& m) { m["parts"][0]["hairs"] = 0xffffffffffffffffull; }));
        QVERIFY(lying([](json& m) { m["parts"][0]["bounds"][0][0] = nullptr; }));
        QVERIFY(lying([](json& m) { m["parts"][0]["bounds"][0][0] = 1e39; }));
        QVERIFY(lying([](json& m) { m["counts"]["hairs"] = 5; }));
        // Out of range: the parameter keeps its default, which makes other hair than the parts say.
        QVERIFY(lying([](json& m) { m["counts"]["hairs"] = 4e18; }));
        QVERIFY(lying([](json& m) { m["version"] = 3; }));
        QVERIFY(lying([](json& m) {
            m["version"] = 3;
            m["frames"] = {{"first", 1}, {"last", 2}, {"per_second", 24}};
        }));
        QVERIFY(lying([](json& m) {
            m["version"] = 3;
            m["frames"] = {{"first", 1}, {"last", 2e9}, {"per_second", 24}};
        }));
        lying([](json& m) { m["groups"] = json::array(); });
        QVERIFY(survives(Opened(bad)));
        for (const char* number : {"1e999", "NaN", "-Infinity", "null"}) {
            fs::remove_all(bad);
            fs::copy(good, bad);
            std::string text = textOf(bad / "groom.json");
            const std::size_t at = text.find("\"hairs\": ") + 9;
            text.replace(at, text.find_first_of(",\n", at) - at, number);
            put(bad / "groom.json", text);
            QVERIFY(refused(bad));
        }
    }

    void strangePaths() {
        const fs::path folder = scratchFolder("procedural-paths");
        const fs::path good = exported(smallGroom(), folder / "good.groom", 1);
        QVERIFY(Opened(folder / "x" / ".." / "good.groom").status == WHORL_BAD_FILE);
        QVERIFY(Opened(good / "").status == WHORL_OK);
        fs::create_symlink("good.groom", folder / "link.groom");
        QVERIFY(Opened(folder / "link.groom").status == WHORL_OK);
        fs::create_symlink("loop", folder / "loop");
        for (const fs::path& path : {folder / "loop", folder, folder / "none", fs::path(""), fs::path("/"),
                                     fs::path("/dev/zero"), fs::path("/dev/null"), good / "groom.json",
                                     good / "shared.bin", fs::path(std::string(5000, 'a')), fs::path("a\nb")}) {
            const Opened opened(path);
            QVERIFY2(!opened && opened.status == WHORL_BAD_FILE && std::strlen(opened.error.text) > 10, path.c_str());
        }
    }

    void documentsInMemory() {
        const auto bytes = documentBytes(smallGroom());
        for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 300) {
            const Opened opened(bytes.data(), size);
            QVERIFY(!opened && opened.status == WHORL_BAD_FILE && std::strlen(opened.error.text) > 10);
        }
        // Behind right checksums: NaN, huge counts, indices out of range.
        int opens = 0;
        for (std::uint64_t round = 0; round < 150; ++round) {
            std::vector<std::uint8_t> choices(11 * (1 + round % 4));
            for (std::size_t i = 0; i < choices.size(); ++i)
                choices[i] = static_cast<std::uint8_t>(randomBits(5, round, static_cast<std::uint32_t>(i)));
            const auto document = mutatedDocument(choices);
            const Opened opened(document.data(), document.size());
            QVERIFY(survives(opened));
            opens += opened.status == WHORL_OK;
        }
        QVERIFY(opens > 10 && opens < 150);
    }

    void strangersFiles() {
        const auto corpus = realData("packages_bad");
        const auto hostile = realData("hostile");
        if (!corpus || !hostile) QSKIP("the folder of bad packages is not here ($WHORL_TEST_DATA)");
        const fs::path folder = scratchFolder("procedural-corpus");
        int tried = 0;
        for (const fs::path& root : {*corpus, *hostile / "package"}) {
            for (const auto& entry : fs::recursive_directory_iterator(root)) {
                if (!entry.is_regular_file()) continue;
                ++tried;
                QVERIFY(!Opened(entry.path()));
                fs::copy_file(entry.path(), folder / "groom.json", fs::copy_options::overwrite_existing);
                QVERIFY2(refused(folder), entry.path().c_str());
                fs::permissions(folder / "groom.json", fs::perms::owner_all);
            }
        }
        QVERIFY(tried > 400);
    }

    void tooLittleMemory() {
        Groom larger = groomOn(sphere(24, 36), 200, 12);
        larger.counts.edit().hairs = 3000;
        larger.groups.edit()[0].params.general.keepOutside = false;
        const fs::path package = exported(larger, scratchFolder("procedural-memory") / "a.groom", 1);
        WhorlError error{""};
        const auto fails = [&](long after, auto&& call) {
            allocationsLeft = after;
            const WhorlStatus status = call();
            allocationsLeft = -1;
            return status;
        };
        WhorlGroom* groom = nullptr;
        int failed = 0;
        for (long after = 0;; ++after) {
            const WhorlStatus status =
                fails(after, [&] { return whorl_open(package.c_str(), nullptr, &groom, &error); });
            if (status == WHORL_OK) break;
            QVERIFY2(!groom && (status == WHORL_NO_MEMORY || status == WHORL_BAD_FILE), error.text);
            QVERIFY(std::strlen(error.text) > 10);
            ++failed;
        }
        QVERIFY2(failed > 10, std::to_string(failed).c_str());
        const Filled whole = fill(Opened(package), WHORL_REQUEST_INIT);
        // The first call that makes hair also makes what all hair needs.
        failed = 0;
        for (const std::uint32_t flags : {WHORL_ONE_THREAD, 0u}) {
            WhorlRequest request = WHORL_REQUEST_INIT;
            request.flags = flags;
            const auto drop = [](const WhorlHair*, void*) { return 0; };
            for (long after = 0;; ++after) {
                const WhorlStatus status =
                    fails(after, [&] { return whorl_stream(groom, &request, drop, nullptr, &error); });
                if (status == WHORL_OK) break;
                QVERIFY2(status == WHORL_NO_MEMORY && std::strlen(error.text) > 10, error.text);
                ++failed;
            }
        }
        QVERIFY2(failed > 15, std::to_string(failed).c_str());
        // Nothing is broken afterwards.
        QVERIFY(fill(groom, WHORL_REQUEST_INIT) == whole);
        whorl_close(groom);
    }
};

QTEST_APPLESS_MAIN(ProceduralFaultsTest)
#include "procedural_faults_test.moc"
