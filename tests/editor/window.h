// SPDX-License-Identifier: Apache-2.0
// The real window for tests: own settings, own journals, a pointer that draws strokes.
#pragma once

#include "editor/app/autosave.h"
#include "editor/app/document.h"
#include "editor/app/main_window.h"
#include "editor/app/theme.h"
#include "editor/app/viewport/viewport.h"
#include "tests/support/shapes.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPoint>
#include <QPushButton>
#include <QSettings>
#include <QTest>
#include <QTimer>
#include <filesystem>
#include <memory>

namespace whorl::testing {

/// Call first in initTestCase: settings of tests never touch those of the artist.
inline void useScratchSettings(const std::filesystem::path& folder) {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    QApplication::setOrganizationName("whorl-test");
    QApplication::setApplicationName("whorl-test");
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, textOf(folder / "settings"));
    QSettings().clear();
}

/// A shown window; empty pointer when the platform never shows it.
inline std::unique_ptr<MainWindow> openWindow(const std::filesystem::path& journals) {
    applyTheme(*qApp, Theme::Dark);
    auto window = std::make_unique<MainWindow>(journals);
    window->resize(1280, 800);
    window->show();
    // Without a window manager nobody else makes it active, and shortcuts need that.
    QApplication::setActiveWindow(window.get());
    return QTest::qWaitForWindowExposed(window.get()) ? std::move(window) : nullptr;
}

/// Waits until nothing is generated and the picture is the final one.
inline bool settle(MainWindow& window, int milliseconds = 20000) {
    QTest::qWait(30);
    return !window.viewport() || QTest::qWaitFor([&] { return window.viewport()->settled(); }, milliseconds);
}

/// Answers the next file dialog, or for lack of one within 5 s nothing: types the name as a user does and confirms.
/// Call before what opens the dialog.
inline void answerFileDialog(const std::filesystem::path& file, int triesLeft = 100) {
    QTimer::singleShot(50, qApp, [file, triesLeft] {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        auto* name = dialog ? dialog->findChild<QLineEdit*>("fileNameEdit") : nullptr;
        if (name) {
            QApplication::setActiveWindow(dialog);
            name->setFocus();
            name->selectAll();
            QTest::keyClicks(name, textOf(file));
            if (QWidget* completions = QApplication::activePopupWidget()) completions->close();
            dialog->findChild<QDialogButtonBox*>()->buttons().front()->click();
            if (dialog->isVisible()) qWarning("The dialog did not take %s", qPrintable(name->text()));
        } else if (triesLeft > 0) {
            answerFileDialog(file, triesLeft - 1);
        }
    });
}

/// A press, a drag through `points`, a release.
inline void drag(QWidget& widget, const QList<QPoint>& points, Qt::KeyboardModifiers modifiers = {},
                 Qt::MouseButton button = Qt::LeftButton, bool release = true) {
    QTest::mouseMove(&widget, points.front());
    QTest::mousePress(&widget, button, modifiers, points.front());
    for (qsizetype i = 1; i < points.size(); ++i) {
        constexpr int steps = 6;
        for (int s = 1; s <= steps; ++s) {
            const QPoint p = points[i - 1] + (points[i] - points[i - 1]) * s / steps;
            QMouseEvent move(QEvent::MouseMove, p, widget.mapToGlobal(p), Qt::NoButton, button, modifiers);
            QApplication::sendEvent(&widget, &move);
        }
    }
    if (release) QTest::mouseRelease(&widget, button, modifiers, points.back());
}

/// What tests in the window share: its file and its parts.
class WindowFixture {
protected:
    std::filesystem::path m_folder;
    std::filesystem::path m_file;
    std::unique_ptr<MainWindow> m_window;

    Document& document() { return m_window->document(); }
    Viewport& view() { return *m_window->viewport(); }
    QPoint at(double x, double y) {
        return {static_cast<int>(view().width() * x), static_cast<int>(view().height() * y)};
    }
    QPoint centre() { return view().rect().center(); }
    template <class T>
    T* find(const char* name) {
        T* found = m_window->findChild<T*>(name);
        if (!found) qWarning("no widget %s", name);
        return found;
    }
    void close() {
        if (m_window) m_window->autosave().discard();
        m_window.reset();
    }
};

}  // namespace whorl::testing
