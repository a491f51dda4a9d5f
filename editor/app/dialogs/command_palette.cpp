// SPDX-License-Identifier: Apache-2.0
#include "editor/app/actions.h"
#include "editor/app/dialogs/dialogs.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace whorl {
namespace {

/// Higher is better; below zero: `words` do not all occur.
int scoreOf(const QString& name, const QStringList& words) {
    int score = 0;
    for (const QString& word : words) {
        const qsizetype place = name.indexOf(word, 0, Qt::CaseInsensitive);
        if (place < 0) return -1;
        const bool atWord = place == 0 || !name[place - 1].isLetterOrNumber();
        score += atWord ? 10 : 1;
    }
    return score;
}

}  // namespace

CommandPalette::CommandPalette(Actions& actions, QWidget* parent)
    : QDialog(parent), m_actions(actions), m_input(new QLineEdit(this)), m_list(new QListWidget(this)) {
    setObjectName("command_palette");
    setWindowTitle(tr("Find an action"));
    m_input->setObjectName("palette_input");
    m_input->setAccessibleName(tr("Name of the action"));
    m_input->setPlaceholderText(tr("Type what you want to do"));
    m_input->setClearButtonEnabled(true);
    m_input->installEventFilter(this);
    m_list->setObjectName("palette_list");
    m_list->setAccessibleName(tr("Actions"));
    m_list->setFocusPolicy(Qt::NoFocus);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(m_input);
    layout->addWidget(m_list);
    resize(560, 380);
    connect(m_input, &QLineEdit::textChanged, this, &CommandPalette::filter);
    connect(m_input, &QLineEdit::returnPressed, this, &CommandPalette::run);
    connect(m_list, &QListWidget::itemActivated, this, &CommandPalette::run);
    connect(m_list, &QListWidget::itemClicked, this, &CommandPalette::run);
    filter({});
}

void CommandPalette::filter(const QString& text) {
    const QStringList words = text.split(' ', Qt::SkipEmptyParts);
    std::vector<std::pair<int, const ActionInfo*>> found;
    for (const ActionInfo& row : m_actions.table()) {
        if (row.kind == ActionInfo::Held || row.id == "edit.palette") continue;
        const int score = scoreOf(Actions::plainText(row) + ' ' + row.category + ' ' + row.tip, words);
        const int named = scoreOf(Actions::plainText(row), words);
        if (score >= 0) found.emplace_back(score + 100 * std::max(named, 0), &row);
    }
    if (!words.isEmpty()) {
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    }
    m_list->clear();
    for (const auto& [score, row] : found) {
        const QString keys = m_actions.shownShortcut(*row);
        QString line = QString("%1:  %2").arg(row->category, Actions::plainText(*row));
        if (!keys.isEmpty()) line += QString("    [%1]").arg(keys);
        auto* item = new QListWidgetItem(m_actions.get(row->id).icon(), line, m_list);
        item->setData(Qt::UserRole, row->id);
        item->setToolTip(row->tip);
        if (!m_actions.get(row->id).isEnabled()) item->setFlags(Qt::NoItemFlags);
    }
    for (int i = 0; i < m_list->count(); ++i) {
        if (!(m_list->item(i)->flags() & Qt::ItemIsEnabled)) continue;
        m_list->setCurrentRow(i);
        break;
    }
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Down || key == Qt::Key_Up || key == Qt::Key_PageDown || key == Qt::Key_PageUp) {
            const int step = key == Qt::Key_Down ? 1 : key == Qt::Key_Up ? -1 : key == Qt::Key_PageDown ? 8 : -8;
            m_list->setCurrentRow(std::clamp(m_list->currentRow() + step, 0, std::max(m_list->count() - 1, 0)));
            return true;
        }
    }
    return QDialog::eventFilter(watched, event);
}

void CommandPalette::run() {
    const QListWidgetItem* item = m_list->currentItem();
    if (!item || !(item->flags() & Qt::ItemIsEnabled)) return;
    QAction& action = m_actions.get(item->data(Qt::UserRole).toString());
    // Closed first: the action may open a dialog of its own.
    accept();
    action.trigger();
}

}  // namespace whorl
