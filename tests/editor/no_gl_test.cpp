// SPDX-License-Identifier: Apache-2.0
// A machine that can not draw: the program starts, says so, opens, edits, saves and exports.
#include "core/io/document.h"
#include "core/io/package.h"
#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/exports.h"
#include "editor/app/files.h"
#include "editor/app/groom_actions.h"
#include "editor/app/viewport/viewport_area.h"
#include "editor/app/widgets/message_bar.h"
#include "tests/editor/window.h"

#include <QLabel>
#include <QTest>

using namespace whorl;

class NoGlTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void worksWithoutAViewport() {
        const std::filesystem::path folder = testing::scratchFolder("no_gl_test");
        testing::useScratchSettings(folder);
        const std::filesystem::path file = folder / "ball.whorl";
        Progress progress;
        QVERIFY(saveDocument(testing::groomOn(testing::sphere(12, 16), 50), file, progress).ok());

        const auto window = testing::openWindow(folder / "journals");
        QVERIFY(window);
        QVERIFY(!window->viewport());
        auto* page = window->findChild<QLabel*>("no_gl");
        QVERIFY(page && page->isVisible());
        QVERIFY(page->text().contains("OpenGL"));

        QVERIFY(window->files().open(file));
        QVERIFY(window->groomActions().placeGuides(30, false));
        window->actions().get("view.all").trigger();
        window->actions().get("tool.comb").trigger();
        QVERIFY(window->files().saveTo(folder / "saved.whorl"));
        const Result<OpenedDocument> opened = openDocument(folder / "saved.whorl", progress);
        QVERIFY(opened.ok());
        QCOMPARE(testing::groomDigest(opened->groom), testing::groomDigest(window->document().committed()));
        QVERIFY2(window->exports().exportPackage(folder / "ball.groom"),
                 qPrintable(window->area().messages().sentence()));
        QVERIFY(isPackage(folder / "ball.groom"));
    }
};

int main(int argc, char** argv) {
    qputenv("WHORL_NO_GL", "1");
    QApplication application(argc, argv);
    NoGlTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "no_gl_test.moc"
