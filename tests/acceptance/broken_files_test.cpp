// SPDX-License-Identifier: Apache-2.0
// Files that claim to be broken: one sentence and exit status 1, in 2 s and 1 GiB; never a signal.
#include "tests/support/run.h"
#include "tests/support/shapes.h"

#include <QtTest>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

using whorl::testing::realData;
using whorl::testing::RunResult;
namespace fs = std::filesystem;

namespace {

enum class Expect { Refused, Survived };

/// Runs the program on one file and gives what is wrong with how it ended, or nothing.
QString fault(const RunResult& result, const fs::path& file, Expect expect) {
    const QString name = QString::fromStdString(file.filename().string());
    if (result.signal != 0) return name + QString(": ended by signal %1").arg(result.signal);
    if (result.seconds > 2.0) return name + QString(": took %1 s").arg(result.seconds);
    if (result.peakMegabytes > 1024) return name + QString(": took %1 MiB").arg(result.peakMegabytes);
    if (result.status == 0) return expect == Expect::Survived ? QString() : name + ": was accepted";
    if (result.status != 1) return name + QString(": exit status %1").arg(result.status);
    const QString said = QString::fromStdString(result.err).trimmed();
    if (said.isEmpty()) return name + ": refused without a sentence";
    if (said.contains('\n')) return name + ": more than one line: " + said;
    if (!said.endsWith('.')) return name + ": not a sentence: " + said;
    return {};
}

std::vector<fs::path> filesBelow(const fs::path& folder, const std::function<bool(const fs::path&)>& wanted) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && wanted(entry.path())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool isGltf(const fs::path& p) {
    return p.extension() == ".gltf" || p.extension() == ".glb";
}

void report(const QStringList& faults, std::size_t count) {
    qInfo("%zu files, %lld faults", count, static_cast<long long>(faults.size()));
    QVERIFY2(faults.isEmpty(), qPrintable(faults.mid(0, 25).join("\n")));
}

}  // namespace

class BrokenFilesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() {
        if (!realData("hostile/INDEX.tsv")) QSKIP("The folder of real data is not here.");
        m_folder = whorl::testing::scratchFolder("broken_files");
    }

    void hostileFilesEndAsTheirIndexSays() {
        std::ifstream index(*realData("hostile/INDEX.tsv"));
        std::string line;
        std::getline(index, line);
        QStringList faults;
        std::size_t count = 0;
        while (std::getline(index, line)) {
            std::istringstream row(line);
            std::string name, bytes, what, expected;
            std::getline(row, name, '\t');
            std::getline(row, bytes, '\t');
            std::getline(row, what, '\t');
            std::getline(row, expected, '\t');
            const fs::path file = *realData("hostile") / name;
            const bool image = name.starts_with("image/");
            const auto result = image ? asDensity(file) : info(file);
            const QString wrong =
                fault(result, file,
                      expected.starts_with("REJECT") && expected == "REJECT" ? Expect::Refused : Expect::Survived);
            if (!wrong.isEmpty()) {
                faults << wrong;
            } else if ((expected.starts_with("LOAD") && !QString::fromStdString(expected).contains("REJECT")) ||
                       expected == "REPAIR") {
                if (result.status != 0) {
                    faults << QString::fromStdString(name + " should load (" + what + "): " + result.err);
                }
            }
            ++count;
        }
        QVERIFY(count > 50);
        report(faults, count);
    }

    void invalidGltf() {
        QStringList faults;
        const auto files = filesBelow(*realData("gltf_invalid"), isGltf);
        std::size_t loaded = 0;
        for (const fs::path& file : files) {
            const auto result = info(file);
            if (result.status == 0) ++loaded;
            const QString wrong = fault(result, file, Expect::Survived);
            if (!wrong.isEmpty()) faults << wrong;
        }
        qInfo("%zu of %zu have faults that do not touch the mesh, and load", loaded, files.size());
        report(faults, files.size());
    }

    void brokenPackagesAndDocuments() {
        QStringList faults;
        const auto files = filesBelow(*realData("packages_bad"), [](const fs::path& p) {
            return p.extension() == ".zip" || p.extension() == ".json";
        });
        for (const fs::path& file : files) {
            const QString wrong = fault(info(file), file, Expect::Refused);
            if (!wrong.isEmpty()) faults << wrong;
        }
        report(faults, files.size());
    }

    void brokenImages() {
        QStringList faults;
        // Every file of the folder, also those of formats that Whorl does not read.
        const auto files = filesBelow(*realData("images_bad"), [](const fs::path&) { return true; });
        std::size_t loaded = 0;
        for (const fs::path& file : files) {
            const auto result = asDensity(file);
            if (result.status == 0) ++loaded;
            const QString wrong = fault(result, file, Expect::Survived);
            if (!wrong.isEmpty()) faults << wrong;
        }
        qInfo("%zu of %zu could be read all the same", loaded, files.size());
        report(faults, files.size());
    }

private:
    /// The quicker of two runs when the first took too long: other programs may have had the processor.
    static RunResult quickest(const std::vector<std::string>& arguments) {
        RunResult first = whorl::testing::run("whorl-cli", arguments, 10.0);
        return first.seconds <= 2.0 ? first : whorl::testing::run("whorl-cli", arguments, 10.0);
    }

    RunResult info(const fs::path& file) { return quickest({"info", file.string()}); }

    RunResult asDensity(const fs::path& image) {
        const fs::path mesh = *realData("hostile/gltf/ok_baseline.glb");
        return quickest({"new", mesh.string(), "--guides", "3", "--density", image.string(), "-o",
                         (m_folder / "out.whorl").string()});
    }

    fs::path m_folder;
};

QTEST_GUILESS_MAIN(BrokenFilesTest)
#include "broken_files_test.moc"
