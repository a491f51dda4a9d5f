// SPDX-License-Identifier: Apache-2.0
#include "core/commands/group_edits.h"
#include "editor/app/icons.h"
#include "editor/app/panels/groom_source.h"
#include "editor/app/panels/group_swatch.h"
#include "editor/app/panels/modifier_panel.h"
#include "editor/app/panels/panels.h"
#include "editor/app/widgets/message_bar.h"
#include "editor/app/widgets/param_form.h"

#include <QHBoxLayout>
#include <QListWidget>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

namespace whorl {

QWidget* scrolled(QWidget* content) {
    auto* area = new QScrollArea;
    area->setWidget(content);
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    return area;
}

HairPanel::HairPanel(PanelContext context, QWidget* parent)
    : QWidget(parent), m_context(context), m_list(new QListWidget(this)), m_remove(new QToolButton(this)) {
    setObjectName("hair_panel");
    m_list->setObjectName("group_list");
    m_list->setAccessibleName(tr("Groups"));
    m_list->setToolTip(tr("Groups of hair; double click to rename. The forms below belong to the chosen one."));
    m_list->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    m_list->setMaximumHeight(84);
    auto* addButton = new QToolButton(this);
    addButton->setObjectName("group_add");
    addButton->setAccessibleName(tr("Add a group"));
    addButton->setToolTip(tr("Adds a group that starts like the chosen one"));
    addButton->setIcon(icon("plus"));
    m_remove->setObjectName("group_remove");
    m_remove->setAccessibleName(tr("Remove the group"));
    m_remove->setToolTip(tr("Removes the chosen group; its guides go to its neighbour"));
    m_remove->setIcon(icon("minus"));
    auto* buttons = new QVBoxLayout;
    buttons->addWidget(addButton);
    buttons->addWidget(m_remove);
    buttons->addStretch();
    auto* groups = new QHBoxLayout;
    groups->setContentsMargins(8, 8, 8, 4);
    groups->addWidget(m_list, 1);
    groups->addLayout(buttons);

    auto* sections = new QWidget;
    auto* stack = new QVBoxLayout(sections);
    stack->setContentsMargins(0, 0, 0, 0);
    stack->setSpacing(2);
    HairParams params;
    HairParams::each(params, [&](const BlockInfo& info, auto&) {
        auto* source = new GroomSource(m_context.document, m_context.state, std::string(info.id), this);
        connect(source, &GroomSource::said, this,
                [this](const QString& sentence) { m_context.messages.say(MessageBar::Kind::Warning, sentence); });
        auto* form = new ParamForm(*source);
        form->setObjectName(qtext(info.id) + "_form");
        auto* section = new Section(qtext(info.label), form);
        section->setObjectName(qtext(info.id) + "_section");
        section->setToolTip(qtext(info.tip));
        stack->addWidget(section);
    });
    auto* modifiers = new Section(tr("Modifiers"), new ModifierPanel(m_context));
    modifiers->setObjectName("modifiers_section");
    modifiers->setToolTip(tr("Clumps, curls, noise: a list that works on the hair from top to bottom"));
    stack->addWidget(modifiers);
    stack->addStretch();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addLayout(groups);
    layout->addWidget(scrolled(sections), 1);

    connect(addButton, &QToolButton::clicked, this, &HairPanel::add);
    connect(m_remove, &QToolButton::clicked, this, &HairPanel::remove);
    connect(m_list, &QListWidget::currentRowChanged, this, [this](int row) {
        if (!m_filling && row >= 0) m_context.state.setGroup(row);
    });
    connect(m_list, &QListWidget::itemChanged, this, &HairPanel::rename);
    connect(&context.document, &Document::changed, this, &HairPanel::refresh);
    connect(&context.state, &EditorState::changed, this, [this] {
        m_filling = true;
        m_list->setCurrentRow(m_context.state.group());
        m_filling = false;
    });
    refresh();
}

void HairPanel::refresh() {
    const Groom& groom = m_context.document.groom();
    setEnabled(m_context.document.hasGroom());
    if (groom.groups.sameAs(m_seen) && m_list->count() > 0) return;
    m_seen = groom.groups;
    m_filling = true;
    QStringList names;
    for (const Group& group : *groom.groups) names.push_back(QString::fromStdString(group.name));
    QStringList old;
    for (int i = 0; i < m_list->count(); ++i) old.push_back(m_list->item(i)->text());
    if (names != old) {
        m_list->clear();
        for (const QString& name : names) {
            auto* item = new QListWidgetItem(name, m_list);
            item->setFlags(item->flags() | Qt::ItemIsEditable);
            item->setIcon(groupSwatch(m_list->count() - 1));
        }
    }
    m_remove->setEnabled(names.size() > 1);
    const int last = static_cast<int>(names.size()) - 1;
    if (m_context.state.group() > last) m_context.state.setGroup(last);
    m_list->setCurrentRow(m_context.state.group());
    m_filling = false;
}

void HairPanel::add() {
    Groom after = m_context.document.committed();
    const std::string name = freeGroupName(after, "group");
    const Result<int> added = addGroup(after, name, m_context.state.group());
    if (!added) {
        m_context.messages.say(MessageBar::Kind::Warning, QString::fromStdString(added.error().message));
        return;
    }
    m_context.document.edit(std::move(after), tr("Add group %1").arg(QString::fromStdString(name)));
    m_context.state.setGroup(*added);
}

void HairPanel::remove() {
    const int group = m_list->currentRow();
    Groom after = m_context.document.committed();
    const Result<void> removed = removeGroup(after, group);
    if (!removed) {
        m_context.messages.say(MessageBar::Kind::Warning, QString::fromStdString(removed.error().message));
        return;
    }
    m_context.state.setGroup(std::max(group - 1, 0));
    m_context.document.edit(std::move(after), tr("Remove group"));
}

void HairPanel::rename(QListWidgetItem* item) {
    if (m_filling) return;
    Groom after = m_context.document.committed();
    const Result<void> renamed = renameGroup(after, m_list->row(item), item->text().trimmed().toStdString());
    if (renamed) {
        m_context.document.edit(std::move(after), tr("Rename group"));
    } else {
        m_context.messages.say(MessageBar::Kind::Warning, QString::fromStdString(renamed.error().message));
    }
    m_seen = {};
    refresh();
}

}  // namespace whorl
