// SPDX-License-Identifier: Apache-2.0
// The real whorl-cli: its programs, and how it refuses.
#include "core/io/image.h"
#include "tests/support/shapes.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <fstream>

using namespace whorl;
using namespace whorl::testing;

namespace {

struct Answer {
    int status = -1;
    QByteArray output;
    QByteArray errors;
    /// Lines on standard error that are not notes.
    QList<QByteArray> complaints() const {
        QList<QByteArray> lines;
        for (const QByteArray& line : errors.split('\n')) {
            if (!line.isEmpty() && !line.startsWith("note: ")) lines.append(line);
        }
        return lines;
    }
};

QString inScratch(const char* name) {
    static const std::filesystem::path folder = scratchFolder("cli");
    return QString::fromStdString((folder / name).string());
}

void write(const QString& file, const std::string& text) {
    std::ofstream(file.toStdString(), std::ios::binary) << text;
}

/// A tent of 2 x 8 x 8 triangles.
QString meshFile() {
    const QString file = inScratch("tent.obj");
    const SurfaceMesh mesh = plane(8, 0.2f);
    std::string text = "o tent\n";
    for (const glm::vec3& p : mesh.positions) {
        text +=
            "v " + std::to_string(p.x) + " " + std::to_string(0.1f - std::abs(p.x)) + " " + std::to_string(p.z) + "\n";
    }
    for (const glm::uvec3& t : mesh.triangles) {
        text += "f " + std::to_string(t.x + 1) + " " + std::to_string(t.y + 1) + " " + std::to_string(t.z + 1) + "\n";
    }
    write(file, text);
    return file;
}

}  // namespace

class CliTest : public QObject {
    Q_OBJECT

    QString m_program;

    Answer run(const QStringList& arguments,
               const QProcessEnvironment& environment = QProcessEnvironment::systemEnvironment()) {
        QProcess process;
        process.setProcessEnvironment(environment);
        process.start(m_program, arguments);
        Answer answer;
        if (!process.waitForStarted() || !process.waitForFinished(120000)) return answer;
        answer.status = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2;
        answer.output = process.readAllStandardOutput();
        answer.errors = process.readAllStandardError();
        return answer;
    }

    /// Nothing on standard output, one sentence on standard error, this exit status.
    void refused(const QStringList& arguments, int status, const char* mentions = "") {
        const Answer answer = run(arguments);
        const QByteArray context = arguments.join(' ').toUtf8() + ": " + answer.errors;
        QVERIFY2(answer.status == status, context.constData());
        QVERIFY2(answer.output.isEmpty(), context.constData());
        QVERIFY2(answer.complaints().size() == 1, context.constData());
        QVERIFY2(answer.complaints().first().startsWith("whorl-cli: ") && answer.complaints().first().endsWith('.'),
                 context.constData());
        QVERIFY2(answer.errors.contains(mentions), context.constData());
    }

private Q_SLOTS:
    void initTestCase() {
        m_program = qEnvironmentVariable("WHORL_BIN") + "/whorl-cli";
        QVERIFY2(QFile::exists(m_program), "WHORL_BIN does not name the folder of whorl-cli.");
        meshFile();
    }

    void badUsageIsStatusTwo() {
        refused({}, 2);
        refused({"nonsense"}, 2, "nonsense");
        refused({"info"}, 2, "FILE");
        refused({"info", "a", "--wrong"}, 2, "--wrong");
        refused({"new", meshFile()}, 2, "-o");
        refused({"new", meshFile(), "-o", inScratch("x.obj")}, 2, ".whorl");
        refused({"new", meshFile(), "-o", inScratch("x.whorl"), "--guides", "-4"}, 2, "--guides");
        refused({"new", meshFile(), "-o", inScratch("x.whorl"), "--guides", "many"}, 2, "--guides");
        refused({"sample", meshFile(), "--count", "0", "-o", inScratch("x.ply")}, 2, "--count");
        refused({"sample", meshFile(), "--count", "5", "-o", inScratch("x.abc")}, 2, ".ply");
        refused({"generate", meshFile(), "-o", inScratch("x.xyz")}, 2, "ply");
        for (const char* part : {"0/2", "3/2", "1", "1/", "/1", "a/b", "1/0", "1/99999"}) {
            refused({"generate", meshFile(), "--part", part, "-o", inScratch("x.ply")}, 2, "--part");
        }
        refused({"hash", meshFile(), "--parts", "0"}, 2, "--parts");
        refused({"render", meshFile(), "-o", inScratch("x.png"), "--size", "12"}, 2, "--size");
        refused({"render", meshFile(), "-o", inScratch("x.png"), "--camera", "above"}, 2, "--camera");
        refused({"export", meshFile(), "-o", inScratch("x.zip")}, 2, ".groom");
        for (const char* share : {"0", "1.5", "-1", "half"}) {
            refused({"generate", meshFile(), "--lod", share, "-o", inScratch("x.ply")}, 2, "--lod");
            refused({"export", meshFile(), "--lod", share, "-o", inScratch("x.groom")}, 2, "--lod");
            refused({"render", meshFile(), "--lod", share, "-o", inScratch("x.png")}, 2, "--lod");
        }
        refused({"render", meshFile(), "--lod", "0.5", "--lod-for-size", "-o", inScratch("x.png")}, 2, "--lod");
        refused({"bench", "no such benchmark"}, 2, "comb");
        QVERIFY(!QFile::exists(inScratch("x.whorl")) && !QFile::exists(inScratch("x.ply")));
    }

    void badInputIsStatusOne() {
        write(inScratch("broken.obj"), "v 0 0\nf 1 2 3\n");
        write(inScratch("broken.glb"), "glTF\x02");
        write(inScratch("broken.whorl"), "WHORLDOC and nothing else");
        write(inScratch("empty.whorl"), "");
        write(inScratch("broken.png"), "\x89PNG\r\n\x1a\n");
        for (const char* name :
             {"missing.obj", "broken.obj", "broken.glb", "broken.whorl", "empty.whorl", "broken.png", "."}) {
            refused({"info", inScratch(name)}, 1);
            refused({"hash", inScratch(name)}, 1);
            refused({"new", inScratch(name), "-o", inScratch("x.whorl")}, 1);
        }
        refused({"new", meshFile(), "-o", inScratch("x.whorl"), "--density", inScratch("broken.png")}, 1, "broken.png");
        refused({"new", meshFile(), "-o", inScratch("no/such/folder/x.whorl")}, 1);
        refused({"run", inScratch("missing.txt")}, 1, "missing.txt");
        QVERIFY(!QFile::exists(inScratch("x.whorl")));
    }

    void fromAMeshToAPackage() {
        const QString document = inScratch("tent.whorl");
        Answer answer = run({"new", meshFile(), "-o", document, "--guides", "50", "--seed", "9"});
        QVERIFY2(answer.status == 0, answer.errors.constData());
        answer = run({"info", document, "--json"});
        QCOMPARE(answer.status, 0);
        const QJsonObject facts = QJsonDocument::fromJson(answer.output).object();
        QCOMPARE(facts["kind"].toString(), QString("document"));
        QCOMPARE(facts["guides"].toInt(), 50);
        QCOMPARE(facts["triangles"].toInt(), 128);
        QCOMPARE(facts["parameters"].toObject()["counts/seed"].toDouble(), 9.0);
        QVERIFY(facts["problems"].toArray().isEmpty());
        QVERIFY(run({"info", document}).output.contains("guides: 50"));

        const QByteArray digest = run({"hash", document, "--count", "3000"}).output;
        QVERIFY(digest.size() == 17 && digest.endsWith('\n'));
        QCOMPARE(run({"hash", document, "--count", "3000", "--parts", "7", "--threads", "1"}).output, digest);

        const QByteArray whole = run({"hash", document}).output;
        const QString package = inScratch("tent.groom");
        answer = run({"export", document, "-o", package, "--parts", "3"});
        QVERIFY2(answer.status == 0, answer.errors.constData());
        QCOMPARE(run({"hash", package}).output, whole);

        for (const char* suffix : {"ply", "obj", "hair"}) {
            const QString file = inScratch("tent.") + suffix;
            answer = run({"generate", document, "--count", "500", "--part", "2/2", "-o", file});
            QVERIFY2(answer.status == 0 && answer.output.isEmpty(), answer.errors.constData());
            QVERIFY(QFileInfo(file).size() > 1000);
        }
        QVERIFY(run({"info", inScratch("tent.hair")}).output.contains("kind: hair"));
        answer = run({"sample", meshFile(), "--count", "777", "-o", inScratch("points.ply")});
        QCOMPARE(answer.status, 0);
        QFile points(inScratch("points.ply"));
        QVERIFY(points.open(QIODevice::ReadOnly));
        const QByteArray bytes = points.readAll();
        const qsizetype header = bytes.indexOf("end_header\n") + 11;
        QVERIFY(bytes.left(header).contains("element vertex 777\n"));
        QCOMPARE(bytes.size() - header, qsizetype{777 * 32});
    }

    void fewerAndWiderHairsOnRequest() {
        const QString document = inScratch("detail.whorl");
        QCOMPARE(run({"new", meshFile(), "-o", document, "--guides", "40"}).status, 0);
        const auto points = [&](const QStringList& more) {
            const QString file = inScratch("detail.hair");
            const Answer answer = run(QStringList{"generate", document, "--count", "4000", "-o", file} + more);
            return answer.status == 0 ? QFileInfo(file).size() : 0;
        };
        const double all = static_cast<double>(points({})), some = static_cast<double>(points({"--lod", "0.25"}));
        QVERIFY(all > 100000.0 && std::abs(some / all - 0.25) < 0.02);
        const QString package = inScratch("detail.groom");
        QCOMPARE(run({"export", document, "--lod", "0.1", "-o", package}).status, 0);
        const auto facts = [&](const QString& file) {
            return QJsonDocument::fromJson(run({"info", file, "--json"}).output).object()["parameters"].toObject();
        };
        const QString thickness = "groups/hair/general/root_thickness";
        QVERIFY(facts(document).contains(thickness));
        QCOMPARE(facts(package)["counts/hairs"].toInt(), facts(document)["counts/hairs"].toInt() / 10);
        QVERIFY(std::abs(facts(package)[thickness].toDouble() / facts(document)[thickness].toDouble() - 10.0) < 1e-3);
        for (const QStringList& detail : {QStringList{"--lod", "0.1"}, QStringList{"--lod-for-size"}}) {
            const QStringList picture{"render", document, "-o", inScratch("detail.png"), "--size", "64x48"};
            const Answer answer = run(picture + detail);
            QVERIFY2(answer.status == 0, answer.errors.constData());
        }
    }

    void hairTextureIsBakedAndWorn() {
        const QString document = inScratch("lic.whorl"), image = inScratch("lic.png");
        QCOMPARE(run({"new", meshFile(), "-o", document, "--guides", "40"}).status, 0);
        const Answer baked =
            run({"bake-lic", document, "-o", image, "--size", "64", "--length", "0.02", "--grain", "0.004"});
        QVERIFY2(baked.status == 0, baked.errors.constData());
        const Result<Map> map = readImage(image.toStdString(), ImageUse::Colour);
        QVERIFY(map.ok());
        QCOMPARE(map->width(), 64);
        float low = 1.0f, high = 0.0f;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                low = std::min(low, map->texel(x, y, 0));
                high = std::max(high, map->texel(x, y, 0));
            }
        }
        QVERIFY(high - low > 0.1f);
        const QString script = inScratch("wear.txt"), worn = inScratch("worn.whorl");
        write(script, ("open \"" + document + "\"\nload-map hair_texture \"" + image +
                       "\" colour\ntexture * hair_texture\nsave \"" + worn + "\"\ninfo\n")
                          .toStdString());
        const Answer info = run({"run", script});
        QVERIFY2(info.status == 0 && info.output.contains("map: hair_texture, 64 x 64, colours"),
                 info.errors.constData());
        refused({"bake-lic", document, "-o", image, "--size", "0"}, 2);
        refused({"bake-lic", inScratch("missing.whorl"), "-o", image}, 1, "missing.whorl");
        write(script, ("open \"" + document + "\"\ntexture * nothing\n").toStdString());
        refused({"run", script}, 1, "nothing");
    }

    void singularitiesAreListedAndDrawn() {
        const QString document = inScratch("turns.whorl"), script = inScratch("turns.txt");
        const std::string opened = "open \"" + document.toStdString() + "\"\n";
        write(script, "open \"" + meshFile().toStdString() + "\"\nadd-stroke whorl radius 0.03 0.04,0.06,0\nsave \"" +
                          document.toStdString() + "\"\n");
        QCOMPARE(run({"run", script}).status, 0);
        const Answer listed = run({"singularities", document});
        QVERIFY2(listed.status == 0, listed.errors.constData());
        write(script, opened + "singularities\n");
        QCOMPARE(run({"run", script}).output, listed.output);
        const QJsonObject json = QJsonDocument::fromJson(run({"singularities", document, "--json"}).output).object();
        const QJsonArray all = json["singularities"].toArray();
        QCOMPARE(listed.output.count('\n'), all.size() + 1);
        int sum = 0;
        QJsonObject whorl;
        double nearest = 1.0;
        for (const QJsonValue& value : all) {
            const QJsonArray at = value.toObject()["position"].toArray();
            QCOMPARE(at.size(), qsizetype{3});
            sum += value.toObject()["index"].toInt();
            const double away = std::hypot(at[0].toDouble() - 0.04, at[1].toDouble() - 0.06, at[2].toDouble());
            if (away < nearest) {
                nearest = away;
                whorl = value.toObject();
            }
        }
        QCOMPARE(json["sum"].toInt(), sum);
        QVERIFY(nearest < 0.03);
        QCOMPARE(whorl["index"].toInt(), 1);
        refused({"singularities"}, 2, "FILE");
        refused({"singularities", inScratch("missing.whorl")}, 1, "missing.whorl");

        // Pictures that look at it, with the strokes alone and with the stars: those are in the middle.
        const QJsonArray at = whorl["position"].toArray();
        QString place;
        for (const QJsonValue& value : at)
            place += (place.isEmpty() ? "" : ",") + QString::number(value.toDouble(), 'f', 7);
        const auto picture = [&](const char* what, const char* image) {
            write(script, opened + "clear-guides\nlook-at " + place.toStdString() + "\ncamera top 4 240x240\nshow " +
                              what + "\nrender \"" + inScratch(image).toStdString() + "\"\n");
            const Answer answer = run({"run", script});
            const Result<Map> map = readImage(inScratch(image).toStdString(), ImageUse::Colour);
            return answer.status == 0 && map ? *map : Map();
        };
        const Map strokes = picture("guides", "turns_strokes.png"), stars = picture("field", "turns_field.png"),
                  skin = picture("hair", "turns_skin.png"), over = picture("hair field", "turns_over.png");
        for (const Map* map : {&strokes, &stars, &skin, &over}) QCOMPARE(map->width(), 240);
        int star = 0, red = 0, drawn = 0, other = 0;
        const auto differ = [](const Map& a, const Map& b, int x, int y) {
            float most = 0.0f;
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.texel(x, y, c) - b.texel(x, y, c)));
            return most > 0.05f;
        };
        for (int y = 0; y < 240; ++y) {
            for (int x = 0; x < 240; ++x) {
                drawn += differ(strokes, skin, x, y);
                other += differ(stars, over, x, y);
                if (!differ(stars, strokes, x, y)) continue;
                ++star;
                red += stars.texel(x, y, 0) > stars.texel(x, y, 2);
                QVERIFY2(std::hypot(x - 119.5, y - 119.5) < 14.0, qPrintable(QString("%1, %2").arg(x).arg(y)));
            }
        }
        QVERIFY2(star > 20 && red == star, qPrintable(QString("%1 pixels, %2 red").arg(star).arg(red)));
        QVERIFY(drawn > 100);
        QCOMPARE(other, 0);
        // The program draws the same.
        const QString plain = inScratch("turns_plain.png"), field = inScratch("turns_program.png");
        QCOMPARE(run({"render", document, "-o", plain, "--view", "lic", "--texture", "64", "--size", "200x200"}).status,
                 0);
        QCOMPARE(
            run({"render", document, "-o", field, "--view", "lic", "--texture", "64", "--size", "200x200", "--field"})
                .status,
            0);
        const Result<Map> without = readImage(plain.toStdString(), ImageUse::Colour),
                          with = readImage(field.toStdString(), ImageUse::Colour);
        QVERIFY(without && with);
        int changed = 0;
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < 200; ++x) changed += differ(*without, *with, x, y);
        QVERIFY(changed > 20);
        write(script, opened + "show field hair\n");
        refused({"run", script}, 1, "show");
    }

    void scriptsRun() {
        const QString script = inScratch("script.txt");
        write(script,
              "open \"" + meshFile().toStdString() +
                  "\"\nplace-guides 40 0.05   # short\nview 20,30 800x600\n"
                  "brush radius 80\nhash\nstroke comb 0.4,0.5 0.6,0.5\nhash\nbrush invert on\nset counts/hairs 500\n"
                  "get counts/hairs\nsave \"" +
                  inScratch("scripted.whorl").toStdString() + "\"\n");
        const Answer answer = run({"run", script});
        QVERIFY2(answer.status == 0, answer.errors.constData());
        const QList<QByteArray> lines = answer.output.trimmed().split('\n');
        QCOMPARE(lines.size(), qsizetype{4});
        QCOMPARE(lines[0], QByteArray("40 guides"));
        QVERIFY(lines[1] != lines[2]);
        QCOMPARE(lines[3], QByteArray("500"));
        const QJsonObject json = QJsonDocument::fromJson(run({"run", script, "--json"}).output).object();
        QCOMPARE(json["output"].toArray().size(), qsizetype{4});
        QCOMPARE(json["output"].toArray()[3].toString(), QString("500"));

        write(script, "open \"" + meshFile().toStdString() + "\"\n\nset counts/hairs many\n");
        refused({"run", script}, 1, "script.txt:3: ");
        write(script, "hash\n");
        refused({"run", script}, 1, "script.txt:1: ");
    }

    void everyCommandExplainsItsUsage() {
        const QByteArray help = run({"run", "--help"}).output;
        for (const char* name :
             {"open", "save", "new", "set", "get", "info", "place-guides", "clear-guides", "fill-map", "load-map",
              "save-map", "stroke", "brush", "view", "generate", "hash", "export", "grow", "parts"}) {
            QVERIFY2(help.contains(QByteArray("\n  ") + name), name);
            write(inScratch("one.txt"), std::string(name) + " a b c d e f\n");
            if (std::string_view(name) != "set" && std::string_view(name) != "stroke")
                refused({"run", inScratch("one.txt")}, 1);
        }
    }

    void theLocaleChangesNothing() {
        QProcessEnvironment german = QProcessEnvironment::systemEnvironment();
        german.insert("LC_ALL", "de_DE.UTF-8");
        QCOMPARE(run({"info", meshFile(), "--json"}, german).output, run({"info", meshFile(), "--json"}).output);
        QCOMPARE(run({"hash", meshFile(), "--count", "200"}, german).output,
                 run({"hash", meshFile(), "--count", "200"}).output);
    }

    void brokenFilesEndInOneSentence() {
        const auto folder = realData("hostile");
        if (!folder) QSKIP("The folder of hostile files is not there.");
        std::ifstream index(*folder / "INDEX.tsv");
        std::string line;
        std::getline(index, line);
        int rejected = 0;
        while (std::getline(index, line)) {
            const QStringList columns = QString::fromStdString(line).split('\t');
            if (columns.size() < 4 || columns[3] != "REJECT" || !columns[0].startsWith("gltf/")) continue;
            refused({"info", QString::fromStdString((*folder).string()) + "/" + columns[0]}, 1);
            ++rejected;
        }
        QVERIFY(rejected > 10);
    }
};

QTEST_GUILESS_MAIN(CliTest)
#include "cli_test.moc"
