// SPDX-License-Identifier: Apache-2.0
// Law: a viewport whose OpenGL context is lost and made anew shows the same picture, and the work is untouched.
#include "core/io/document.h"
#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/files.h"
#include "editor/app/viewport/viewport_area.h"
#include "tests/editor/window.h"

#include <QOpenGLContext>
#include <QPointer>
#include <QStackedLayout>
#include <QTest>

using namespace whorl;

class ContextTest : public QObject {
    Q_OBJECT

    std::filesystem::path m_folder;
    std::unique_ptr<MainWindow> m_window;

    Viewport& view() { return *m_window->viewport(); }
    QImage picture() {
        // The line of text has milliseconds in it.
        return testing::settle(*m_window) ? view().grabFramebuffer().copy(0, 0, view().width(), view().height() - 40)
                                          : QImage();
    }
    /// Pixels that differ by more than rounding does.
    static int differing(const QImage& a, const QImage& b) {
        if (a.size() != b.size() || a.isNull()) return -1;
        int count = 0;
        for (int y = 0; y < a.height(); ++y) {
            for (int x = 0; x < a.width(); ++x) {
                const QColor p = a.pixelColor(x, y);
                const QColor q = b.pixelColor(x, y);
                count +=
                    std::abs(p.red() - q.red()) + std::abs(p.green() - q.green()) + std::abs(p.blue() - q.blue()) > 12;
            }
        }
        return count;
    }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("context_test");
        testing::useScratchSettings(m_folder);
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP(qPrintable("No viewport: " + m_window->area().problem()));
        m_window->resize(900, 640);
        ViewOptions options = m_window->state().viewOptions();
        options.samples = 1;
        options.shadows.index = 0;
        m_window->state().setViewOptions(options);
        const std::filesystem::path file = m_folder / "ball.whorl";
        Progress progress;
        QVERIFY(saveDocument(testing::groomOn(testing::sphere(24, 32), 300), file, progress).ok());
        QVERIFY(m_window->files().open(file));
    }

    void pictureComesBack() {
        Document& document = m_window->document();
        m_window->actions().get("tool.comb").trigger();
        const QPoint centre = view().rect().center();
        testing::drag(view(), {centre - QPoint(60, 0), centre + QPoint(60, 30)});
        QCOMPARE(document.history().count(), 1);
        m_window->actions().get("tool.look").trigger();
        const QImage before = picture();
        const std::uint64_t digest = testing::groomDigest(document.committed());
        QVERIFY(!before.isNull());

        QWidget* home = view().parentWidget();
        auto* pages = qobject_cast<QStackedLayout*>(home->layout());
        QVERIFY(pages);
        for (int lost = 0; lost < 20; ++lost) {
            const QPointer<QOpenGLContext> old = view().context();
            QVERIFY(old);
            // To a window of its own, and back: each time Qt destroys the context and makes another.
            if (lost % 2 == 0) {
                view().setParent(nullptr);
                view().resize(300, 200);
            } else {
                pages->addWidget(&view());
                pages->setCurrentWidget(&view());
            }
            view().show();
            QVERIFY(QTest::qWaitForWindowExposed(&view()));
            QTRY_VERIFY(view().context() && view().isValid());
            QVERIFY2(!old, "the context was lost");
            QVERIFY(m_window->area().problem().isEmpty());
            // Work goes on in the new one.
            if (lost % 5 == 1) {
                document.undo();
                document.redo();
            }
        }
        QCOMPARE(testing::groomDigest(document.committed()), digest);
        QCOMPARE(document.history().count(), 1);
        QTRY_COMPARE(view().size(), QSize(before.width(), before.height() + 40));
        QTest::mouseMove(&view(), QPoint(3, 3));
        const QImage after = picture();
        const int changed = differing(before, after);
        if (changed != 0) {
            before.save(textOf(m_folder / "before.png"));
            after.save(textOf(m_folder / "after.png"));
        }
        // A hair's edge may round the other way.
        QVERIFY2(changed >= 0 && changed < 40, qPrintable(QString("%1 pixels differ").arg(changed)));
    }

    void cleanupTestCase() {
        if (m_window) m_window->autosave().discard();
        m_window.reset();
    }
};

QTEST_MAIN(ContextTest)
#include "context_test.moc"
