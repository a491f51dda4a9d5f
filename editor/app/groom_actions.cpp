// SPDX-License-Identifier: Apache-2.0
#include "editor/app/groom_actions.h"

#include "core/commands/command.h"
#include "core/commands/group_edits.h"
#include "core/commands/strokes.h"
#include "core/commands/vertex_guides.h"
#include "core/field/groom_field.h"
#include "core/field/grow_guides.h"
#include "core/param/path.h"
#include "editor/app/actions.h"
#include "editor/app/document.h"
#include "editor/app/editor_state.h"
#include "editor/app/paint_map.h"
#include "editor/app/progress_task.h"
#include "editor/app/viewport/viewport.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_source.h"

#include <QWidget>
#include <algorithm>
#include <cmath>

namespace whorl {

GroomActions::GroomActions(Document& document, EditorState& state, Actions& actions, MessageBar& messages,
                           QWidget& window)
    : QObject(&window),
      m_document(document),
      m_state(state),
      m_actions(actions),
      m_messages(messages),
      m_window(window) {
    actions.on("edit.undo", this, [this] { m_document.undo(); });
    actions.on("edit.redo", this, [this] { m_document.redo(); });
    actions.on("groom.place_guides", this, [this] { placeGuides(m_document.committed().counts->guides, false); });
    actions.on("groom.add_guides", this, [this] { placeGuides(m_document.committed().counts->guides, true); });
    actions.on("groom.place_on_vertices", this, [this] { placeGuidesOnVertices(); });
    actions.on("groom.regroup_guides", this, [this] { regroupGuides(); });
    actions.on("groom.clear_guides", this, [this] { clearGuides(); });
    actions.on("groom.clear_partings", this, [this] { clearPartings(); });
    actions.on("groom.grow_along", this, [this] { growAlong(); });
    actions.on("groom.strokes_from_guides", this, [this] { strokesFromGuides(); });
    actions.on("groom.remove_stroke", this, [this] { removeStroke(); });
    actions.on("groom.clear_strokes", this, [this] { clearStrokes(); });
    actions.on("groom.paint_density", this, [this] { paintDensity(); });
    actions.on("groom.new_seed", this, [this] { newSeed(); });
    for (const BrushInfo& brush : brushes()) {
        if (!brush.paintsMap) continue;
        actions.on("tool." + qtext(brush.id), this,
                   [this, &brush] { choosePaintMap(m_document, m_state, brush, true); });
    }
    connect(&document, &Document::changed, this, &GroomActions::refresh);
    connect(&state, &EditorState::changed, this, &GroomActions::refresh);
    connect(&document.history(), &QUndoStack::indexChanged, this, &GroomActions::refresh);
    refresh();
}

void GroomActions::refresh() {
    const bool open = m_document.hasGroom();
    // Another document, or an undo, may have taken the painted map away.
    if (m_state.brush()) choosePaintMap(m_document, m_state, *m_state.brush(), false);
    for (const ActionInfo& row : m_actions.table()) {
        if (row.kind == ActionInfo::Held) continue;
        const bool needsGroom = row.id.startsWith("groom.") || row.id.startsWith("file.save") ||
                                row.id.startsWith("file.export") || row.id == "file.render";
        if (needsGroom) m_actions.get(row.id).setEnabled(open);
    }
    m_actions.get("groom.clear_partings").setEnabled(!m_document.groom().partings->empty());
    m_actions.get("groom.clear_strokes").setEnabled(!m_document.groom().strokes->empty());
    m_actions.get("groom.remove_stroke").setEnabled(findStroke(m_document.groom(), m_state.pickedStroke()) != nullptr);
    m_actions.get("groom.strokes_from_guides").setEnabled(!m_document.groom().guides.empty());
    m_actions.get("groom.regroup_guides").setEnabled(!m_document.groom().guides.empty());
    m_actions.get("groom.clear_guides").setEnabled(!m_document.groom().guides.empty());
    const auto name = [&](const char* id, const QString& verb, const QString& what) {
        m_actions.get(id).setText(what.isEmpty() ? verb : QString("%1 %2").arg(verb, what));
    };
    QUndoStack& history = m_document.history();
    m_actions.get("edit.undo").setEnabled(history.canUndo());
    m_actions.get("edit.redo").setEnabled(history.canRedo());
    name("edit.undo", tr("&Undo"), history.undoText());
    name("edit.redo", tr("&Redo"), history.redoText());
}

bool GroomActions::placeGuides(int count, bool keep) {
    m_document.revert();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!surface) return false;
    Groom after = m_document.committed();
    const Result<void> done = runWithProgress<void>(&m_window, tr("Placing guides"), [&](Progress& progress) {
        return whorl::placeGuides(after, *surface, static_cast<std::size_t>(std::max(count, 0)), 0.0f, keep, progress);
    });
    if (!done) {
        if (!done.error().cancelled) {
            m_messages.say(MessageBar::Kind::Warning, QString::fromStdString(done.error().message));
        }
        return false;
    }
    m_document.edit(std::move(after), keep ? tr("Fill up guides") : tr("Place guides"));
    return true;
}

void GroomActions::placeGuidesOnVertices() {
    m_document.revert();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!surface) return;
    Groom after = m_document.committed();
    const Result<void> done = runWithProgress<void>(&m_window, tr("Placing guides"), [&](Progress& progress) {
        return whorl::placeGuidesOnVertices(after, *surface, {}, progress);
    });
    if (done) {
        m_document.edit(std::move(after), tr("Place guides on vertices"));
    } else if (!done.error().cancelled) {
        m_messages.say(MessageBar::Kind::Warning, QString::fromStdString(done.error().message));
    }
}

void GroomActions::regroupGuides() {
    Groom after = m_document.committed();
    const std::size_t changed = whorl::regroupGuides(after);
    if (changed == 0) {
        m_messages.say(MessageBar::Kind::Info,
                       tr("All guides belong to the groups that are painted under them already."));
        return;
    }
    m_document.edit(std::move(after), tr("Guides to painted groups"));
}

void GroomActions::clearGuides() {
    Groom after = m_document.committed();
    after.guides.clear();
    m_document.edit(std::move(after), tr("Remove all guides"));
}

void GroomActions::clearPartings() {
    Groom after = m_document.committed();
    after.partings = {};
    m_document.edit(std::move(after), tr("Remove all partings"));
}

void GroomActions::growAlong() {
    m_document.revert();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!surface) return;
    Groom after = m_document.committed();
    const auto guides = static_cast<std::size_t>(std::max(after.counts->guides, 0));
    const Result<void> done =
        runWithProgress<void>(&m_window, tr("Growing guides"), [&](Progress& progress) -> Result<void> {
            if (after.guides.empty()) {
                auto placed = whorl::placeGuides(after, *surface, guides, 0.0f, false, progress);
                if (!placed) return placed;
            }
            const auto field = groomField(after, surface, progress);
            if (!field) return field.error();
            GrowAlong how = whorl::growAlong(*after.field);
            how.group = std::clamp(m_state.group(), 0, static_cast<int>(after.groups->size()) - 1);
            return growGuidesAlong(after, *surface, *field, how, progress);
        });
    if (done) {
        m_document.edit(std::move(after), tr("Grow guides along strokes"));
    } else if (!done.error().cancelled) {
        m_messages.say(MessageBar::Kind::Warning, QString::fromStdString(done.error().message));
    }
}

void GroomActions::strokesFromGuides() {
    m_document.revert();
    const std::shared_ptr<const Surface> surface = m_document.surface();
    if (!surface) return;
    Groom after = m_document.committed();
    const Result<void> done =
        runWithProgress<void>(&m_window, tr("Laying strokes along the guides"),
                              [&](Progress& progress) { return makeStrokesOfGuides(after, surface, -1, progress); });
    if (done) {
        const bool followed = m_document.committed().field->follow;
        m_document.edit(std::move(after), tr("Strokes from guides"));
        if (followed)
            m_messages.say(MessageBar::Kind::Info,
                           tr("Strokes lead the hair's direction now: \"Combing leads\" is off."));
    } else if (!done.error().cancelled) {
        m_messages.say(MessageBar::Kind::Warning, QString::fromStdString(done.error().message));
    }
}

void GroomActions::removeStroke() {
    Groom after = m_document.committed();
    if (whorl::removeStroke(after, m_state.pickedStroke())) m_document.edit(std::move(after), tr("Remove stroke"));
}

void GroomActions::clearStrokes() {
    Groom after = m_document.committed();
    after.strokes = {};
    m_document.edit(std::move(after), tr("Remove all strokes"));
}

void GroomActions::paintDensity() {
    paintDensityMap(m_document, m_state);
    m_state.setBrush(findBrush("paint"));
}

void GroomActions::newSeed() {
    Groom after = m_document.committed();
    const int seed = after.counts->seed;
    after.counts.edit().seed = seed >= 2147483647 ? 0 : seed + 1;
    m_document.edit(std::move(after), tr("New seed"), "seed");
}

ViewActions::ViewActions(EditorState& state, Actions& actions, Viewport* viewport, QWidget& window)
    : QObject(&window), m_state(state), m_actions(actions) {
    actions.on("tool.look", this, [this] { m_state.setBrush(nullptr); });
    for (const BrushInfo& brush : brushes()) {
        actions.on("tool." + qtext(brush.id), this, [this, &brush] { m_state.setBrush(&brush); });
    }
    const auto resize = [this](float factor) {
        BrushOptions options = m_state.brushOptions();
        options.radius = std::clamp(options.radius * factor, 1.0f, 2000.0f);
        m_state.setBrushOptions(options);
    };
    actions.on("brush.smaller", this, [resize] { resize(1.0f / 1.15f); });
    actions.on("brush.larger", this, [resize] { resize(1.15f); });
    actions.onToggle("brush.mirror", this, [this](bool on) {
        BrushOptions options = m_state.brushOptions();
        options.mirror = on;
        m_state.setBrushOptions(options);
    });
    const auto toggle = [this, &actions](const char* id, bool ViewOptions::*member) {
        actions.onToggle(id, this, [this, member](bool on) {
            ViewOptions options = m_state.viewOptions();
            options.*member = on;
            m_state.setViewOptions(options);
        });
    };
    toggle("view.hair", &ViewOptions::showHair);
    toggle("view.guides", &ViewOptions::showGuides);
    toggle("view.mesh", &ViewOptions::showMesh);
    toggle("view.heat", &ViewOptions::heat);
    actions.onToggle("view.texture", this, [this](bool on) {
        ViewOptions options = m_state.viewOptions();
        options.hairAs.index = on ? 1 : 0;
        options.showHair |= on;
        options.heat &= !on;
        m_state.setViewOptions(options);
    });
    actions.onToggle("view.fullscreen", this, [&window](bool on) {
        window.setWindowState(on ? window.windowState() | Qt::WindowFullScreen
                                 : window.windowState() & ~Qt::WindowFullScreen);
    });
    if (viewport) {
        actions.on("view.all", this, [viewport] { viewport->frameAll(); });
        actions.on("view.frame", this, [viewport] { viewport->frameHair(); });
        for (const char* side : {"front", "back", "left", "right", "top"}) {
            actions.on(QString("view.") + side, this, [viewport, side] { viewport->lookFrom(side); });
        }
    }
    connect(&state, &EditorState::changed, this, &ViewActions::refresh);
    refresh();
}

void ViewActions::refresh() {
    const BrushInfo* brush = m_state.brush();
    m_actions.get(brush ? "tool." + qtext(brush->id) : QString("tool.look")).setChecked(true);
    m_actions.get("brush.mirror").setChecked(m_state.brushOptions().mirror);
    m_actions.get("view.hair").setChecked(m_state.viewOptions().showHair);
    m_actions.get("view.guides").setChecked(m_state.viewOptions().showGuides);
    m_actions.get("view.mesh").setChecked(m_state.viewOptions().showMesh);
    m_actions.get("view.heat").setChecked(m_state.viewOptions().heat);
    m_actions.get("view.texture").setChecked(m_state.viewOptions().hairAs.index != 0);
}

}  // namespace whorl
