// SPDX-License-Identifier: Apache-2.0
// The library as a file: what it links, what it shows, and whether a stranger's program finds it once installed.
#include "tests/core/procedural/procedural_hair.h"
#include "tests/support/run.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace whorl;
using namespace whorl::testing;
namespace fs = std::filesystem;

namespace {

fs::path build() {
    return fs::path(std::getenv("WHORL_BIN")).parent_path();
}

fs::path source() {
    return fs::path(std::getenv("WHORL_RESOURCES")).parent_path();
}

const fs::path library = build() / "lib" / "libwhorl_procedural.so";
const bool sanitized = std::string_view(WHORL_SANITIZE) != "";

std::string textOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// What the shell prints for the command; its status too.
std::pair<int, std::string> shell(const std::string& command) {
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    return {pclose(pipe), text};
}

std::vector<std::string> wordsOf(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace

class LibraryTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void linksNothingHeavy() {
        if (sanitized) QSKIP("sanitizers add libraries of their own");
        const auto [status, text] =
            shell("readelf -d " + library.string() + " | sed -n 's/.*(NEEDED).*\\[\\(.*\\)\\].*/\\1/p'");
        QCOMPARE(status, 0);
        const std::vector<std::string> allowed{"libtbb.so.12",  "libzstd.so.1", "libstdc++.so.6",      "libm.so.6",
                                               "libgcc_s.so.1", "libc.so.6",    "ld-linux-x86-64.so.2"};
        QVERIFY(wordsOf(text).size() > 3);
        for (const std::string& name : wordsOf(text))
            QVERIFY2(std::ranges::find(allowed, name) != allowed.end(), name.c_str());
        // Nor through others.
        const auto [bad, all] = shell("ldd " + library.string());
        QCOMPARE(bad, 0);
        for (const char* heavy : {"Qt", "libGL", "libEGL", "epoxy", "OpenImageIO", "libX"})
            QVERIFY2(all.find(heavy) == std::string::npos, all.c_str());
        QVERIFY(shell("readelf -d " + library.string()).second.find("soname: [libwhorl_procedural.so.1]") !=
                std::string::npos);
    }

    void showsOnlyItsInterface() {
        const auto [status, text] =
            shell("nm -D --defined-only --format=posix " + library.string() + " | sed 's/ .*//; s/@.*//' | sort -u");
        QCOMPARE(status, 0);
        const std::string header = textOf(source() / "core" / "procedural" / "whorl_procedural.h");
        const std::vector<std::string> renderMan{"ConvertParameters", "Subdivide", "Free", "Subdivide2", "Bound"};
        std::size_t count = 0;
        for (const std::string& name : wordsOf(text)) {
            if (name == "WHORL_1.0") continue;
            const bool ours = name.starts_with("whorl_") && header.find(" " + name + "(") != std::string::npos;
            const bool theirs = std::ranges::find(renderMan, name) != renderMan.end();
            QVERIFY2(ours || theirs, name.c_str());
            ++count;
        }
        // All that the header declares.
        std::size_t declared = 0;
        for (std::size_t at = header.find("\nWHORL_API "); at != std::string::npos;
             at = header.find("\nWHORL_API ", at + 1))
            ++declared;
        QVERIFY(count >= declared && declared > 15);
    }

    void nothingPrintsOrExits() {
        const auto [status, text] =
            shell("nm -D --undefined-only --format=posix " + library.string() + " | sed 's/ .*//; s/@.*//'");
        QCOMPARE(status, 0);
        if (sanitized) QSKIP("sanitizers print and exit");
        for (const std::string& name : wordsOf(text)) {
            for (const char* never : {"exit", "_exit", "quick_exit", "printf", "puts", "putchar", "fork", "system",
                                      "_ZSt4cout", "_ZSt4cerr"})
                QVERIFY2(name != never, name.c_str());
        }
    }

    void aStrangersProgramRuns() {
        Groom groom = groomOn(sphere(8, 12), 20, 6);
        groom.counts.edit().hairs = 300;
        const fs::path folder = scratchFolder("library-program");
        const fs::path package = exported(groom, folder / "a.groom", 2);
        const auto built = run("../tests/hair_of_a_package", {package.string()});
        QCOMPARE(built.status, 0);
        QVERIFY2(built.out.find("part 1: x ") != std::string::npos, built.out.c_str());
        QVERIFY2(built.out.find("300 hairs, tips ") != std::string::npos, built.out.c_str());
        const auto refused = run("../tests/hair_of_a_package", {(folder / "none.groom").string()});
        QCOMPARE(refused.status, 1);
        QVERIFY(refused.err.find("none.groom") != std::string::npos);

        if (sanitized) QSKIP("the installed library is tested without sanitizers");
        const std::string prefix = (folder / "prefix").string();
        const auto installed =
            shell("cmake --install " + build().string() + " --component procedural --prefix " + prefix);
        QVERIFY2(installed.first == 0, installed.second.c_str());
        const fs::path code = source() / "resources" / "integrations" / "c" / "hair_of_a_package.c";
        const auto found = shell("PKG_CONFIG_PATH=$(dirname $(find " + prefix +
                                 " -name '*.pc')); export PKG_CONFIG_PATH; cc -std=c99 -Wall -Werror " + code.string() +
                                 " -o " + prefix + "/example $(pkg-config --cflags --libs whorl-procedural) && " +
                                 "LD_LIBRARY_PATH=$(pkg-config --variable=libdir whorl-procedural) " + prefix +
                                 "/example " + package.string());
        QVERIFY2(found.first == 0, found.second.c_str());
        QCOMPARE(found.second, built.out);

        // The other way: find_package.
        std::ofstream(folder / "CMakeLists.txt")
            << "cmake_minimum_required(VERSION 3.22)\nproject(stranger LANGUAGES C)\n"
               "find_package(WhorlProcedural REQUIRED)\nadd_executable(stranger "
            << code.string() << ")\ntarget_link_libraries(stranger Whorl::whorl_procedural)\n";
        const auto configured =
            shell("cmake -S " + folder.string() + " -B " + prefix + "/build -DCMAKE_PREFIX_PATH=" + prefix +
                  " && cmake --build " + prefix + "/build && " + prefix + "/build/stranger " + package.string());
        QVERIFY2(configured.first == 0 && configured.second.ends_with(built.out), configured.second.c_str());
    }

    void theReadMeShowsThatProgram() {
        const std::string code = textOf(source() / "resources" / "integrations" / "c" / "hair_of_a_package.c");
        QVERIFY(!code.empty());
        QVERIFY(textOf(source() / "README.md").find(code) != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(LibraryTest)
#include "library_test.moc"
