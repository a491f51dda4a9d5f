// SPDX-License-Identifier: Apache-2.0
// The window: places viewport, panels, bars and menus, and nothing else.
#pragma once

#include "editor/app/document.h"
#include "editor/app/editor_state.h"

#include <QMainWindow>
#include <filesystem>

class QLabel;
class QMenu;

namespace whorl {

class Actions;
class Autosave;
class Exports;
class Files;
class GroomActions;
class ViewActions;
class Viewport;
class ViewportArea;

class MainWindow : public QMainWindow {
    Q_OBJECT

public:
    /// Journals of unsaved work go to `journals`.
    explicit MainWindow(const std::filesystem::path& journals);
    ~MainWindow() override;

    Document& document() { return m_document; }
    EditorState& state() { return m_state; }
    Actions& actions() { return *m_actions; }
    Files& files() { return *m_files; }
    Exports& exports() { return *m_exports; }
    GroomActions& groomActions() { return *m_groomActions; }
    Autosave& autosave() { return *m_autosave; }
    ViewportArea& area() { return *m_area; }
    /// Null when this machine can not draw.
    Viewport* viewport();
    /// Offers work that a crash left. True when something was restored.
    bool offerRecovery();

protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void makeSamples();
    void makeMenus();
    void makeBars();
    void makePanels();
    void makeStatusBar();
    void connectActions();
    void fillRecent();
    void hidePanels(bool hide);
    void documentChanged();

    Document m_document;
    EditorState m_state;
    Actions* m_actions;
    ViewportArea* m_area;
    Files* m_files;
    Exports* m_exports;
    GroomActions* m_groomActions;
    Autosave* m_autosave;
    std::filesystem::path m_journals;
    QMenu* m_recent = nullptr;
    QMenu* m_samples = nullptr;
    QLabel* m_hint = nullptr;
    QList<QWidget*> m_hidden;
};

}  // namespace whorl
