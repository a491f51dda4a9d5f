// SPDX-License-Identifier: Apache-2.0
#include "editor/app/actions.h"

#include "editor/app/icons.h"

#include <QActionGroup>
#include <QSettings>
#include <QWidget>
#include <algorithm>

namespace whorl {
namespace {

QList<QKeySequence> keysOf(const QString& text) {
    QList<QKeySequence> keys;
    for (const QString& part : text.split("; ", Qt::SkipEmptyParts)) {
        keys.push_back(QKeySequence::fromString(part, QKeySequence::PortableText));
    }
    return keys;
}

QString textOfKeys(const QList<QKeySequence>& keys) {
    QStringList parts;
    for (const QKeySequence& key : keys) parts.push_back(key.toString(QKeySequence::PortableText));
    return parts.join("; ");
}

}  // namespace

Actions::Actions(QWidget& window) : QObject(&window), m_table(actionTable()) {
    const QSettings settings;
    auto* tools = new QActionGroup(this);
    for (const ActionInfo& row : m_table) {
        if (row.kind == ActionInfo::Held) continue;
        auto* action = new QAction(row.text, this);
        action->setObjectName(row.id);
        action->setCheckable(row.kind != ActionInfo::Push);
        if (row.kind == ActionInfo::ToolPick) tools->addAction(action);
        if (!row.icon.isEmpty()) action->setIcon(icon(row.icon));
        m_actions.insert(row.id, action);
        apply(row, keysOf(settings.value("shortcuts/" + row.id, row.shortcut).toString()));
        if (!row.viewportOnly) window.addAction(action);
    }
}

void Actions::apply(const ActionInfo& row, const QList<QKeySequence>& keys) {
    QAction& action = get(row.id);
    action.setShortcuts(keys);
    const QString shown = shownShortcut(row);
    action.setToolTip(shown.isEmpty() ? QString("<b>%1</b><br>%2").arg(plainText(row), row.tip)
                                      : QString("<b>%1</b> (%2)<br>%3").arg(plainText(row), shown, row.tip));
    action.setStatusTip(row.tip);
    action.setWhatsThis(action.toolTip());
}

QAction& Actions::get(const QString& id) const {
    QAction* action = m_actions.value(id);
    Q_ASSERT_X(action, "Actions::get", qPrintable(id));
    return *action;
}

void Actions::on(const QString& id, QObject* context, const std::function<void()>& what) {
    connect(&get(id), &QAction::triggered, context, [what] { what(); });
}

void Actions::onToggle(const QString& id, QObject* context, const std::function<void(bool)>& what) {
    connect(&get(id), &QAction::triggered, context, what);
}

const ActionInfo& Actions::info(const QString& id) const {
    const auto row = std::find_if(m_table.begin(), m_table.end(), [&](const ActionInfo& r) { return r.id == id; });
    Q_ASSERT(row != m_table.end());
    return *row;
}

QString Actions::plainText(const ActionInfo& info) {
    QString text = info.text;
    text.remove('&');
    if (text.endsWith(u'…')) text.chop(1);
    return text;
}

QString Actions::shownShortcut(const ActionInfo& info) const {
    if (info.kind == ActionInfo::Held) return info.shortcut;
    QStringList parts;
    for (const QKeySequence& key : get(info.id).shortcuts()) parts.push_back(key.toString(QKeySequence::NativeText));
    return parts.join(", ");
}

const ActionInfo* Actions::owner(const QKeySequence& key) const {
    if (key.isEmpty()) return nullptr;
    for (const ActionInfo& row : m_table) {
        if (row.kind != ActionInfo::Held && get(row.id).shortcuts().contains(key)) return &row;
    }
    return nullptr;
}

void Actions::setShortcut(const QString& id, const QKeySequence& key) {
    QSettings settings;
    if (const ActionInfo* other = owner(key); other && other->id != id) {
        QList<QKeySequence> keys = get(other->id).shortcuts();
        keys.removeAll(key);
        settings.setValue("shortcuts/" + other->id, textOfKeys(keys));
        apply(*other, keys);
    }
    const QList<QKeySequence> keys = key.isEmpty() ? QList<QKeySequence>{} : QList<QKeySequence>{key};
    settings.setValue("shortcuts/" + id, textOfKeys(keys));
    apply(info(id), keys);
    Q_EMIT shortcutsChanged();
}

void Actions::resetShortcuts() {
    QSettings settings;
    settings.remove("shortcuts");
    for (const ActionInfo& row : m_table) {
        if (row.kind != ActionInfo::Held) apply(row, keysOf(row.shortcut));
    }
    Q_EMIT shortcutsChanged();
}

void Actions::attachViewport(QWidget& viewport) {
    for (const ActionInfo& row : m_table) {
        if (!row.viewportOnly || row.kind == ActionInfo::Held) continue;
        get(row.id).setShortcutContext(Qt::WidgetWithChildrenShortcut);
        viewport.addAction(&get(row.id));
    }
}

}  // namespace whorl
