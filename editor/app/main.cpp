// SPDX-License-Identifier: Apache-2.0
// whorl [FILE]: the editor.
#include "core/io/journal.h"
#include "editor/app/dialogs/dialogs.h"
#include "editor/app/document.h"
#include "editor/app/files.h"
#include "editor/app/icons.h"
#include "editor/app/main_window.h"
#include "editor/app/theme.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QTimer>
#include <csignal>

int main(int argc, char** argv) {
    // A file that grows past a limit must end in a sentence, not in the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    QCoreApplication::setOrganizationName("whorl");
    QCoreApplication::setApplicationName("whorl");
    QCoreApplication::setApplicationVersion(WHORL_VERSION);
    QCommandLineParser parser;
    parser.setApplicationDescription(QObject::tr("Interactive hair grooming."));
    const QCommandLineOption help = parser.addHelpOption();
    const QCommandLineOption version = parser.addVersionOption();
    parser.addPositionalArgument("FILE", QObject::tr("A document (.whorl), a package (.groom) or a mesh."), "[FILE]");
    {
        // What needs no window is answered without a display.
        QCoreApplication plain(argc, argv);
        parser.parse(QCoreApplication::arguments());
        if (parser.isSet(help) || parser.isSet(version) || parser.isSet("help-all")) parser.process(plain);
    }
    QApplication::setHighDpiScaleFactorRoundingPolicy(Qt::HighDpiScaleFactorRoundingPolicy::PassThrough);
    QApplication application(argc, argv);
    QApplication::setApplicationDisplayName("Whorl");
    QApplication::setDesktopFileName("whorl");
    parser.process(application);

    whorl::applyTheme(application, whorl::themeInSettings());
    whorl::MainWindow window(whorl::journalFolder());
    window.show();
    QTimer::singleShot(0, &window, [&] {
        const bool restored = window.offerRecovery();
        const QStringList files = parser.positionalArguments();
        if (!restored && !files.isEmpty()) window.files().open(whorl::pathOf(files.front()));
    });
    return QApplication::exec();
}
