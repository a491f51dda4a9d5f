// SPDX-License-Identifier: Apache-2.0
#include "editor/app/actions.h"
#include "editor/app/dialogs/dialogs.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace whorl {

ShortcutDialog::ShortcutDialog(Actions& actions, QWidget* parent)
    : QDialog(parent),
      m_actions(actions),
      m_table(new QTableWidget(this)),
      m_keys(new QKeySequenceEdit(this)),
      m_note(new QLabel(this)) {
    setObjectName("shortcut_dialog");
    setWindowTitle(tr("Keyboard shortcuts"));
    m_table->setObjectName("shortcut_table");
    m_table->setAccessibleName(tr("Actions and their keys"));
    m_table->setColumnCount(3);
    m_table->setHorizontalHeaderLabels({tr("Menu"), tr("Action"), tr("Keys")});
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setShowGrid(false);
    m_table->verticalHeader()->hide();
    m_table->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
    m_table->setColumnWidth(2, 150);
    m_keys->setObjectName("shortcut_keys");
    m_keys->setAccessibleName(tr("New keys"));
    m_note->setObjectName("shortcut_note");
    m_note->setWordWrap(true);
    auto* assignButton = new QPushButton(tr("Assign"), this);
    assignButton->setObjectName("shortcut_assign");
    auto* row = new QHBoxLayout;
    row->addWidget(new QLabel(tr("New keys:"), this));
    row->addWidget(m_keys, 1);
    row->addWidget(assignButton);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close | QDialogButtonBox::RestoreDefaults, this);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(m_table);
    layout->addLayout(row);
    layout->addWidget(m_note);
    layout->addWidget(buttons);
    resize(620, 560);
    connect(assignButton, &QPushButton::clicked, this, &ShortcutDialog::assign);
    connect(m_keys, &QKeySequenceEdit::keySequenceChanged, this, [this](const QKeySequence& keys) {
        const ActionInfo* owner = m_actions.owner(keys);
        m_note->setText(
            owner
                ? tr("These keys belong to \"%1\"; assigning takes them away from it.").arg(Actions::plainText(*owner))
                : QString());
    });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this,
            [this] { m_actions.resetShortcuts(); });
    connect(&m_actions, &Actions::shortcutsChanged, this, &ShortcutDialog::fill);
    fill();
    m_table->selectRow(0);
}

void ShortcutDialog::fill() {
    const int chosen = m_table->currentRow();
    m_table->setRowCount(0);
    for (const ActionInfo& info : m_actions.table()) {
        if (info.kind == ActionInfo::Held) continue;
        const int row = m_table->rowCount();
        m_table->insertRow(row);
        m_table->setItem(row, 0, new QTableWidgetItem(info.category));
        auto* name = new QTableWidgetItem(Actions::plainText(info));
        name->setData(Qt::UserRole, info.id);
        name->setToolTip(info.tip);
        m_table->setItem(row, 1, name);
        m_table->setItem(row, 2, new QTableWidgetItem(m_actions.shownShortcut(info)));
    }
    m_table->selectRow(std::max(chosen, 0));
}

void ShortcutDialog::assign() {
    const QTableWidgetItem* item = m_table->item(m_table->currentRow(), 1);
    if (!item) return;
    m_actions.setShortcut(item->data(Qt::UserRole).toString(), m_keys->keySequence());
    m_keys->clear();
}

}  // namespace whorl
