// SPDX-License-Identifier: Apache-2.0
// Every broken and valid image of $WHORL_TEST_DATA: read or refused, never the end of this program.
#include "core/io/image.h"
#include "tests/support/shapes.h"

#include <QTest>
#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

using namespace whorl;
namespace fs = std::filesystem;

namespace {

// One sentence that names the file.
bool goodSentence(const std::string& text, const std::string& name) {
    return text.find(name) != std::string::npos && text.back() == '.' && text.find('\n') == std::string::npos;
}

}  // namespace

class ImageCorpusTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyBadImageIsSurvived() { corpus("images_bad", false, 1); }
    // Each start of the worker costs a quarter of a second: every sixth, all with WHORL_TEST_ALL.
    void validImagesAreRead() { corpus("images_valid", true, qEnvironmentVariableIsSet("WHORL_TEST_ALL") ? 1 : 6); }

private:
    // Two at a time: most of the time goes into starting the worker.
    void corpus(const std::string& name, bool mustLoad, std::size_t step) {
        const auto folder = testing::realData(name);
        if (!folder) QSKIP("the folder of images is not here");
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
            if (entry.is_regular_file()) files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        std::atomic<std::size_t> next{0};
        std::mutex mutex;
        std::string fault;
        const auto work = [&] {
            for (std::size_t i = next++ * step; i < files.size(); i = next++ * step) {
                const auto read = readImage(files[i], ImageUse::Colour);
                const std::lock_guard lock(mutex);
                const std::string file = files[i].filename().string();
                if (!read && !goodSentence(read.error().message, file)) fault = read.error().message;
                if (!read && mustLoad && files[i].extension() == ".png") fault = read.error().message;
                if (read && (read->width() < 1 || read->channels() != 3)) fault = file;
            }
        };
        std::thread other(work);
        work();
        other.join();
        QVERIFY2(fault.empty(), fault.c_str());
        QVERIFY(!files.empty());
    }
};

QTEST_APPLESS_MAIN(ImageCorpusTest)
#include "image_corpus_test.moc"
