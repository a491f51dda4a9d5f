// SPDX-License-Identifier: Apache-2.0
// A user's way through the real window: open a head, paint, place, comb, cut, undo, redo, save, reopen, export, look.
#include "core/io/document.h"
#include "core/io/open.h"
#include "core/io/package.h"
#include "core/param/path.h"
#include "editor/app/actions.h"
#include "editor/app/exports.h"
#include "editor/app/files.h"
#include "editor/app/resources.h"
#include "editor/app/viewport/viewport_area.h"
#include "editor/app/widgets/message_bar.h"
#include "tests/editor/window.h"

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QTest>
#include <cmath>

using namespace whorl;

namespace {

/// Pixels whose colour differs clearly between two pictures of one size.
int differingPixels(const QImage& a, const QImage& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const QColor p = a.pixelColor(x, y);
            const QColor q = b.pixelColor(x, y);
            count += std::abs(p.red() - q.red()) + std::abs(p.green() - q.green()) + std::abs(p.blue() - q.blue()) > 60;
        }
    }
    return count;
}

/// Pixels of saturated red: the hair colour that the test chose; skin and background have none.
int redPixels(const QImage& image) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QColor p = image.pixelColor(x, y);
            count += p.red() > 40 && p.red() > 2 * p.green() && p.red() > 2 * p.blue();
        }
    }
    return count;
}

void keep(const QImage& image, const char* name) {
    const QString folder = qEnvironmentVariable("WHORL_TEST_PICTURES", QDir::tempPath());
    image.save(folder + '/' + name);
    qInfo("picture: %s/%s", qPrintable(folder), name);
}

}  // namespace

class UserTest : public QObject {
    Q_OBJECT

    std::filesystem::path m_folder;
    std::unique_ptr<MainWindow> m_window;
    QImage m_bald;
    QImage m_hairy;

    Document& document() { return m_window->document(); }
    Viewport& view() { return *m_window->viewport(); }
    QPoint at(double x, double y) {
        return {static_cast<int>(view().width() * x), static_cast<int>(view().height() * y)};
    }
    QImage picture() {
        QTest::mouseMove(&view(), QPoint(3, 3));
        testing::settle(*m_window);
        QImage image = view().grabFramebuffer();
        // Without the line of text at the bottom: it tells times, which are others in every run.
        QPainter(&image).fillRect(0, image.height() - 28, image.width(), 28, Qt::black);
        return image;
    }
    void keepWindow(const char* name) {
        if (qEnvironmentVariableIsEmpty("WHORL_TEST_PICTURES")) return;
        testing::settle(*m_window);
        keep(m_window->grab().toImage(), name);
    }
    /// Presses a shortcut and names `file` in the dialog that it opens.
    void saysInDialog(Qt::Key key, Qt::KeyboardModifiers modifiers, const std::filesystem::path& file) {
        QApplication::setActiveWindow(m_window.get());  // as a window manager does after a dialog
        testing::answerFileDialog(file);
        QTest::keyClick(m_window.get(), key, modifiers);
    }
    QString said() { return m_window->area().messages().sentence(); }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("user_test");
        testing::useScratchSettings(m_folder);
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport() || !m_window->area().problem().isEmpty()) {
            QSKIP(qPrintable("No viewport: " + m_window->area().problem()));
        }
    }

    void welcomeIsThereAndGoes() {
        auto* welcome = m_window->findChild<QWidget*>("welcome");
        QVERIFY(welcome && welcome->isVisible());
        const auto real = testing::realData("heads/makehuman_derived/head_neutral_sub1.glb");
        std::filesystem::path head;
        if (real) {
            head = *real;
        } else {
            // Without the data folder: the head that ships with Whorl, as if its mesh had just been opened.
            const std::vector<std::filesystem::path> samples = sampleFiles();
            const auto bust = std::ranges::find_if(samples, [](const auto& f) { return f.stem() == "bust"; });
            QVERIFY2(bust != samples.end(), "the samples are built with the program");
            head = m_folder / "bust.whorl";
            Progress progress;
            const Result<OpenedDocument> sample = openGroom(*bust, progress);
            QVERIFY(sample.ok());
            Groom bald = makeGroom(*sample->groom.mesh);
            for (const MeshPart& part : bald.mesh->parts) {
                if (const Map* texture = sample->groom.maps.find(part.texture)) bald.maps.set(part.texture, *texture);
            }
            QVERIFY(saveDocument(bald, head, progress).ok());
        }
        QVERIFY2(m_window->files().open(head), qPrintable(said()));
        QVERIFY(document().hasGroom());
        QVERIFY(!welcome->isVisible());
        m_bald = picture();
        QVERIFY(!m_bald.isNull());
        QCOMPARE(redPixels(m_bald), 0);
    }

    void paintDensity() {
        m_window->actions().get("groom.paint_density").trigger();
        QVERIFY(m_window->state().brush());
        QVERIFY(m_window->state().brush()->paintsMap);
        const std::string map = m_window->state().brushOptions().map.name;
        QVERIFY(document().committed().maps.find(map));
        BrushOptions options = m_window->state().brushOptions();
        options.radius = 90.0f;
        options.strength = 1.0f;
        options.mirror = true;
        m_window->state().setBrushOptions(options);
        const int before = document().history().count();
        testing::drag(view(), {at(0.36, 0.3), at(0.42, 0.2), at(0.5, 0.15)});
        testing::drag(view(), {at(0.5, 0.25), at(0.5, 0.1)});
        QCOMPARE(document().history().count(), before + 2);
        keepWindow("user_test_paint.png");
        const Map& painted = *document().committed().maps.find(map);
        double sum = 0;
        for (int y = 0; y < painted.height(); y += 4) {
            for (int x = 0; x < painted.width(); x += 4) sum += static_cast<double>(painted.texel(x, y));
        }
        QVERIFY2(sum > 10, qPrintable(QString::number(sum)));
        QCOMPARE(m_window->viewport()->viewSettings().overlayMap, map);
    }

    void placeGuides() {
        m_window->findChild<QWidget*>("dock_groom")->raise();
        auto* wanted = m_window->findChild<QAbstractSpinBox*>("guides_box");
        QVERIFY(wanted);
        wanted->setFocus();
        wanted->selectAll();
        QTest::keyClicks(wanted, "200");
        QTest::keyClick(wanted, Qt::Key_Return);
        QCOMPARE(document().committed().counts->guides, 200);
        QTest::mouseClick(m_window->findChild<QPushButton*>("groom_place_guides"), Qt::LeftButton);
        const auto count = document().committed().guides.count();
        QVERIFY2(count > 150 && count <= 200, qPrintable(QString::number(count)));
        Groom red = document().committed();
        QVERIFY(setGroomValue(red, "groups/hair/colour/root", std::string("#c01010")).ok());
        QVERIFY(setGroomValue(red, "groups/hair/colour/tip", std::string("#ff2020")).ok());
        QVERIFY(setGroomValue(red, "groups/hair/general/root_thickness", 0.0003).ok());
        QVERIFY(setGroomValue(red, "groups/hair/general/tip_thickness", 0.0002).ok());
        document().edit(std::move(red), "Red, thick hair");
        QVERIFY(testing::settle(*m_window));
        QVERIFY(view().strands() && view().strands()->count() > 1000);
    }

    void comb() {
        m_window->actions().get("tool.comb").trigger();
        const std::uint64_t before = testing::groomDigest(document().committed());
        const int steps = document().history().count();
        testing::drag(view(), {at(0.45, 0.25), at(0.6, 0.35)});
        QCOMPARE(document().history().count(), steps + 1);
        QVERIFY(testing::groomDigest(document().committed()) != before);
        QVERIFY(checkGroom(document().committed()).empty());
    }

    void hairFollowsWhileCombing() {
        QVERIFY(testing::settle(*m_window));
        const auto before = view().strands();
        testing::drag(view(), {at(0.55, 0.2), at(0.45, 0.3)}, {}, Qt::LeftButton, false);
        QVERIFY(document().previewing());
        QTRY_VERIFY(view().strands() != before);
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.45, 0.3));
        QVERIFY(!document().previewing());
        keepWindow("user_test_comb.png");
    }

    void escapeDropsAStroke() {
        const std::uint64_t before = testing::groomDigest(document().committed());
        const int steps = document().history().count();
        testing::drag(view(), {at(0.45, 0.25), at(0.6, 0.35)}, {}, Qt::LeftButton, false);
        QVERIFY(document().previewing());
        QTest::keyClick(&view(), Qt::Key_Escape);
        QVERIFY(!document().previewing());
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.6, 0.35));
        QCOMPARE(document().history().count(), steps);
        QCOMPARE(testing::groomDigest(document().groom()), before);
    }

    void cut() {
        m_window->actions().get("tool.scissors").trigger();
        const int steps = document().history().count();
        BrushOptions options = m_window->state().brushOptions();
        options.radius = 30.0f;
        m_window->state().setBrushOptions(options);
        testing::drag(view(), {at(0.3, 0.35), at(0.36, 0.15)});
        QCOMPARE(document().history().count(), steps + 1);
        QVERIFY(checkGroom(document().committed()).empty());
    }

    void undoAllRedoAll() {
        std::vector<std::uint64_t> digests{testing::groomDigest(document().committed())};
        while (m_window->actions().get("edit.undo").isEnabled()) {
            m_window->actions().get("edit.undo").trigger();
            digests.push_back(testing::groomDigest(document().committed()));
        }
        QVERIFY(digests.size() > 6);
        QVERIFY(document().committed().guides.empty());
        // The model is as bald as it was opened.
        const BrushInfo* brush = m_window->state().brush();
        m_window->actions().get("tool.look").trigger();
        QVERIFY(differingPixels(m_bald, picture()) < m_bald.width() * m_bald.height() / 1000);
        m_window->state().setBrush(brush);
        while (m_window->actions().get("edit.redo").isEnabled()) {
            digests.pop_back();
            m_window->actions().get("edit.redo").trigger();
            QCOMPARE(testing::groomDigest(document().committed()), digests.back());
        }
        QCOMPARE(digests.size(), std::size_t{1});
    }

    void picturesShowHair() {
        m_window->actions().get("tool.look").trigger();
        ViewOptions options = m_window->state().viewOptions();
        options.showGuides = false;
        m_window->state().setViewOptions(options);
        const QImage hairy = picture();
        const int red = redPixels(hairy);
        const int differing = differingPixels(m_bald, hairy);
        const bool good = red > 1500 && differing > 2000;
        if (!good || !qEnvironmentVariableIsEmpty("WHORL_TEST_PICTURES")) {
            keep(m_bald, "user_test_bald.png");
            keep(hairy, "user_test_hair.png");
            keep(m_window->grab().toImage(), "user_test_window.png");
        }
        QVERIFY2(good, qPrintable(QString("%1 red, %2 differing").arg(red).arg(differing)));
        m_hairy = hairy;
    }

    void nothingIsClipped() {
        m_window->actions().get("tool.comb").trigger();
        for (QDockWidget* dock : m_window->findChildren<QDockWidget*>()) {
            dock->raise();
            QTest::qWait(50);
            keepWindow(qPrintable("user_test_" + dock->objectName() + ".png"));
            for (const QWidget* widget : dock->findChildren<QWidget*>()) {
                if (!widget->isVisible() || widget->objectName().startsWith("qt_")) continue;
                const bool control = qobject_cast<const QAbstractButton*>(widget) ||
                                     qobject_cast<const QAbstractSpinBox*>(widget) ||
                                     qobject_cast<const QComboBox*>(widget) || qobject_cast<const QLabel*>(widget);
                if (!control) continue;
                const QString name =
                    dock->objectName() + ": " + widget->metaObject()->className() + ' ' + widget->objectName();
                const auto* label = qobject_cast<const QLabel*>(widget);
                if (!label || !label->wordWrap()) {
                    QVERIFY2(widget->width() >= widget->minimumSizeHint().width(), qPrintable(name));
                }
                const QRect inParent(widget->mapTo(widget->parentWidget(), QPoint()), widget->size());
                QVERIFY2(widget->parentWidget()->rect().adjusted(0, 0, 1, 1).contains(inParent), qPrintable(name));
            }
        }
    }

    void saveAndReopen() {
        const std::uint64_t before = testing::groomDigest(document().committed());
        const std::filesystem::path file = m_folder / "head.whorl";
        QVERIFY(!document().clean());
        saysInDialog(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier, file);
        QVERIFY2(std::filesystem::exists(file), qPrintable(said()));
        QVERIFY(document().clean());
        QVERIFY(m_window->windowTitle().contains("head.whorl"));
        const Camera camera = view().camera();
        saysInDialog(Qt::Key_O, Qt::ControlModifier, file);
        QVERIFY2(document().clean() && document().history().count() == 0, qPrintable(said()));
        QCOMPARE(testing::groomDigest(document().committed()), before);
        QCOMPARE(document().history().count(), 0);
        // What comes back looks the same, too, from the same place: opening shows the guides and all.
        view().setCamera(camera);
        m_window->actions().get("tool.look").trigger();
        const QImage again = picture();
        QCOMPARE(again.size(), m_hairy.size());
        const int differing = differingPixels(m_hairy, again);
        if (differing > again.width() * again.height() / 1000) keep(again, "user_test_reopened.png");
        QVERIFY2(differing <= again.width() * again.height() / 1000, qPrintable(QString::number(differing)));
    }

    void exportPackage() {
        const std::filesystem::path folder = m_folder / "head.groom";
        Groom inThree = document().committed();
        inThree.counts.edit().parts = 3;
        document().edit(std::move(inThree), "Parts");
        saysInDialog(Qt::Key_E, Qt::ControlModifier, folder);
        Progress progress;
        const Result<Package> package = openPackage(folder, progress);
        QVERIFY2(package.ok(), package.ok() ? "" : package.error().message.c_str());
        QCOMPARE(package->parts.size(), std::size_t{3});
        const Result<std::uint64_t> digest = hairDigest(document().committed(), 1, std::nullopt, progress);
        QVERIFY(digest.ok());
        QCOMPARE(package->digest, *digest);
    }

    void exportHairAndPicture() {
        const std::filesystem::path hair = m_folder / "head.ply";
        saysInDialog(Qt::Key_E, Qt::ControlModifier | Qt::ShiftModifier, hair);
        QVERIFY2(std::filesystem::exists(hair), qPrintable(said()));
        QVERIFY(std::filesystem::file_size(hair) > 100000);
        const std::filesystem::path image = m_folder / "head.png";
        QVERIFY2(m_window->exports().renderPicture(image, 400, 300), qPrintable(said()));
        const QImage read(textOf(image));
        QCOMPARE(read.size(), QSize(400, 300));
        QVERIFY(redPixels(read) > 100);
        QVERIFY(!m_window->exports().exportHair(m_folder / "no_such_folder" / "head.ply"));
        QVERIFY(said().contains("no_such_folder"));
    }

    void cleanupTestCase() { m_window.reset(); }
};

QTEST_MAIN(UserTest)
#include "user_test.moc"
