// SPDX-License-Identifier: Apache-2.0
// resources/sheets/parameters.txt shows every parameter, and every one changes what is seen; hair_texture.txt draws
// what its labels say.
#include "core/commands/modifier_edits.h"
#include "core/io/image.h"
#include "core/io/open.h"
#include "core/param/path.h"
#include "tests/support/run.h"
#include "tests/support/shapes.h"

#include <QtTest>
#include <cmath>
#include <filesystem>

using namespace whorl;

class ParameterSheetsTest : public QObject {
    Q_OBJECT

    QString m_script;

    static std::filesystem::path samples() {
        return std::filesystem::path(qEnvironmentVariable("WHORL_BIN").toStdString()) / ".." / "samples";
    }
    static std::filesystem::path swatch() { return samples() / "swatch.whorl"; }

    static QString script(const char* name) {
        QFile file(qEnvironmentVariable("WHORL_RESOURCES") + "/sheets/" + name);
        return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
    }

    static float brightness(const Map& image, int x, int y) {
        return (image.texel(x, y, 0) + image.texel(x, y, 1) + image.texel(x, y, 2)) / 3.0f;
    }
    static double meanBrightness(const Map& image) {
        double sum = 0.0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) sum += static_cast<double>(brightness(image, x, y));
        return sum / (image.width() * image.height());
    }
    /// Share of pixels that clearly differ.
    static double difference(const Map& a, const Map& b) {
        if (a.width() != b.width() || a.height() != b.height()) return 1.0;
        int differ = 0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x) differ += std::abs(brightness(a, x, y) - brightness(b, x, y)) > 0.02f;
        return static_cast<double>(differ) / (a.width() * a.height());
    }
    /// Column, as a share of the width, around which `a` is brighter than `b`.
    static double brighterAt(const Map& a, const Map& b) {
        double sum = 0.0, weights = 0.0;
        for (int y = 0; y < a.height(); ++y) {
            for (int x = 0; x < a.width(); ++x) {
                const double more = static_cast<double>(std::max(brightness(a, x, y) - brightness(b, x, y), 0.0f));
                sum += more * x / a.width();
                weights += more;
            }
        }
        return weights > 0.0 ? sum / weights : 0.0;
    }

private Q_SLOTS:
    void initTestCase() {
        m_script = script("parameters.txt");
        QVERIFY(!m_script.isEmpty());
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

    void figuresOfHairTextureShowWhatTheySay() {
        // Every picture of the sheet by itself.
        const std::filesystem::path folder = testing::scratchFolder("hair_texture_sheet");
        const QString place = QString::fromStdString(folder.string()) + '/';
        QStringList lines, labels;
        for (const QString& line : script("hair_texture.txt").split('\n')) {
            if (line.startsWith("open ")) {
                const std::filesystem::path file = samples() / line.mid(5).toStdString();
                lines << "open \"" + QString::fromStdString(file.string()) + '"';
            } else if (line.startsWith("frame")) {
                labels << (line.size() > 6 ? line.mid(6) : QString());
                lines << QString("render \"%1%2.png\"").arg(place).arg(labels.size() - 1);
            } else if (line != "row" && !line.startsWith("sheet ")) {
                lines << line;
            }
        }
        QVERIFY(labels.size() > 15);
        QFile file(place + "script.txt");
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(lines.join('\n').toUtf8()) > 0);
        file.close();
        const testing::RunResult result = testing::run("whorl-cli", {"run", (folder / "script.txt").string()}, 600.0);
        QVERIFY2(result.status == 0, result.err.c_str());
        std::vector<Map> pictures;
        for (int i = 0; i < labels.size(); ++i) {
            Result<Map> image = readImage(folder / (std::to_string(i) + ".png"), ImageUse::Colour);
            QVERIFY2(image.ok(), qPrintable(labels[i]));
            pictures.push_back(std::move(*image));
            if (i > 0) QVERIFY2(difference(pictures[i], pictures[i - 1]) > 0.01, qPrintable(labels[i]));
        }
        const auto at = [&](const char* label) -> const Map& {
            const qsizetype i = labels.indexOf(label);
            return pictures[static_cast<std::size_t>(i < 0 ? 0 : i)];
        };
        for (const char* label : {"hanging", "parted", "moustache", "more white", "halo", "light from the other side",
                                  "3,000 hairs", "their texture", "both"})
            QVERIFY2(labels.contains(label), label);
        QVERIFY(meanBrightness(at("more white")) > meanBrightness(at("moustache")));
        // The halo moves with the light, from one side of the head to the other.
        const Map &right = at("halo"), &left = at("light from the other side");
        const double moved = brighterAt(right, left) - brighterAt(left, right);
        QVERIFY2(std::abs(moved) > 0.1, qPrintable(QString::number(moved)));
        // Few hairs let the skin through, above their texture they do not.
        QVERIFY(difference(at("3,000 hairs"), at("both")) > 0.02);
        QVERIFY(difference(at("their texture"), at("both")) > 0.02);
    }
};

QTEST_GUILESS_MAIN(ParameterSheetsTest)
#include "parameter_sheets_test.moc"
