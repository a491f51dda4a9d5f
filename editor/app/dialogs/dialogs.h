// SPDX-License-Identifier: Apache-2.0
// The dialogs of the program.
#pragma once

#include "core/io/journal.h"
#include "editor/app/theme.h"

#include <QDialog>
#include <vector>

class QKeySequenceEdit;
class QLabel;
class QLineEdit;
class QListWidget;
class QTableWidget;

namespace whorl {

class Actions;
class Document;
class EditorState;
class Files;

/// Type a few letters of an action's name, press Enter.
class CommandPalette : public QDialog {
    Q_OBJECT

public:
    CommandPalette(Actions& actions, QWidget* parent);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void filter(const QString& text);
    void run();
    Actions& m_actions;
    QLineEdit* m_input;
    QListWidget* m_list;
};

/// All actions and their keys; a key is changed by pressing it.
class ShortcutDialog : public QDialog {
    Q_OBJECT

public:
    ShortcutDialog(Actions& actions, QWidget* parent);

private:
    void fill();
    void assign();
    Actions& m_actions;
    QTableWidget* m_table;
    QKeySequenceEdit* m_keys;
    QLabel* m_note;
};

/// Navigation, theme, undo memory. Kept in the settings and applied at once.
class PreferencesDialog : public QDialog {
    Q_OBJECT

public:
    PreferencesDialog(Document& document, EditorState& state, QWidget* parent);
};
/// What the settings say of theme and undo memory.
Theme themeInSettings();
std::size_t undoBytesInSettings();

/// One page with every tool, key and action, made from the table.
class HelpDialog : public QDialog {
    Q_OBJECT

public:
    HelpDialog(const Actions& actions, QWidget* parent);
};
/// The page, as HTML.
QString helpPage(const Actions& actions);

/// Work that a crash left: restore, remove or decide later.
class RecoveryDialog : public QDialog {
    Q_OBJECT

public:
    RecoveryDialog(std::vector<Recovery> found, Files& files, QWidget* parent);

private:
    void fill();
    std::vector<Recovery> m_found;
    Files& m_files;
    QListWidget* m_list;
};

void showAbout(QWidget* parent);

}  // namespace whorl
