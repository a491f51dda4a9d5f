// SPDX-License-Identifier: Apache-2.0
// Panels that are little more than a form.
#include "editor/app/actions.h"
#include "editor/app/panels/groom_source.h"
#include "editor/app/panels/panels.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_form.h"

#include <QHeaderView>
#include <QPushButton>
#include <QTreeWidget>
#include <QUndoView>
#include <QVBoxLayout>

namespace whorl {

GroomPanel::GroomPanel(PanelContext context, QWidget* parent) : QWidget(parent) {
    setObjectName("groom_panel");
    auto* source = new GroomSource(context.document, context.state, "counts", this);
    connect(source, &GroomSource::said, this,
            [context](const QString& sentence) { context.messages.say(MessageBar::Kind::Warning, sentence); });
    auto* form = new ParamForm(*source, {}, this);
    form->setObjectName("counts_form");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 6, 0, 8);
    layout->addWidget(form);
    auto* buttons = new QVBoxLayout;
    buttons->setContentsMargins(10, 0, 10, 0);
    for (const char* id : {"groom.place_guides", "groom.add_guides", "groom.clear_guides", "groom.new_seed"}) {
        QAction& action = context.actions.get(id);
        auto* button = new QPushButton(Actions::plainText(context.actions.info(id)), this);
        button->setObjectName(QString(id).replace('.', '_'));
        button->setToolTip(action.toolTip());
        button->setAccessibleDescription(action.statusTip());
        connect(button, &QPushButton::clicked, &action, &QAction::trigger);
        buttons->addWidget(button);
    }
    layout->addLayout(buttons);
    layout->addStretch();
    const auto follow = [this, &document = context.document] { setEnabled(document.hasGroom()); };
    connect(&context.document, &Document::changed, this, follow);
    follow();
}

ViewPanel::ViewPanel(PanelContext context, QWidget* parent) : QWidget(parent) {
    setObjectName("view_panel");
    auto* source = new StateSource<ViewOptions>(context.state, context.document, &EditorState::viewOptions,
                                                &EditorState::setViewOptions, this);
    auto* form = new ParamForm(*source);
    form->setObjectName("view_form");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 6, 0, 0);
    auto* content = new QWidget;
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(form);
    column->addStretch();
    layout->addWidget(scrolled(content));
}

HistoryPanel::HistoryPanel(PanelContext context, QWidget* parent) : QWidget(parent) {
    setObjectName("history_panel");
    auto* view = new QUndoView(&context.document.history(), this);
    view->setObjectName("history_list");
    view->setAccessibleName(tr("History"));
    view->setEmptyLabel(tr("As opened"));
    view->setToolTip(tr("Click a step to go back or forth to it"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->addWidget(view);
}

PartsPanel::PartsPanel(PanelContext context, QWidget* parent)
    : QWidget(parent), m_context(context), m_tree(new QTreeWidget(this)) {
    setObjectName("parts_panel");
    m_tree->setObjectName("parts_list");
    m_tree->setAccessibleName(tr("Parts of the model"));
    m_tree->setHeaderLabels({tr("Part"), tr("Hair"), tr("Shown")});
    m_tree->setRootIsDecorated(false);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_tree->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
    m_tree->setToolTip(tr("Tick where hair may grow and what is shown"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->addWidget(m_tree);
    connect(m_tree, &QTreeWidget::itemChanged, this, &PartsPanel::toggled);
    connect(&context.document, &Document::changed, this, &PartsPanel::refresh);
    refresh();
}

void PartsPanel::refresh() {
    const Groom& groom = m_context.document.groom();
    setEnabled(m_context.document.hasGroom());
    const bool sameMesh = groom.mesh.sameAs(m_seenMesh);
    if (sameMesh && groom.partSettings.sameAs(m_seen)) return;
    m_seenMesh = groom.mesh;
    m_seen = groom.partSettings;
    m_filling = true;
    if (!sameMesh) m_tree->clear();
    for (std::size_t i = 0; i < groom.mesh->parts.size() && i < groom.partSettings->size(); ++i) {
        const MeshPart& part = groom.mesh->parts[i];
        const PartSettings& settings = (*groom.partSettings)[i];
        QTreeWidgetItem* item = m_tree->topLevelItem(static_cast<int>(i));
        if (!item) item = new QTreeWidgetItem(m_tree);
        item->setText(0, part.name.empty() ? tr("Part %1").arg(i + 1) : QString::fromStdString(part.name));
        item->setToolTip(0, tr("%1 triangles").arg(QLocale().toString(part.triangleCount)));
        item->setCheckState(1, settings.growsHair ? Qt::Checked : Qt::Unchecked);
        item->setCheckState(2, settings.visible ? Qt::Checked : Qt::Unchecked);
    }
    m_filling = false;
}

void PartsPanel::toggled(QTreeWidgetItem* item, int column) {
    if (m_filling || column == 0) return;
    Groom after = m_context.document.committed();
    const auto index = static_cast<std::size_t>(m_tree->indexOfTopLevelItem(item));
    if (index >= after.partSettings->size()) return;
    PartSettings& settings = after.partSettings.edit()[index];
    const bool on = item->checkState(column) == Qt::Checked;
    (column == 1 ? settings.growsHair : settings.visible) = on;
    m_context.document.edit(std::move(after), (column == 1 ? on ? tr("Grow hair on %1") : tr("No hair on %1")
                                               : on ? tr("Show %1")
                                                           : tr("Hide %1"))
                                                  .arg(item->text(0)));
}

}  // namespace whorl
