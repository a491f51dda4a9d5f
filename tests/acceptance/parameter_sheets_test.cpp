// SPDX-License-Identifier: Apache-2.0
// resources/sheets/parameters.txt shows every parameter, and every one changes what is seen.
#include "core/commands/modifier_edits.h"
#include "core/io/image.h"
#include "core/io/open.h"
#include "core/param/path.h"
#include "tests/support/run.h"
#include "tests/support/shapes.h"

#include <QtTest>
#include <filesystem>

using namespace whorl;

class ParameterSheetsTest : public QObject {
    Q_OBJECT

    QString m_script;

    static std::filesystem::path swatch() {
        return std::filesystem::path(qEnvironmentVariable("WHORL_BIN").toStdString()) / ".." / "samples" /
               "swatch.whorl";
    }

private Q_SLOTS:
    void initTestCase() {
        QFile file(qEnvironmentVariable("WHORL_RESOURCES") + "/sheets/parameters.txt");
        QVERIFY(file.open(QIODevice::ReadOnly));
        m_script = QString::fromUtf8(file.readAll());
    }

    void everyParameterIsThere() {
        Progress progress;
        Result<OpenedDocument> opened = openGroom(swatch(), progress);
        QVERIFY2(opened.ok(), opened.ok() ? "" : opened.error().message.c_str());
        Groom& groom = opened->groom;
        // Modifiers are named by their kind, in the script as here.
        for (const BlockInfo& kind : modifierKinds()) QVERIFY(addModifier(groom, 0, kind.id).ok());
        const QStringList lines = m_script.split('\n');
        QStringList missing;
        for (const std::string& path : groomPaths(groom)) {
            const QString name = QString::fromStdString(path);
            // What all modifiers have is shown for each of them.
            const bool shown = std::ranges::any_of(lines, [&](const QString& line) {
                return line.startsWith("compare " + name + ' ') || line.startsWith("# not-seen " + name + ' ');
            });
            if (!shown) missing << name;
        }
        QVERIFY2(missing.isEmpty(), qPrintable("Add to resources/sheets/parameters.txt: " + missing.join(", ")));
    }

    void everyParameterIsSeen() {
        const std::filesystem::path folder = testing::scratchFolder("parameter_sheets");
        const QString place = QString::fromStdString(folder.string()) + '/';
        QString script = m_script;
        script.replace("open swatch.whorl", "open \"" + QString::fromStdString(swatch().string()) + '"');
        QStringList sheets;
        for (const QString& line : m_script.split('\n')) {
            if (line.startsWith("sheet ")) sheets << line.mid(6);
        }
        QVERIFY(sheets.size() > 10);
        script.replace("\nsheet ", "\nsheet " + place);
        QFile file(place + "script.txt");
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(script.toUtf8()) > 0);
        file.close();
        // A row whose neighbours show the same ends the script with a sentence.
        const testing::RunResult result = testing::run("whorl-cli", {"run", (folder / "script.txt").string()}, 600.0);
        QVERIFY2(result.status == 0, result.err.c_str());
        for (const QString& sheet : sheets) {
            const Result<Map> image = readImage(folder / sheet.toStdString(), ImageUse::Colour);
            QVERIFY2(image.ok(), qPrintable(sheet));
            QVERIFY2(image->width() >= 720 && image->height() >= 300, qPrintable(sheet));
        }
    }
};

QTEST_GUILESS_MAIN(ParameterSheetsTest)
#include "parameter_sheets_test.moc"
