// SPDX-License-Identifier: Apache-2.0
// Baking hair texture from the window: what the dialog asks for is what lies in the folder.
#include "core/io/document.h"
#include "core/io/image.h"
#include "editor/app/actions.h"
#include "editor/app/dialogs/bake_dialog.h"
#include "editor/app/exports.h"
#include "editor/app/files.h"
#include "editor/app/viewport/viewport_area.h"
#include "editor/app/widgets/message_bar.h"
#include "tests/editor/window.h"

#include <QCheckBox>
#include <QComboBox>
#include <QSpinBox>
#include <QTest>

using namespace whorl;

class BakeLicTest : public QObject, private testing::WindowFixture {
    Q_OBJECT

    QString said() { return m_window->area().messages().sentence(); }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("bake_lic_test");
        testing::useScratchSettings(m_folder);
        m_file = m_folder / "ball.whorl";
        Progress progress;
        QVERIFY(saveDocument(testing::groomOn(testing::sphere(24, 32), 300), m_file, progress).ok());
    }

    void init() {
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
    }

    void cleanup() { close(); }

    void theDialogSaysWhatIsBaked() {
        QVERIFY(!m_window->actions().get("file.export_lic").isEnabled());
        QVERIFY(m_window->files().open(m_file));
        QVERIFY(m_window->actions().get("file.export_lic").isEnabled());
        // The dialog is answered, and then the file dialog that follows it.
        QTimer::singleShot(200, m_window.get(), [this] {
            auto* dialog = qobject_cast<BakeDialog*>(QApplication::activeModalWidget());
            QVERIFY(dialog);
            for (const char* name : {"bake_colour", "bake_flow", "bake_opacity", "bake_height"})
                dialog->findChild<QCheckBox*>(name)->setChecked(false);
            auto* ok = dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
            QVERIFY(!ok->isEnabled());
            dialog->findChild<QCheckBox*>("bake_flow")->setChecked(true);
            dialog->findChild<QCheckBox*>("bake_opacity")->setChecked(true);
            dialog->findChild<QSpinBox*>("bake_size")->setValue(64);
            dialog->findChild<QSpinBox*>("bake_margin")->setValue(2);
            dialog->findChild<QComboBox*>("bake_format")->setCurrentIndex(1);
            testing::answerFileDialog(m_folder / "coat");
            ok->click();
        });
        m_window->actions().get("file.export_lic").trigger();
        const auto flow = readImage(m_folder / "coat_flow.exr", ImageUse::Colour);
        QVERIFY(flow.ok());
        QCOMPARE(flow->width(), 64);
        QVERIFY(std::filesystem::exists(m_folder / "coat_opacity.exr"));
        QVERIFY(!std::filesystem::exists(m_folder / "coat_colour.exr"));
        // As it was the last time.
        BakeDialog again(m_window.get());
        QCOMPARE(again.request().format, std::string("exr"));
        QCOMPARE(again.request().bits, 0);
        again.findChild<QComboBox*>("bake_format")->setCurrentIndex(2);
        QCOMPARE(again.request().format, std::string("exr"));
        QCOMPARE(again.request().bits, 16);
        again.remember();
        QCOMPARE(BakeDialog(m_window.get()).request().bits, 16);
        again.findChild<QComboBox*>("bake_format")->setCurrentIndex(0);
        QCOMPARE(again.request().format, std::string("png"));
        QCOMPARE(again.request().bits, 0);
        QCOMPARE(again.request().options.size, 64);
        QCOMPARE(again.request().maps, (std::vector{BakeMap::Opacity, BakeMap::Flow}));
    }

    void whatFailsIsSaid() {
        QVERIFY(m_window->files().open(m_file));
        BakeRequest request;
        request.options.size = 32;
        request.file = m_folder / "no_such_folder" / "coat.png";
        QVERIFY(!m_window->exports().bakeLic(request));
        QVERIFY(said().contains("coat.png"));
        request.file = m_folder / "together.png";
        QVERIFY2(m_window->exports().bakeLic(request), qPrintable(said()));
        QVERIFY(said().contains("together.png"));
    }
};

QTEST_MAIN(BakeLicTest)
#include "bake_lic_test.moc"
