// SPDX-License-Identifier: Apache-2.0
// Law: an editor that is killed while the artist works loses at most 20 strokes, and no start deletes what it left.
// $WHORL_KILL_ROUNDS kills (10).
#include "core/io/document.h"
#include "core/io/journal.h"
#include "editor/app/autosave.h"
#include "editor/app/document.h"
#include "tests/support/shapes.h"

#include <QCoreApplication>
#include <QFile>
#include <QProcess>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <chrono>
#include <random>
#include <set>

using namespace whorl;

namespace {

qint64 now() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// The step's number is in the groom itself, twice: a mixture of two steps would show.
Groom stroke(const Groom& before, int step) {
    Groom after = before;
    after.counts.edit().seed = step + 1;
    std::vector<glm::vec3> points(after.guides.points(0).begin(), after.guides.points(0).end());
    points.back().x = static_cast<float>(step);
    after.guides.setPoints(0, points);
    return after;
}

int stepOf(const Groom& groom) {
    const int step = groom.counts->seed - 1;
    return groom.guides.points(0).back().x == static_cast<float>(step) ? step : -1;
}

/// The editor without its window: strokes without end, the journal of the program, a log of what was done when.
int work(const QString& document, const QString& journals, const QString& log, int pause) {
    Progress progress;
    Result<OpenedDocument> opened = openDocument(pathOf(document), progress);
    if (!opened) return 1;
    Document edited;
    Autosave autosave(edited, pathOf(journals));
    edited.reset(std::move(opened->groom), pathOf(document));
    QFile file(log);
    if (!file.open(QIODevice::WriteOnly | QIODevice::Unbuffered)) return 1;
    int step = 0;
    QTimer artist;
    QObject::connect(&artist, &QTimer::timeout, &edited, [&] {
        edited.edit(stroke(edited.committed(), ++step), "Comb");
        file.write(QByteArray::number(step) + ' ' + QByteArray::number(now()) + '\n');
    });
    artist.start(pause);
    return QCoreApplication::exec();
}

/// The last step that was done before `time`.
int stepAt(const QString& log, qint64 time) {
    QFile file(log);
    int step = 0;
    if (!file.open(QIODevice::ReadOnly)) return step;
    for (const QByteArray& line : file.readAll().split('\n')) {
        const QList<QByteArray> words = line.split(' ');
        if (words.size() == 2 && words[1].toLongLong() <= time) step = words[0].toInt();
    }
    return step;
}

std::set<std::filesystem::path> journalsOf(const std::vector<Recovery>& found) {
    std::set<std::filesystem::path> files;
    for (const Recovery& recovery : found) files.insert(recovery.journal);
    return files;
}

}  // namespace

class KillEditorTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void killedAtAnyTime() {
        bool given = false;
        const int asked = qEnvironmentVariableIntValue("WHORL_KILL_ROUNDS", &given);
        const int rounds = given ? asked : 10;
        // A stroke that ends while the journal is being written is in the next one.
        constexpr qint64 writing = 500;
        const std::filesystem::path folder = testing::scratchFolder("kill_editor_test");
        const std::filesystem::path document = folder / "ball.whorl";
        const std::filesystem::path journals = folder / "journals";
        Progress progress;
        QVERIFY(saveDocument(stroke(testing::groomOn(testing::sphere(24, 32), 400), 0), document, progress).ok());
        const QString log = textOf(folder / "log");
        std::mt19937 random(20);
        std::set<std::filesystem::path> left;
        int most = 0;
        int without = 0;
        for (int round = 0; round < rounds; ++round) {
            const int pause = 15 + static_cast<int>(random() % 30);
            const int life = 300 + static_cast<int>(random() % 1500);
            QFile::remove(log);
            QProcess editor;
            editor.start(QCoreApplication::applicationFilePath(),
                         {"--work", textOf(document), textOf(journals), log, QString::number(pause)});
            QVERIFY(editor.waitForStarted());
            QVERIFY(QTest::qWaitFor([&] { return stepAt(log, now()) > 0; }, 10000));
            QTest::qWait(life);
            QCOMPARE(editor.state(), QProcess::Running);
            const qint64 end = now();
            editor.kill();
            QVERIFY(editor.waitForFinished());

            // What a next start would find: all that earlier rounds left, and at most one more.
            const std::vector<Recovery> found = findRecoveries(journals);
            const std::set<std::filesystem::path> files = journalsOf(found);
            QVERIFY(std::includes(files.begin(), files.end(), left.begin(), left.end()));
            QVERIFY(files.size() <= left.size() + 1);
            int kept = 0;
            for (const Recovery& recovery : found) {
                if (left.contains(recovery.journal)) continue;
                QCOMPARE(recovery.document, std::filesystem::absolute(document));
                const Result<OpenedDocument> restored = openRecovery(recovery, progress);
                QVERIFY2(restored.ok(), restored.ok() ? "" : restored.error().message.c_str());
                QVERIFY(restored->problems.empty());
                kept = stepOf(restored->groom);
                QVERIFY(kept > 0);
            }
            without += files.size() == left.size();
            left = files;
            const int done = stepAt(log, end);
            const int due = stepAt(log, end - writing);
            QVERIFY2(kept >= due - Autosave::steps,
                     qPrintable(QString("%1 steps, %2 of them settled, %3 kept").arg(done).arg(due).arg(kept)));
            QVERIFY(kept <= done);
            most = std::max(most, done - kept);

            // The saved document is as it was.
            const Result<OpenedDocument> saved = openDocument(document, progress);
            QVERIFY(saved.ok());
            QCOMPARE(stepOf(saved->groom), 0);
        }
        QVERIFY2(left.size() * 2 > static_cast<std::size_t>(rounds), "most rounds live long enough for a journal");
        qInfo("%d kills, %d before the first journal, at most %d steps lost", rounds, without, most);

        // Looking deletes nothing; only the choice does, and only what was chosen.
        QCOMPARE(journalsOf(findRecoveries(journals)), left);
        const std::vector<Recovery> found = findRecoveries(journals);
        deleteRecovery(found.front());
        left.erase(found.front().journal);
        QCOMPARE(journalsOf(findRecoveries(journals)), left);
    }
};

int main(int argc, char** argv) {
    QCoreApplication application(argc, argv);
    const QStringList words = QCoreApplication::arguments();
    if (words.size() == 6 && words[1] == "--work") return work(words[2], words[3], words[4], words[5].toInt());
    KillEditorTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "kill_editor_test.moc"
