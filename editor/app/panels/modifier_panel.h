// SPDX-License-Identifier: Apache-2.0
// The list of modifiers of the active group: add, order, switch, set, remove, presets. Each is one step of the history.
#pragma once

#include "editor/app/panels/panels.h"

#include <QStringList>

class QMenu;
class QVBoxLayout;

namespace whorl {

class ModifierPanel : public QWidget {
    Q_OBJECT

public:
    explicit ModifierPanel(PanelContext context, QWidget* parent = nullptr);

private:
    void refresh();
    void rebuild();
    QWidget* makeRow(const Modifier& modifier, int place, int count);
    void add(const BlockInfo& kind);
    void move(const QString& name, int to);
    void remove(const QString& name);
    void switchOn(const QString& name, bool on);
    void apply(const QString& preset);
    /// Says why not, or makes `after` a step of the history.
    void finish(const Result<void>& done, Groom after, const QString& text);
    int group() const;

    PanelContext m_context;
    QVBoxLayout* m_rows;
    QWidget* m_empty;
    Cow<std::vector<Group>> m_seen;
    int m_seenGroup = -1;
    QStringList m_shown;  // name and kind of each row
    QStringList m_open;   // names that are folded out
};

}  // namespace whorl
