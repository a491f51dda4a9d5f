// SPDX-License-Identifier: Apache-2.0
// Pen, sliders, keys, palette, drag and drop, recent files, recovery: in the real window.
#include "core/io/document.h"
#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/dialogs/dialogs.h"
#include "editor/app/files.h"
#include "editor/app/groom_actions.h"
#include "editor/app/viewport/viewport_area.h"
#include "editor/app/widgets/message_bar.h"
#include "tests/editor/window.h"

#include <glm/geometric.hpp>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMimeData>
#include <QPointingDevice>
#include <QPushButton>
#include <QScrollBar>
#include <QSlider>
#include <QTabletEvent>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <cmath>

using namespace whorl;

class InteractionTest : public QObject, private testing::WindowFixture {
    Q_OBJECT

    void sendPen(QEvent::Type type, QPoint at, double pressure, Qt::MouseButton button = Qt::LeftButton) {
        static const QPointingDevice pen("pen", 17, QInputDevice::DeviceType::Stylus, QPointingDevice::PointerType::Pen,
                                         QInputDevice::Capability::Position | QInputDevice::Capability::Pressure, 1, 2);
        const Qt::MouseButtons held = type == QEvent::TabletRelease ? Qt::NoButton : Qt::MouseButtons(button);
        QTabletEvent event(type, &pen, at, view().mapToGlobal(at), pressure, 0, 0, 0, 0, 0, {},
                           type == QEvent::TabletMove ? Qt::NoButton : button, held);
        QApplication::sendEvent(&view(), &event);
        QVERIFY(event.isAccepted());
    }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("interaction_test");
        testing::useScratchSettings(m_folder);
        m_file = m_folder / "ball.whorl";
        Progress progress;
        QVERIFY(saveDocument(testing::groomOn(testing::sphere(24, 32), 300), m_file, progress).ok());
    }

    void init() {
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP(qPrintable("No viewport: " + m_window->area().problem()));
        // Pictures are not what this test looks at.
        ViewOptions options = m_window->state().viewOptions();
        options.samples = 1;
        options.shadows.index = 0;
        m_window->state().setViewOptions(options);
        m_window->resize(900, 640);
        QVERIFY(m_window->files().open(m_file));
    }

    void cleanup() { close(); }

    void penPressureMakesStrokesStronger() {
        m_window->actions().get("tool.comb").trigger();
        const auto stroke = [&](double pressure) {
            sendPen(QEvent::TabletPress, centre() - QPoint(60, 0), pressure);
            for (int i = -50; i <= 60; i += 10) sendPen(QEvent::TabletMove, centre() + QPoint(i, 0), pressure);
            sendPen(QEvent::TabletRelease, centre() + QPoint(60, 0), 0.0);
        };
        const Groom before = document().committed();
        const auto moved = [&] {
            double sum = 0;
            for (std::size_t i = 0; i < before.guides.count(); ++i) {
                sum += static_cast<double>(
                    glm::distance(before.guides.points(i).back(), document().committed().guides.points(i).back()));
            }
            return sum;
        };
        stroke(0.15);
        QCOMPARE(document().history().count(), 1);
        const double soft = moved();
        document().undo();
        stroke(1.0);
        const double firm = moved();
        QVERIFY2(soft > 0 && firm > 1.5 * soft, qPrintable(QString("%1 %2").arg(soft).arg(firm)));
    }

    void sliderDragIsOneStep() {
        auto* slider = find<QSlider>("cut_slider");
        QVERIFY(slider);
        find<QWidget>("dock_hair")->raise();
        QTest::qWait(20);
        const int steps = document().history().count();
        const float before = document().committed().groups->front().params.general.cut.value;
        // QSlider's own path from press to release, without knowing where the style draws the handle.
        slider->setSliderDown(true);
        for (int position = 900; position >= 300; position -= 100) {
            slider->setSliderPosition(position);
            QVERIFY(document().previewing());
            QCOMPARE(document().history().count(), steps);
        }
        QCOMPARE(document().groom().groups->front().params.general.cut.value, 0.3f);
        QCOMPARE(document().committed().groups->front().params.general.cut.value, before);
        slider->setSliderDown(false);
        QVERIFY(!document().previewing());
        QCOMPARE(document().history().count(), steps + 1);
        QCOMPARE(document().committed().groups->front().params.general.cut.value, 0.3f);
        auto* reset = find<QToolButton>("cut_reset");
        QVERIFY(reset->isVisibleTo(reset->parentWidget()));
        reset->click();
        QCOMPARE(document().committed().groups->front().params.general.cut.value, 1.0f);
        QVERIFY(!reset->isVisibleTo(reset->parentWidget()));
        document().undo();
        document().undo();
        QCOMPARE(document().committed().groups->front().params.general.cut.value, before);
    }

    void escapeDropsASliderDrag() {
        auto* slider = find<QSlider>("cut_slider");
        slider->setSliderDown(true);
        slider->setSliderPosition(400);
        QVERIFY(document().previewing());
        QTest::keyClick(slider, Qt::Key_Escape);
        QVERIFY(!document().previewing());
        slider->setSliderDown(false);
        QCOMPARE(document().history().count(), 0);
    }

    void numbersShowTheUnitOfTheArtist() {
        auto* box = find<QDoubleSpinBox>("root_thickness_box");
        QCOMPARE(box->suffix(), QString(" mm"));
        QCOMPARE(box->text(), QString("0.09 mm"));
        box->setValue(0.12);
        QVERIFY(std::abs(document().committed().groups->front().params.general.rootThickness.value - 0.00012f) < 1e-9f);
    }

    void mapsOfParameters() {
        auto* button = find<QToolButton>("cut_map_button");
        Q_EMIT button->menu()->aboutToShow();
        button->menu()->actions().back()->trigger();  // New map
        QCOMPARE(document().committed().groups->front().params.general.cut.map, std::string("cut"));
        QVERIFY(document().committed().maps.find("cut"));
        QCOMPARE(find<QListWidget>("map_list")->count(), 1);
        QVERIFY(checkGroom(document().committed()).empty());
        find<QListWidget>("map_list")->setCurrentRow(0);
        find<QPushButton>("map_remove")->click();
        QVERIFY(document().committed().groups->front().params.general.cut.map.empty());
        QVERIFY(checkGroom(document().committed()).empty());
    }

    void groupsAreAddedRenamedRemoved() {
        auto* list = find<QListWidget>("group_list");
        find<QToolButton>("group_add")->click();
        QCOMPARE(list->count(), 2);
        QCOMPARE(m_window->state().group(), 1);
        list->item(1)->setText("brows");
        QCOMPARE(document().committed().groups->at(1).name, std::string("brows"));
        list->item(1)->setText("no/name");
        QCOMPARE(document().committed().groups->at(1).name, std::string("brows"));
        QCOMPARE(list->item(1)->text(), QString("brows"));
        find<QToolButton>("group_remove")->click();
        QCOMPARE(list->count(), 1);
        document().undo();
        QCOMPARE(list->count(), 2);
        QVERIFY(checkGroom(document().committed()).empty());
    }

    void paintChoosesItsMap() {
        QAction& pick = m_window->actions().get("tool.paint");
        const auto painted = [&] { return m_window->state().brushOptions().map.name; };
        const auto stroke = [&] { testing::drag(view(), {centre() - QPoint(30, 0), centre() + QPoint(30, 0)}); };
        const QString said = m_window->area().messages().sentence();
        m_window->actions().get("tool.comb").trigger();
        // No map at all: picking the tool makes the density map of the group.
        QVERIFY(document().committed().maps.entries().empty());
        pick.trigger();
        const std::string density = document().committed().groups->front().params.general.density.map;
        QVERIFY(!density.empty());
        QCOMPARE(painted(), density);
        QCOMPARE(document().history().count(), 1);
        BrushOptions options = m_window->state().brushOptions();
        options.value = 0.0f;
        m_window->state().setBrushOptions(options);
        stroke();
        QCOMPARE(m_window->area().messages().sentence(), said);
        QCOMPARE(document().history().count(), 2);
        // A map that the artist chose stays chosen.
        find<QPushButton>("map_add")->click();
        options.map.name = document().committed().maps.entries().back().name;
        QVERIFY(options.map.name != density);
        m_window->state().setBrushOptions(options);
        m_window->actions().get("tool.comb").trigger();
        pick.trigger();
        QCOMPARE(painted(), options.map.name);
        // When it goes, the density map comes back; when that goes too, a press makes a new one.
        document().undo();
        QCOMPARE(painted(), density);
        document().undo();
        document().undo();
        QCOMPARE(painted(), std::string());
        stroke();
        QCOMPARE(m_window->area().messages().sentence(), said);
        QVERIFY(document().committed().maps.find(painted()));
        QCOMPARE(document().history().count(), 2);
    }

    void modifiersAreAListWithOneUndoEach() {
        find<QWidget>("dock_hair")->raise();
        const auto names = [&] {
            QStringList all;
            for (const Modifier& modifier : document().committed().groups->front().params.modifiers) {
                all << QString::fromStdString(modifier.name);
            }
            return all;
        };
        const auto modifier = [&](int i) {
            return document().committed().groups->front().params.modifiers.at(static_cast<std::size_t>(i));
        };
        const std::uint64_t bare = testing::groomDigest(document().committed());
        find<QAction>("modifier_add_clump")->trigger();
        find<QAction>("modifier_add_curl")->trigger();
        QCOMPARE(names(), (QStringList{"clump", "curl"}));
        QCOMPARE(document().history().count(), 2);
        find<QToolButton>("modifier_curl_up")->click();
        QCOMPARE(names(), (QStringList{"curl", "clump"}));
        QVERIFY(!find<QToolButton>("modifier_curl_up")->isEnabled());
        QVERIFY(!find<QToolButton>("modifier_clump_down")->isEnabled());
        find<QCheckBox>("modifier_clump_switch")->click();
        QVERIFY(!modifier(1).on);
        QCOMPARE(document().history().count(), 4);
        // A parameter of the form, which is folded out for a modifier that was just added.
        auto* form = find<QWidget>("modifier_curl_form");
        QVERIFY(form->isVisibleTo(form->parentWidget()));
        auto* amount = form->findChild<QDoubleSpinBox*>("amount_box");
        QVERIFY(amount);
        amount->setFocus();
        amount->selectAll();
        QTest::keyClicks(amount, "0.25");
        QTest::keyClick(amount, Qt::Key_Return);
        QCOMPARE(modifier(0).amount.value, 0.25f);
        QCOMPARE(document().history().count(), 5);
        find<QToolButton>("modifier_curl_fold")->click();
        QVERIFY(!form->isVisibleTo(form->parentWidget()));
        find<QToolButton>("modifier_clump_remove")->click();
        QCOMPARE(names(), QStringList{"curl"});
        document().undo();
        QCOMPARE(names(), (QStringList{"curl", "clump"}));
        QVERIFY(!find<QCheckBox>("modifier_clump_switch")->isChecked());
        const QList<QAction*> wholes = find<QMenu>("modifier_presets")->actions();
        QVERIFY(!wholes.isEmpty());
        wholes.front()->trigger();
        QVERIFY(names() != (QStringList{"curl", "clump"}));
        QVERIFY(checkGroom(document().committed()).empty());
        while (document().history().canUndo()) document().undo();
        QCOMPARE(testing::groomDigest(document().committed()), bare);
        QVERIFY(!m_window->findChild<QCheckBox*>("modifier_clump_switch"));
    }

    void groupsArePaintedOnTheModel() {
        find<QToolButton>("group_add")->click();
        QCOMPARE(document().committed().groups->size(), std::size_t{2});
        QCOMPARE(m_window->state().group(), 1);
        QVERIFY(document().committed().counts->groupMap.name.empty());
        const int steps = document().history().count();
        m_window->actions().get("tool.group").trigger();
        // Picking the tool makes the map, and shows it.
        const std::string map = document().committed().counts->groupMap.name;
        QVERIFY(document().committed().maps.find(map));
        QCOMPARE(document().history().count(), steps + 1);
        QVERIFY(view().viewSettings().overlayGroups);
        QCOMPARE(view().viewSettings().overlayMap, map);
        const auto count = [&](float number) {
            const Map& groups = *document().committed().maps.find(map);
            int found = 0;
            for (int y = 0; y < groups.height(); ++y) {
                for (int x = 0; x < groups.width(); ++x) {
                    const float stored = std::round(groups.texel(x, y) * 255.0f);
                    if (stored != 0.0f && stored != 1.0f) return -1;
                    found += stored == number;
                }
            }
            return found;
        };
        const std::uint64_t before = testing::groomDigest(document().committed());
        testing::drag(view(), {centre() - QPoint(30, 0), centre() + QPoint(30, 0)});
        QCOMPARE(document().history().count(), steps + 2);
        const int painted = count(1.0f);
        QVERIFY2(painted > 100, qPrintable(QString::number(painted)));
        // Guides that are placed now belong to the painted group there, and hair grows from them.
        QVERIFY(m_window->groomActions().placeGuides(300, false));
        QVERIFY(testing::settle(*m_window));
        const auto strands = view().strands();
        const auto inGroup = std::count(strands->groups.begin(), strands->groups.end(), std::uint8_t{1});
        QVERIFY(inGroup > 0 && static_cast<std::size_t>(inGroup) < strands->groups.size());
        document().undo();
        testing::drag(view(), {centre(), centre() + QPoint(5, 0)}, Qt::ControlModifier);
        QVERIFY(count(1.0f) < painted && count(1.0f) >= 0);
        document().undo();
        document().undo();
        QCOMPARE(testing::groomDigest(document().committed()), before);
    }

    void askedAgainstPlacedIsShown() {
        const auto picture = [&] {
            QTest::mouseMove(&view(), QPoint(3, 3));
            if (!testing::settle(*m_window)) return QImage();
            return view().grabFramebuffer();
        };
        m_window->actions().get("tool.look").trigger();
        const QImage hairy = picture();
        QAction& heat = m_window->actions().get("view.heat");
        heat.trigger();
        QVERIFY(heat.isChecked());
        QVERIFY(m_window->state().viewOptions().heat);
        const QImage shown = picture();
        QVERIFY(!view().viewSettings().showHair);
        // The sampler places what is asked for: the model is light all over.
        const QColor middle = shown.pixelColor(shown.rect().center());
        QVERIFY2(middle.lightness() > 120 && std::abs(middle.red() - middle.blue()) < 90, qPrintable(middle.name()));
        QVERIFY(hairy != shown);
        heat.trigger();
        QVERIFY(!m_window->state().viewOptions().heat);
        QCOMPARE(document().history().count(), 0);
    }

    void brushKeys() {
        view().setFocus();
        QTest::keyClick(&view(), Qt::Key_C);
        QVERIFY(m_window->state().brush() && m_window->state().brush()->id == "comb");
        const float radius = m_window->state().brushOptions().radius;
        QTest::keyClick(&view(), Qt::Key_BracketRight);
        QVERIFY(m_window->state().brushOptions().radius > radius);
        QTest::keyClick(&view(), Qt::Key_BracketLeft);
        QVERIFY(std::abs(m_window->state().brushOptions().radius - radius) < 0.01f);
        QTest::keyClick(&view(), Qt::Key_X);
        QVERIFY(m_window->state().brushOptions().mirror);
        QTest::keyClick(&view(), Qt::Key_X);
        QVERIFY(!m_window->state().brushOptions().mirror);

        const auto move = [&](QPoint p) {
            QMouseEvent event(QEvent::MouseMove, p, view().mapToGlobal(p), Qt::NoButton, Qt::NoButton, {});
            QApplication::sendEvent(&view(), &event);
        };
        for (const Qt::Key key : {Qt::Key_F, Qt::Key_B}) {
            move(centre());
            QTest::keyPress(&view(), key);
            move(centre() + QPoint(40, 0));
            QCOMPARE(m_window->state().brushOptions().radius, radius + 40);
            QTest::keyRelease(&view(), key);
            move(centre());
            QCOMPARE(m_window->state().brushOptions().radius, radius + 40);
            QTest::keyPress(&view(), key);
            move(centre() - QPoint(40, 0));
            QTest::keyClick(&view(), Qt::Key_Escape);
            QTest::keyRelease(&view(), key);
            QCOMPARE(m_window->state().brushOptions().radius, radius + 40);
            BrushOptions options = m_window->state().brushOptions();
            options.radius = radius;
            m_window->state().setBrushOptions(options);
        }
        const float strength = m_window->state().brushOptions().strength;
        move(centre());
        QTest::keyPress(&view(), Qt::Key_F, Qt::ShiftModifier);
        move(centre() + QPoint(60, 0));
        QTest::keyRelease(&view(), Qt::Key_F, Qt::ShiftModifier);
        QVERIFY(m_window->state().brushOptions().strength > strength);
        QCOMPARE(document().history().count(), 0);
    }

    void heldKeysAreExplained() {
        auto* hint = find<QLabel>("hint");
        m_window->actions().get("tool.comb").trigger();
        const QString plain = hint->text();
        QVERIFY(!plain.isEmpty());
        view().setFocus();
        // Events of a modifier key carry the state before them, as the window system sends it.
        QKeyEvent shift(QEvent::KeyPress, Qt::Key_Shift, Qt::NoModifier);
        QApplication::sendEvent(&view(), &shift);
        QVERIFY(hint->text().contains("smooth", Qt::CaseInsensitive));
        QKeyEvent release(QEvent::KeyRelease, Qt::Key_Shift, Qt::ShiftModifier);
        QApplication::sendEvent(&view(), &release);
        QCOMPARE(hint->text(), plain);
    }

    void shiftSmoothsAndControlInverts() {
        m_window->actions().get("tool.grow").trigger();
        testing::drag(view(), {centre() - QPoint(30, 0), centre() + QPoint(30, 0)}, Qt::ShiftModifier);
        if (document().history().count() == 1) QCOMPARE(document().history().undoText(), QString("Smooth guides"));
        const auto length = [&] {
            double sum = 0;
            const GuideSet& guides = document().committed().guides;
            for (std::size_t i = 0; i < guides.count(); ++i) {
                const auto points = guides.points(i);
                sum += static_cast<double>(glm::distance(points.front(), points.back()));
            }
            return sum;
        };
        const double before = length();
        testing::drag(view(), {centre() - QPoint(30, 0), centre() + QPoint(30, 0)});
        const double grown = length();
        QVERIFY(grown > before);
        testing::drag(view(), {centre() - QPoint(30, 0), centre() + QPoint(30, 0)}, Qt::ControlModifier);
        QVERIFY(length() < grown);
    }

    void navigationStyles() {
        m_window->actions().get("tool.comb").trigger();
        const Camera before = view().camera();
        testing::drag(view(), {centre(), centre() + QPoint(50, 20)}, Qt::AltModifier);
        QVERIFY(view().camera().azimuth != before.azimuth);
        testing::drag(view(), {centre(), centre() + QPoint(50, 20)}, Qt::AltModifier, Qt::MiddleButton);
        QVERIFY(view().camera().target != before.target);
        testing::drag(view(), {centre(), centre() + QPoint(50, 0)}, Qt::AltModifier, Qt::RightButton);
        QVERIFY(view().camera().distance != before.distance);
        Camera now = view().camera();
        testing::drag(view(), {centre(), centre() + QPoint(50, 20)}, {}, Qt::MiddleButton);
        QCOMPARE(view().camera().azimuth, now.azimuth);
        m_window->state().setNavigation(NavigationStyle::Blender);
        testing::drag(view(), {centre(), centre() + QPoint(50, 20)}, {}, Qt::MiddleButton);
        QVERIFY(view().camera().azimuth != now.azimuth);
        now = view().camera();
        testing::drag(view(), {centre(), centre() + QPoint(50, 20)}, Qt::ShiftModifier, Qt::MiddleButton);
        QVERIFY(view().camera().target != now.target);
        m_window->actions().get("view.back").trigger();
        QVERIFY(std::abs(std::cos(view().camera().azimuth) + 1.0f) < 1e-4f);
        QCOMPARE(document().history().count(), 0);
    }

    void tabHidesPanels() {
        view().setFocus();
        QVERIFY(find<QWidget>("dock_tool")->isVisible());
        QTest::keyClick(&view(), Qt::Key_Tab);
        QVERIFY(!find<QWidget>("dock_tool")->isVisible());
        QTest::keyClick(&view(), Qt::Key_Tab);
        QVERIFY(find<QWidget>("dock_tool")->isVisible());
    }

    void undoInTheMiddleOfAStroke() {
        m_window->actions().get("tool.comb").trigger();
        testing::drag(view(), {centre(), centre() + QPoint(40, 0)});
        QCOMPARE(document().history().count(), 1);
        testing::drag(view(), {centre(), centre() + QPoint(40, 0)}, {}, Qt::LeftButton, false);
        document().undo();
        QTest::mouseRelease(&view(), Qt::LeftButton, {}, centre());
        QCOMPARE(document().history().index(), 0);
        QVERIFY(document().history().canRedo());
    }

    void paletteFindsAndRuns() {
        m_window->actions().get("edit.palette").trigger();
        auto* palette = m_window->findChild<QDialog*>("command_palette");
        QVERIFY(palette && palette->isVisible());
        auto* input = palette->findChild<QLineEdit*>("palette_input");
        QTest::keyClicks(input, "remove all guides");
        QVERIFY(palette->findChild<QListWidget*>("palette_list")->currentItem()->text().contains("Remove All Guides"));
        QTest::keyClick(input, Qt::Key_Return);
        QVERIFY(document().committed().guides.empty());
        document().undo();
        QVERIFY(!document().committed().guides.empty());
    }

    void shortcutsCanBeChanged() {
        ShortcutDialog dialog(m_window->actions(), m_window.get());
        m_window->actions().setShortcut("view.all", QKeySequence("C"));
        QCOMPARE(m_window->actions().get("view.all").shortcut(), QKeySequence("C"));
        QVERIFY(m_window->actions().get("tool.comb").shortcut().isEmpty());
        QVERIFY(helpPage(m_window->actions()).contains("Show All"));
        m_window->actions().resetShortcuts();
        QCOMPARE(m_window->actions().get("tool.comb").shortcut(), QKeySequence("C"));
    }

    void noTwoActionsShareAKey() {
        QHash<QString, QString> owners;
        for (const ActionInfo& row : m_window->actions().table()) {
            if (row.kind == ActionInfo::Held) continue;
            for (const QKeySequence& key : m_window->actions().get(row.id).shortcuts()) {
                QVERIFY2(
                    !owners.contains(key.toString()),
                    qPrintable(QString("%1: %2 and %3").arg(key.toString(), row.id, owners.value(key.toString()))));
                owners.insert(key.toString(), row.id);
            }
            QVERIFY2(!row.tip.isEmpty(), qPrintable(row.id));
        }
    }

    void everythingHasANameForThoseWhoDoNotSeeIt() {
        for (const QWidget* widget : m_window->findChildren<QWidget*>()) {
            const bool control =
                qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QAbstractSlider*>(widget) ||
                qobject_cast<const QAbstractSpinBox*>(widget) || qobject_cast<const QComboBox*>(widget);
            if (!control || widget->objectName().startsWith("qt_") || qobject_cast<const QScrollBar*>(widget)) continue;
            const auto* button = qobject_cast<const QAbstractButton*>(widget);
            const bool named = !widget->accessibleName().isEmpty() || (button && !button->text().isEmpty());
            const QString parent = widget->parentWidget() ? widget->parentWidget()->metaObject()->className() : "";
            // Parts that Qt's own widgets are made of are named by Qt.
            if (parent.startsWith("QDock") || parent.startsWith("QTabBar") || parent == "QMenuBar" ||
                parent == "QToolBar")
                continue;
            QVERIFY2(named,
                     qPrintable(
                         QString("%1 %2 in %3").arg(widget->metaObject()->className(), widget->objectName(), parent)));
        }
    }

    void filesAreDropped() {
        const std::filesystem::path other = m_folder / "other ball.whorl";
        std::filesystem::copy_file(m_file, other, std::filesystem::copy_options::overwrite_existing);
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(textOf(other))});
        QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(m_window.get(), &enter);
        QVERIFY(enter.isAccepted());
        QDropEvent drop({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, {});
        QApplication::sendEvent(m_window.get(), &drop);
        QTRY_COMPARE(document().file().filename(), std::filesystem::path("other ball.whorl"));

        QVERIFY(m_window->files().recent().size() >= 2);
        QVERIFY(m_window->files().recent().front().endsWith("other ball.whorl"));
        auto* menu = m_window->findChild<QMenu*>("menu_recent");
        Q_EMIT menu->aboutToShow();
        QVERIFY(menu->actions().size() >= 3);
        menu->actions().at(1)->trigger();
        QCOMPARE(document().file().filename(), m_file.filename());
    }

    void badFilesEndInASentence() {
        const std::filesystem::path bad = m_folder / "bad.whorl";
        QFile file(textOf(bad));
        QVERIFY(file.open(QFile::WriteOnly) && file.write("WHORLDOC but not really") > 0);
        file.close();
        const std::uint64_t before = testing::groomDigest(document().committed());
        QVERIFY(!m_window->files().open(bad));
        QVERIFY(m_window->area().messages().sentence().contains("bad.whorl"));
        QVERIFY(!m_window->files().open(m_folder / "not there.whorl"));
        QVERIFY(m_window->area().messages().sentence().contains("not there.whorl"));
        QCOMPARE(testing::groomDigest(document().committed()), before);
        QCOMPARE(document().file().filename(), m_file.filename());
    }

    void openTwiceIsACopy() {
        auto second = std::make_unique<MainWindow>(m_folder / "journals2");
        QVERIFY(second->files().open(m_file));
        QVERIFY(second->document().file().empty());
        QVERIFY(second->area().messages().sentence().contains("open in another window"));
        QVERIFY(!second->files().saveTo(m_file));
        QVERIFY(second->files().saveTo(m_folder / "mine.whorl"));
    }

    void crashedWorkIsOfferedAndKept() {
        const std::filesystem::path journals = m_folder / "crash";
        m_window = nullptr;
        std::uint64_t lost = 0;
        {
            MainWindow crashing(journals);
            QVERIFY(crashing.files().open(m_file));
            Groom edited = crashing.document().committed();
            edited.counts.edit().seed = 4711;
            crashing.document().edit(std::move(edited), "Seed");
            lost = testing::groomDigest(crashing.document().committed());
            crashing.autosave().writeNow();
            crashing.autosave().wait();
            // No close: as after a crash, the journal stays.
        }
        QCOMPARE(findRecoveries(journals).size(), std::size_t{1});
        m_window = testing::openWindow(journals);
        bool restored = false;
        QTimer::singleShot(200, m_window.get(), [&] {
            auto* dialog = m_window->findChild<QDialog*>("recovery_dialog");
            QVERIFY(dialog);
            QCOMPARE(dialog->findChild<QListWidget*>("recovery_list")->count(), 1);
            dialog->findChild<QPushButton*>("recovery_restore")->click();
        });
        restored = m_window->offerRecovery();
        QVERIFY(restored);
        QCOMPARE(testing::groomDigest(document().committed()), lost);
        QCOMPARE(document().file().filename(), m_file.filename());
        QVERIFY(!document().clean());
        // Kept until an explicit save.
        QCOMPARE(findRecoveries(journals).size(), std::size_t{1});
        QVERIFY(m_window->files().saveTo(m_folder / "rescued.whorl"));
        QCOMPARE(findRecoveries(journals).size(), std::size_t{0});
    }

    void twentyStepsAreKeptSafe() {
        for (int i = 0; i < Autosave::steps; ++i) {
            Groom edited = document().committed();
            edited.counts.edit().seed = 100 + i;
            document().edit(std::move(edited), "Seed");
        }
        m_window->autosave().wait();
        QTRY_VERIFY(!m_window->autosave().file().empty());
        QVERIFY(std::filesystem::exists(m_window->autosave().file()));
        const std::filesystem::path journal = m_window->autosave().file();
        QVERIFY(m_window->files().saveTo(m_folder / "safe.whorl"));
        QVERIFY(!std::filesystem::exists(journal));
    }

    void unsavedWorkIsAskedFor() {
        m_window->groomActions().newSeed();
        const auto answer = [&](const char* button) {
            QTimer::singleShot(150, m_window.get(), [this, button] {
                auto* question = m_window->findChild<QWidget*>("unsaved_question");
                QVERIFY(question);
                for (QPushButton* b : question->findChildren<QPushButton*>()) {
                    if (b->text().remove('&') == button) return b->click();
                }
                QFAIL("no such button");
            });
        };
        answer("Cancel");
        QVERIFY(!m_window->close());
        QVERIFY(m_window->isVisible());
        answer("Discard");
        QVERIFY(m_window->close());
    }
};

QTEST_MAIN(InteractionTest)
#include "interaction_test.moc"
