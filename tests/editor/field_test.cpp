// SPDX-License-Identifier: Apache-2.0
// A coat from a few strokes in the real window: paint where hair grows, part it, sketch, grow guides along.
#include "core/commands/strokes.h"
#include "core/io/document.h"
#include "core/io/open.h"
#include "core/surface/parting_line.h"
#include "editor/app/actions.h"
#include "editor/app/autosave.h"
#include "editor/app/files.h"
#include "editor/app/resources.h"
#include "editor/app/viewport/viewport_area.h"
#include "editor/app/widgets/message_bar.h"
#include "tests/editor/window.h"

#include <glm/geometric.hpp>

#include <QAbstractButton>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QListWidget>
#include <QTest>
#include <algorithm>
#include <cmath>

using namespace whorl;

namespace {

/// Degrees between pieces of guides and of strokes where they pass within `near` metres of each other, along the skin,
/// on average. `count` of guides' pieces took part.
double meanAngle(const Groom& groom, const Surface& surface, float near, int& count) {
    double sum = 0.0;
    count = 0;
    for (std::size_t i = 0; i < groom.guides.count(); ++i) {
        const std::span<const glm::vec3> points = groom.guides.points(i);
        for (std::size_t p = 1; p < points.size(); ++p) {
            const glm::vec3 middle = (points[p - 1] + points[p]) * 0.5f;
            glm::vec3 way(0.0f);
            float nearest = near;
            for (const FieldStroke& stroke : *groom.strokes) {
                for (std::size_t k = 1; k < stroke.points.size(); ++k) {
                    const glm::vec3 from = positionAt(*groom.mesh, stroke.points[k - 1]),
                                    to = positionAt(*groom.mesh, stroke.points[k]);
                    const float distance = glm::distance((from + to) * 0.5f, middle);
                    if (distance >= nearest || from == to) continue;
                    nearest = distance;
                    way = to - from;
                }
            }
            const auto skin = way != glm::vec3(0.0f) ? surface.query.nearest(middle) : std::nullopt;
            if (!skin) continue;
            const glm::vec3 normal = normalAt(surface.mesh(), skin->point);
            const auto along = [&](const glm::vec3& v) { return glm::normalize(v - normal * glm::dot(v, normal)); };
            const float cosine = glm::dot(along(points[p] - points[p - 1]), along(way));
            sum += static_cast<double>(std::acos(glm::clamp(cosine, -1.0f, 1.0f)));
            ++count;
        }
    }
    return count > 0 ? sum / count * 180.0 / 3.14159265358979 : 180.0;
}

/// Of the texels where hair lies in both, the share whose light differs clearly.
double changedShare(const LicTexture& a, const LicTexture& b) {
    std::size_t both = 0, changed = 0;
    for (std::size_t i = 0; i < a.light->size() && i < b.light->size(); ++i) {
        if ((*a.cover)[i] < 128 || (*b.cover)[i] < 128) continue;
        ++both;
        changed += std::abs(int((*a.light)[i]) - int((*b.light)[i])) > 8;
    }
    return both > 0 ? static_cast<double>(changed) / static_cast<double>(both) : 0.0;
}

}  // namespace

class FieldTest : public QObject, private testing::WindowFixture {
    Q_OBJECT

    const std::vector<FieldStroke>& strokes() { return *document().groom().strokes; }
    void tool(const char* id) { m_window->actions().get(QString("tool.") + id).trigger(); }
    void size(float radius) {
        BrushOptions options = m_window->state().brushOptions();
        options.radius = radius;
        options.strength = 1.0f;
        m_window->state().setBrushOptions(options);
    }
    void keep(const char* name) {
        const QString folder = qEnvironmentVariable("WHORL_TEST_PICTURES");
        if (folder.isEmpty()) return;
        testing::settle(*m_window);
        QVERIFY(m_window->grab().save(folder + "/" + name));
    }

private Q_SLOTS:
    void initTestCase() {
        m_folder = testing::scratchFolder("field_test");
        testing::useScratchSettings(m_folder);
        const std::vector<std::filesystem::path> samples = sampleFiles();
        const auto bust = std::ranges::find_if(samples, [](const auto& f) { return f.stem() == "bust"; });
        QVERIFY2(bust != samples.end(), "the samples are built with the program");
        Progress progress;
        const Result<OpenedDocument> sample = openGroom(*bust, progress);
        QVERIFY(sample.ok());
        m_file = m_folder / "bald.whorl";
        Groom bald = makeGroom(*sample->groom.mesh);
        for (const MeshPart& part : bald.mesh->parts) {
            if (const Map* texture = sample->groom.maps.find(part.texture)) bald.maps.set(part.texture, *texture);
        }
        QVERIFY(saveDocument(bald, m_file, progress).ok());
    }

    void init() {
        m_window = testing::openWindow(m_folder / "journals");
        QVERIFY(m_window);
        if (!m_window->viewport()) QSKIP(qPrintable("No viewport: " + m_window->area().problem()));
        QVERIFY(m_window->files().open(m_file));
        view().lookFrom("front");
        view().frameAll();
        find<QDockWidget>("dock_field")->raise();
    }

    void cleanup() { close(); }

    void strokesArePickedChangedMovedAndRemoved() {
        auto* panel = find<QDockWidget>("dock_field");
        find<QDockWidget>("dock_groom")->raise();
        QTRY_VERIFY(panel->visibleRegion().isEmpty());
        tool("sketch");
        QTRY_VERIFY(!panel->visibleRegion().isEmpty());  // with the tool comes the list of what it draws
        size(30.0f);
        testing::drag(view(), {at(0.45, 0.2), at(0.45, 0.4)});
        testing::drag(view(), {at(0.55, 0.2), at(0.55, 0.4)});
        QCOMPARE(strokes().size(), std::size_t{2});
        auto* list = find<QListWidget>("stroke_list");
        QCOMPARE(list->count(), 2);
        QCOMPARE(list->currentRow(), 1);  // the one drawn last
        list->setCurrentRow(0);
        auto* weight = find<QDoubleSpinBox>("stroke_weight");
        weight->setValue(3.0);
        QCOMPARE(strokes()[0].weight, 3.0f);
        QCOMPARE(strokes()[1].weight, 1.0f);
        QVERIFY(!find<QDoubleSpinBox>("stroke_radius")->isEnabled());

        tool("move_stroke");
        const std::vector<FieldStroke> before = strokes();
        testing::drag(view(), {at(0.55, 0.3), at(0.58, 0.3)});
        QVERIFY(strokes()[0] == before[0] && !(strokes()[1] == before[1]));
        QCOMPARE(m_window->state().pickedStroke(), before[1].id);
        QTest::mouseClick(&view(), Qt::LeftButton, {}, at(0.45, 0.3));
        QCOMPARE(m_window->state().pickedStroke(), before[0].id);
        QTest::keyClick(m_window.get(), Qt::Key_Delete);
        QCOMPARE(strokes().size(), std::size_t{1});
        QCOMPARE(strokes()[0].id, before[1].id);
        document().undo();
        QCOMPARE(strokes().size(), std::size_t{2});
        // Saved and opened again.
        const std::vector<FieldStroke> saved = strokes();
        QVERIFY(saveDocument(document().committed(), m_folder / "again.whorl", m_progress).ok());
        document().markSaved(m_folder / "again.whorl");
        QVERIFY(m_window->files().open(m_folder / "again.whorl"));
        QVERIFY(strokes() == saved);
    }

    void mirroredWhorlsTurnAgainstEachOther() {
        tool("whorl");
        size(40.0f);
        BrushOptions options = m_window->state().brushOptions();
        options.mirror = true;
        m_window->state().setBrushOptions(options);
        QTest::mouseClick(&view(), Qt::LeftButton, {}, at(0.46, 0.3));
        QCOMPARE(strokes().size(), std::size_t{2});
        QVERIFY(strokes()[0].kind == StrokeKind::Whorl && strokes()[1].kind == StrokeKind::ClockwiseWhorl);
        const glm::vec3 a = positionAt(*document().groom().mesh, strokes()[0].points[0]),
                        b = positionAt(*document().groom().mesh, strokes()[1].points[0]);
        QVERIFY(glm::distance(a, glm::vec3(-b.x, b.y, b.z)) < 0.005f);
    }

    void aCoatFromEightStrokes() {
        // The growing area, all around the upper head.
        m_window->actions().get("groom.paint_density").trigger();
        size(120.0f);
        for (const char* side : {"front", "left", "back", "right", "top"}) {
            view().lookFrom(side);
            testing::drag(view(), {at(0.4, 0.2), at(0.6, 0.2)});
            testing::drag(view(), {at(0.4, 0.3), at(0.6, 0.3)});
        }
        for (const double y : {0.4, 0.5, 0.6, 0.7}) testing::drag(view(), {at(0.4, y), at(0.6, y)});
        // Shown as texture from now on: it lies as gravity has it, until there are strokes.
        auto* texture = find<QAbstractButton>("view_texture");
        QTest::mouseClick(texture, Qt::LeftButton);
        QVERIFY(texture->isChecked());
        QCOMPARE(m_window->state().viewOptions().hairAs.index, 1);
        view().lookFrom("top");
        QVERIFY(testing::settle(*m_window));
        const auto hanging = view().licTexture();
        QVERIFY(hanging && !hanging->empty());
        tool("parting");
        testing::drag(view(), {at(0.5, 0.85), at(0.5, 0.5), at(0.5, 0.35)});
        QCOMPARE(document().groom().partings->size(), std::size_t{1});
        tool("sketch");
        size(25.0f);
        // Four strokes on each side fall from the parting and back.
        for (const double side : {-1.0, 1.0}) {
            for (int i = 0; i < 4; ++i) {
                const double y = 0.72 - 0.1 * i;
                testing::drag(view(), {at(0.5 + 0.02 * side, y), at(0.5 + 0.06 * side, y - 0.02),
                                       at(0.5 + 0.1 * side, y - 0.06)});
            }
        }
        QCOMPARE(strokes().size(), std::size_t{8});
        QVERIFY(testing::settle(*m_window));
        const auto combed = view().licTexture();
        QVERIFY2(changedShare(*hanging, *combed) > 0.5, qPrintable(QString::number(changedShare(*hanging, *combed))));
        keep("field_strokes.png");
        QTest::mouseClick(texture, Qt::LeftButton);
        QVERIFY(!texture->isChecked());
        QCOMPARE(m_window->state().viewOptions().hairAs.index, 0);
        Groom placed = document().committed();
        placed.counts.edit().guides = 800;
        document().edit(std::move(placed), "guides");
        // Guides that are not there yet are placed first.
        const int steps = document().history().count();
        QTest::mouseClick(find<QAbstractButton>("groom_grow_along"), Qt::LeftButton);
        QCOMPARE(document().history().count(), steps + 1);
        QVERIFY(document().groom().guides.count() > 300);
        keep("field_grown.png");
        const Groom groom = document().committed();
        int count = 0;
        const double angle = meanAngle(groom, *document().surface(), 0.008f, count);
        qInfo("%d pieces of guides, mean angle %.2f degrees", count, angle);
        QVERIFY2(count >= 300, qPrintable(QString::number(count)));
        QVERIFY2(angle < 10.0, qPrintable(QString::number(angle)));
        // Along another way they do not.
        Groom turned = groom;
        for (FieldStroke& stroke : turned.strokes.edit()) std::ranges::reverse(stroke.points);
        QVERIFY(meanAngle(turned, *document().surface(), 0.008f, count) > 170.0);
    }

    // Guides led the field; the strokes made of them do, in one step that can be undone.
    void strokesMadeOfGuidesLead() {
        tool("sketch");
        size(30.0f);
        testing::drag(view(), {at(0.45, 0.2), at(0.55, 0.35)});
        m_window->actions().get("groom.grow_along").trigger();
        Groom led = document().committed();
        led.field.edit().follow = true;
        document().edit(std::move(led), "combing leads");
        const Groom before = document().committed();
        const int steps = document().history().count();
        m_window->actions().get("groom.strokes_from_guides").trigger();
        QVERIFY(strokes().size() > 1);
        QVERIFY(!document().groom().field->follow);
        QCOMPARE(document().history().count(), steps + 1);
        QVERIFY2(m_window->area().messages().sentence().contains("Combing leads"),
                 qPrintable(m_window->area().messages().sentence()));
        document().undo();
        QVERIFY(document().committed().sameAs(before));
        QVERIFY(document().groom().field->follow);
    }

private:
    Progress m_progress;
};

QTEST_MAIN(FieldTest)
#include "field_test.moc"
