// SPDX-License-Identifier: Apache-2.0
#include "editor/app/actions.h"
#include "editor/app/dialogs/dialogs.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QStyledItemDelegate>
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

constexpr int idRole = Qt::UserRole;
constexpr int keysRole = Qt::UserRole + 1;

/// Rows of one height, with the keys at the right.
class RowDelegate : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        QSize size = QStyledItemDelegate::sizeHint(option, index);
        size.setHeight(std::max(option.fontMetrics.height() + 8, 26));
        return size;
    }

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        QStyledItemDelegate::paint(painter, option, index);
        const bool chosen = option.state.testFlag(QStyle::State_Selected);
        const bool enabled = index.flags().testFlag(Qt::ItemIsEnabled);
        painter->setPen(option.palette.color(enabled ? QPalette::Active : QPalette::Disabled,
                                             chosen ? QPalette::HighlightedText : QPalette::Text));
        painter->drawText(option.rect.adjusted(0, 0, -8, 0), Qt::AlignRight | Qt::AlignVCenter,
                          index.data(keysRole).toString());
    }
};

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
    m_list->setItemDelegate(new RowDelegate(m_list));
    m_list->setIconSize({18, 18});
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
    QPixmap none(m_list->iconSize());
    none.fill(Qt::transparent);
    for (const auto& [score, row] : found) {
        const QIcon icon = m_actions.get(row->id).icon();
        const QString line = QString("%1:  %2").arg(row->category, Actions::plainText(*row));
        auto* item = new QListWidgetItem(icon.isNull() ? QIcon(none) : icon, line, m_list);
        item->setData(idRole, row->id);
        item->setData(keysRole, m_actions.shownShortcut(*row));
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
    QAction& action = m_actions.get(item->data(idRole).toString());
    // Closed first: the action may open a dialog of its own.
    accept();
    action.trigger();
}

}  // namespace whorl
