// SPDX-License-Identifier: Apache-2.0
// Combing a head live: 2,000 guides, 10,000 shown hairs, strokes sent as events. The guides answer in the next frame
// and the hair follows; the frame times are printed, not judged (a test machine may be busy).
#include "core/commands/command.h"
#include "editor/app/actions.h"
#include "editor/app/files.h"
#include "editor/app/groom_actions.h"
#include "editor/app/resources.h"
#include "editor/app/viewport/viewport_area.h"
#include "tests/editor/window.h"

#include <glm/geometric.hpp>

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>

using namespace whorl;

namespace {

constexpr int guides = 2000;
constexpr int hairs = 10000;

QString spread(std::vector<double> times) {
    if (times.empty()) return "none";
    std::sort(times.begin(), times.end());
    const auto at = [&](double share) { return times[static_cast<std::size_t>(share * double(times.size() - 1))]; };
    return QString("median %1 ms, 95th percentile %2 ms, of %3")
        .arg(at(0.5), 0, 'f', 1)
        .arg(at(0.95), 0, 'f', 1)
        .arg(times.size());
}

}  // namespace

class LiveCombTest : public QObject {
    Q_OBJECT

    std::filesystem::path m_folder;
    std::unique_ptr<MainWindow> m_window;

    Document& document() { return m_window->document(); }
    Viewport& view() { return *m_window->viewport(); }
    QPoint at(double x, double y) {
        return {static_cast<int>(view().width() * x), static_cast<int>(view().height() * y)};
    }
    void keep(const char* name) {
        const QString folder = qEnvironmentVariable("WHORL_TEST_PICTURES");
        if (!folder.isEmpty()) view().grabFramebuffer().save(folder + '/' + name);
    }

    /// One event of the pointer, and the time until the picture that shows it is on the screen.
    double moveAndWait(QPoint p, Qt::MouseButtons held) {
        bool drawn = false;
        const auto seen = connect(&view(), &QOpenGLWidget::frameSwapped, this, [&] { drawn = true; });
        QElapsedTimer clock;
        clock.start();
        QMouseEvent move(QEvent::MouseMove, p, view().mapToGlobal(p), Qt::NoButton, held, {});
        QApplication::sendEvent(&view(), &move);
        while (!drawn && clock.elapsed() < 5000) QApplication::processEvents(QEventLoop::WaitForMoreEvents, 50);
        disconnect(seen);
        return static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    }

    /// Way round the middle of the view, in which strokes go down over the hair.
    std::vector<QPoint> way() {
        std::vector<QPoint> points;
        for (int stroke = 0; stroke < 3; ++stroke) {
            for (int i = 0; i <= 24; ++i) {
                const double t = i / 24.0;
                points.push_back(at(0.40 + 0.08 * stroke + 0.05 * t, 0.22 + 0.35 * t));
            }
        }
        return points;
    }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("live_comb_test");
        testing::useScratchSettings(m_folder);
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP(qPrintable("No viewport: " + m_window->area().problem()));
        std::vector<std::filesystem::path> samples = sampleFiles();
        const auto bust =
            std::find_if(samples.begin(), samples.end(), [](const auto& f) { return f.stem() == "bust"; });
        QVERIFY2(bust != samples.end(), "the samples are built with the program");
        QVERIFY(m_window->files().openSample(*bust));
        Groom groom = document().committed();
        groom.counts.edit().shownHairs = hairs;
        document().edit(std::move(groom), "Count");
        QVERIFY(m_window->groomActions().placeGuides(guides, false));
        QVERIFY(document().committed().guides.count() > guides * 9 / 10);
        // The picture, not the window, has the size that is spoken of.
        m_window->resize(m_window->size() + QSize(1280, 720) - view().size());
        QTRY_COMPARE(view().size(), QSize(1280, 720));
        m_window->actions().get("tool.comb").trigger();
        m_window->actions().get("view.frame").trigger();
        BrushOptions options = m_window->state().brushOptions();
        options.radius = 60.0f;
        m_window->state().setBrushOptions(options);
        QVERIFY(testing::settle(*m_window, 60000));
        // Shown are those of the groom at the same places, about this many.
        QVERIFY(std::abs(static_cast<double>(view().strands()->count()) - hairs) < 0.005 * hairs);
        keep("live_still.png");
    }

    void hairFollowsWhileCombing() {
        const GuideSet before = document().committed().guides;
        const auto still = view().strands();
        std::vector<double> frames;
        std::vector<double> late;
        int followed = 0;
        const std::vector<QPoint> points = way();
        QTest::mouseMove(&view(), points.front());
        QTest::mousePress(&view(), Qt::LeftButton, {}, points.front());
        for (const QPoint& p : points) {
            const auto seen = view().strands();
            const GuideSet old = document().groom().guides;
            frames.push_back(moveAndWait(p, Qt::LeftButton));
            QVERIFY(document().previewing());
            // The guides answered in the very frame that followed the event.
            if (p != points.front() && p.y() > points.front().y()) QVERIFY(!document().groom().guides.sameAs(old));
            followed += view().strands() != seen;
        }
        keep("live_combing.png");
        QElapsedTimer clock;
        clock.start();
        // Still under the button: the newest hair arrives without another event.
        QVERIFY(QTest::qWaitFor([&] { return !view().busy(); }, 10000));
        late.push_back(static_cast<double>(clock.nsecsElapsed()) * 1e-6);
        QVERIFY(document().previewing());
        const auto combed = view().strands();
        QVERIFY2(followed * 2 > static_cast<int>(points.size()), qPrintable(QString::number(followed)));
        QCOMPARE(combed->count(), still->count());
        // Hair moved where guides did, and only there: what no combed guide feeds keeps its bytes.
        std::size_t moved = 0;
        for (std::size_t i = 0; i < combed->positions.size(); ++i) {
            moved += combed->positions[i] != still->positions[i];
        }
        QVERIFY2(moved > combed->positions.size() / 50, qPrintable(QString::number(moved)));
        QVERIFY(moved < combed->positions.size());
        QCOMPARE(combed->roots.size(), still->roots.size());
        clock.restart();
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, points.back());
        QVERIFY(!document().previewing());
        QVERIFY(!document().committed().guides.sameAs(before));
        bool final = QTest::qWaitFor([&] { return view().settled(); }, 30000);
        QVERIFY(final);
        // The hair of the last preview is the hair of the groom.
        Generator generator;
        generator.setSurface(document().surface());
        Progress progress;
        GenerateOptions generate;
        generate.hairCount = hairs;
        const Result<Strands> anew = generator.generate(document().committed(), generate, progress);
        QVERIFY(anew.ok());
        QVERIFY(anew->positions == view().strands()->positions);
        keep("live_combed.png");
        qInfo("event to picture, %d guides, %d hairs, 1280x720: %s", guides, hairs, qPrintable(spread(frames)));
        qInfo("new hair in %d of %d pictures; the last one %.1f ms later", followed, static_cast<int>(points.size()),
              late.front());
    }

    void turningTheView() {
        m_window->actions().get("tool.look").trigger();
        std::vector<double> frames;
        QTest::mouseMove(&view(), at(0.3, 0.5));
        QTest::mousePress(&view(), Qt::LeftButton, {}, at(0.3, 0.5));
        for (int i = 1; i <= 40; ++i) frames.push_back(moveAndWait(at(0.3 + 0.005 * i, 0.5), Qt::LeftButton));
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.5, 0.5));
        keep("live_turning.png");
        qInfo("turning: %s", qPrintable(spread(frames)));
        QVERIFY(testing::settle(*m_window, 30000));
        keep("live_turned.png");
    }

    void cleanupTestCase() { m_window.reset(); }
};

QTEST_MAIN(LiveCombTest)
#include "live_comb_test.moc"
