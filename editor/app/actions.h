// SPDX-License-Identifier: Apache-2.0
// All actions of the program from one table: menus, toolbar, shortcut editor, palette and help read it.
#pragma once

#include <QAction>
#include <QHash>
#include <QObject>
#include <QString>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

class QSettings;
class QWidget;

namespace whorl {

/// One row of the table.
struct ActionInfo {
    enum Kind : std::uint8_t {
        Push,     ///< does something
        Check,    ///< on or off
        Held,     ///< a key or button that is held or dragged in the viewport: listed in help, not an action
        ToolPick  ///< picks a tool: one of a group
    };

    QString id;        ///< "file.open", for ever: shortcuts are kept under it
    QString text;      ///< in menus, with mnemonic
    QString shortcut;  ///< the default, portable text; several separated by "; "
    QString tip;       ///< one sentence
    QString category;  ///< "File": the menu
    Kind kind = Push;
    bool separatorAfter = false;
    QString icon{};             ///< name in icons.h
    bool viewportOnly = false;  ///< its key belongs to other widgets elsewhere (Tab)
};

/// The table: the program's own rows and one for each brush. In the order of menus.
std::vector<ActionInfo> actionTable();
/// The menus in their order.
QStringList actionCategories();

/// Makes a QAction for each row. What they do is connected by those who can do it.
class Actions : public QObject {
    Q_OBJECT

public:
    explicit Actions(QWidget& window);

    const std::vector<ActionInfo>& table() const { return m_table; }
    /// The action of an id that is in the table.
    QAction& get(const QString& id) const;
    /// Calls `what` when the action is triggered.
    void on(const QString& id, QObject* context, const std::function<void()>& what);
    /// Calls `what` with the new state when the artist toggles it.
    void onToggle(const QString& id, QObject* context, const std::function<void(bool)>& what);
    const ActionInfo& info(const QString& id) const;
    /// "File > Open" without mnemonics, and its shortcut, as people read it.
    static QString plainText(const ActionInfo& info);
    QString shownShortcut(const ActionInfo& info) const;

    /// The row that uses this key already, or null.
    const ActionInfo* owner(const QKeySequence& key) const;
    void setShortcut(const QString& id, const QKeySequence& key);
    void resetShortcuts();
    /// Shortcuts of actions with viewportOnly work while `viewport` has the focus.
    void attachViewport(QWidget& viewport);

Q_SIGNALS:
    void shortcutsChanged();

private:
    void apply(const ActionInfo& info, const QList<QKeySequence>& keys);

    std::vector<ActionInfo> m_table;
    QHash<QString, QAction*> m_actions;
};

}  // namespace whorl
