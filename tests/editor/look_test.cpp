// SPDX-License-Identifier: Apache-2.0
// Looking at hair in the real window: why a hair is as it is, time, level of detail; guides and their groups.
#include "core/commands/group_edits.h"
#include "core/io/document.h"
#include "core/param/path.h"
#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/files.h"
#include "editor/app/panels/explain_panel.h"
#include "editor/app/viewport/viewport_area.h"
#include "tests/editor/window.h"

#include <QTest>
#include <QTreeWidget>
#include <algorithm>

using namespace whorl;

class LookTest : public QObject, private testing::WindowFixture {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("look_test");
        testing::useScratchSettings(m_folder);
        m_file = m_folder / "ball.whorl";
        Progress progress;
        QVERIFY(saveDocument(testing::groomOn(testing::sphere(24, 32), 300), m_file, progress).ok());
    }

    void init() {
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP("No viewport on this machine.");
        m_window->resize(900, 640);
        QVERIFY(m_window->files().open(m_file));
    }

    void cleanup() { close(); }

    void aClickedHairSaysWhyItIsSo() {
        QVERIFY(testing::settle(*m_window));
        m_window->actions().get("tool.look").trigger();
        auto* panel = find<ExplainPanel>("explain_panel");
        QVERIFY(panel && !panel->hair());
        const Camera before = view().camera();
        // A drag turns the view and explains nothing.
        testing::drag(view(), {centre(), centre() + QPoint(40, 0)});
        QVERIFY(!panel->hair());
        QVERIFY(view().camera().azimuth != before.azimuth);
        view().setCamera(before);
        QTest::mouseClick(&view(), Qt::LeftButton, {}, centre());
        QVERIFY(panel->hair());
        auto* rows = find<QTreeWidget>("explain_rows");
        QTRY_VERIFY(rows->topLevelItemCount() > 5);
        const auto value = [&](const QString& what) {
            const QList<QTreeWidgetItem*> found = rows->findItems(what, Qt::MatchStartsWith);
            return found.isEmpty() ? QString() : found.front()->text(1);
        };
        QCOMPARE(value("Group"), QString("hair"));
        QVERIFY(value("Guide ").contains("mm away"));
        const QString length = value("After cut");
        QVERIFY(length.contains("mm long"));
        // It follows edits of the groom.
        Groom shorter = document().committed();
        QVERIFY(setGroomValue(shorter, "groups/hair/general/scale", 0.5).ok());
        document().edit(std::move(shorter), "Shorter");
        QTRY_VERIFY(!value("After cut").isEmpty() && value("After cut") != length);
        // A click beside the model lets go of it.
        QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(4, view().height() / 2));
        QVERIFY(!panel->hair());
        QCOMPARE(rows->topLevelItemCount(), 0);
    }

    void timeAndDetailChangeWhatIsShown() {
        Groom moving = document().committed();
        QVERIFY(setGroomValue(moving, "groups/hair/frizz/tip", 0.05).ok());
        QVERIFY(setGroomValue(moving, "groups/hair/frizz/animation", 1.0).ok());
        document().edit(std::move(moving), "Moving");
        QVERIFY(testing::settle(*m_window));
        const auto first = view().strands();
        QVERIFY(first->count() > 1000);
        ViewOptions options = m_window->state().viewOptions();
        options.time = 0.7f;
        m_window->state().setViewOptions(options);
        QVERIFY(testing::settle(*m_window));
        const auto later = view().strands();
        QCOMPARE(later->ids, first->ids);
        QVERIFY(later->positions != first->positions);
        options.detail = 0.25f;
        m_window->state().setViewOptions(options);
        QVERIFY(testing::settle(*m_window));
        const auto far = view().strands();
        QVERIFY(far->count() > first->count() / 6 && far->count() < first->count() / 3);
        QVERIFY(far->widths[0] > 1.5f * first->widths[0]);
        // A subset, so that none comes that is not there near by.
        std::vector<std::uint32_t> all = first->ids, some = far->ids;
        std::ranges::sort(all);
        std::ranges::sort(some);
        QVERIFY(std::ranges::includes(all, some));
    }

    void guidesOnVerticesAndInGroups() {
        m_window->actions().get("groom.place_on_vertices").trigger();
        const std::size_t guides = document().committed().guides.count();
        QVERIFY2(guides > 700 && guides <= 24 * 33, qPrintable(QString::number(guides)));
        Groom parted = document().committed();
        QVERIFY(addGroup(parted, "left", 0).ok());
        Map half(64, 64, 1, TexelFormat::U8, 0.0f);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 32; ++x) half.setTexel(x, y, 0, 1.0f / 255.0f);
        }
        parted.maps.set("groups", std::move(half));
        parted.counts.edit().groupMap.name = "groups";
        document().edit(std::move(parted), "Groups");
        const int steps = document().history().count();
        m_window->actions().get("groom.regroup_guides").trigger();
        QCOMPARE(document().history().count(), steps + 1);
        std::size_t left = 0;
        for (std::size_t i = 0; i < guides; ++i) left += document().committed().guides.group(i) == 1;
        QVERIFY(left > guides / 3 && left < guides * 2 / 3);
        // Nothing to do the second time.
        m_window->actions().get("groom.regroup_guides").trigger();
        QCOMPARE(document().history().count(), steps + 1);
    }
};

QTEST_MAIN(LookTest)
#include "look_test.moc"
