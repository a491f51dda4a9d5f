// SPDX-License-Identifier: Apache-2.0
// Partings in the real window: drawn, undone, erased, and what they do to the hair.
#include "core/hair/explain.h"
#include "core/io/document.h"
#include "core/surface/parting_line.h"
#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/files.h"
#include "editor/app/viewport/viewport_area.h"
#include "tests/editor/window.h"

#include <glm/geometric.hpp>

#include <QTest>

using namespace whorl;

class PartingTest : public QObject, private testing::WindowFixture {
    Q_OBJECT

    std::size_t partings() { return document().groom().partings->size(); }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("parting_test");
        testing::useScratchSettings(m_folder);
        // A ball of guides that lean away from x = 0.
        Groom groom = testing::groomOn(testing::sphere(24, 48), 400);
        for (std::size_t i = 0; i < groom.guides.count(); ++i) {
            const std::span<glm::vec3> points = groom.guides.editPoints(i);
            const float side = points[0].x < 0.0f ? -0.004f : 0.004f;
            for (std::size_t k = 1; k < points.size(); ++k) points[k].x += side * static_cast<float>(k);
        }
        groom.counts.edit().shownHairs = 3000;
        groom.counts.edit().hairs = 3000;
        m_file = m_folder / "ball.whorl";
        Progress progress;
        QVERIFY(saveDocument(groom, m_file, progress).ok());
    }

    void init() {
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP(qPrintable("No viewport: " + m_window->area().problem()));
        ViewOptions options = m_window->state().viewOptions();
        options.samples = 1;
        options.shadows.index = 0;
        m_window->state().setViewOptions(options);
        QVERIFY(m_window->files().open(m_file));
        view().lookFrom("front");
        view().frameAll();
        m_window->actions().get("tool.parting").trigger();
        QCOMPARE(m_window->state().brush()->id, std::string_view("parting"));
    }

    void cleanup() { close(); }

    void drawsWhileDraggingAndKeepsOneStep() {
        const Groom before = document().committed();
        testing::drag(view(), {at(0.5, 0.2), at(0.5, 0.5)}, {}, Qt::LeftButton, false);
        QCOMPARE(partings(), std::size_t{1});
        QVERIFY(document().previewing());
        QVERIFY(document().committed().partings->empty());
        // Escape: as if it had never been.
        QTest::keyClick(&view(), Qt::Key_Escape);
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, at(0.5, 0.5));
        QCOMPARE(document().history().count(), 0);
        QVERIFY(document().groom().sameAs(before));

        testing::drag(view(), {at(0.5, 0.2), at(0.5, 0.8)});
        QCOMPARE(document().history().count(), 1);
        QCOMPARE(partings(), std::size_t{1});
        for (const glm::vec3& p : partingPositions(*document().groom().mesh, document().groom().partings->front()))
            QVERIFY(std::abs(p.x) < 0.004f && p.z > 0.0f);
        document().undo();
        QCOMPARE(partings(), std::size_t{0});
        document().redo();
        QCOMPARE(partings(), std::size_t{1});
        // Saved and opened again.
        QVERIFY(m_window->files().save());
        QVERIFY(m_window->files().open(m_file));
        QCOMPARE(partings(), std::size_t{1});
        m_window->actions().get("groom.clear_partings").trigger();
        QCOMPARE(partings(), std::size_t{0});
        QVERIFY(m_window->files().save());
    }

    void hairsOfTheSidesShareNoGuides() {
        testing::drag(view(), {at(0.5, 0.05), at(0.5, 0.95)});
        QCOMPARE(partings(), std::size_t{1});
        QVERIFY(testing::settle(*m_window));
        const Groom groom = document().committed();
        const std::shared_ptr<const Strands> strands = view().strands();
        QVERIFY(strands && strands->count() > 2500);
        // The shown hair near the line leans to its own side as far as guides do: nothing is mixed in from the other.
        const float top = 0.06f;
        int beside = 0;
        for (std::size_t i = 0; i < strands->count(); ++i) {
            const glm::vec3 root = strands->positions[strands->firstVertex[i]];
            const glm::vec3 tip = strands->positions[strands->firstVertex[i + 1] - 1];
            // A hand draws no straighter than a pixel.
            if (root.z < 0.0f || std::abs(root.y) > top || std::abs(root.x) > 0.02f || std::abs(root.x) < 0.002f)
                continue;
            ++beside;
            QVERIFY((tip.x - root.x) * root.x > 0.0f && std::abs(tip.x - root.x) > 0.04f);
        }
        QVERIFY(beside > 40);
        Progress progress;
        int parted = 0;
        for (std::uint32_t id = 0; id < 3000; id += 5) {
            const auto hair = explainHair(groom, document().surface(), id, 3000, progress);
            QVERIFY(hair.ok());
            const glm::vec3 root = hair->root.position;
            if (root.z < 0.0f || std::abs(root.y) > top || std::abs(root.x) > 0.02f || std::abs(root.x) < 0.002f)
                continue;
            for (const ExplainedGuide& guide : hair->guides)
                QVERIFY(groom.guides.points(guide.index)[0].x * root.x > 0.0f);
            parted += !hair->separated.empty();
        }
        QVERIFY(parted > 3);
    }

    void controlErases() {
        testing::drag(view(), {at(0.45, 0.3), at(0.45, 0.7)});
        testing::drag(view(), {at(0.55, 0.3), at(0.55, 0.7)});
        QCOMPARE(partings(), std::size_t{2});
        BrushOptions options = m_window->state().brushOptions();
        options.radius = 12.0f;
        m_window->state().setBrushOptions(options);
        testing::drag(view(), {at(0.44, 0.5), at(0.46, 0.5)}, Qt::ControlModifier);
        QCOMPARE(partings(), std::size_t{1});
        QCOMPARE(document().groom().partings->front().id, 2u);
        document().undo();
        QCOMPARE(partings(), std::size_t{2});
    }

    void picture() {
        testing::drag(view(), {at(0.5, 0.05), at(0.5, 0.95)});
        QVERIFY(testing::settle(*m_window));
        const QImage picture = view().grabFramebuffer();
        const QString file = qEnvironmentVariable("WHORL_TEST_PICTURES");
        if (!file.isEmpty()) QVERIFY(m_window->grab().save(file + "/parting_window.png"));
        // The line is seen: bright green pixels in the middle.
        int bright = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = picture.width() * 2 / 5; x < picture.width() * 3 / 5; ++x) {
                const QColor c = picture.pixelColor(x, y);
                bright += c.green() > 150 && c.green() > c.red() + 60;
            }
        }
        QVERIFY2(bright > 100, qPrintable(QString::number(bright)));
    }
};

QTEST_MAIN(PartingTest)
#include "parting_test.moc"
