// SPDX-License-Identifier: Apache-2.0
// The panels of the window. Each shows one part of the groom and refreshes when that part differs.
#pragma once

#include "core/model/groom.h"

#include <QWidget>

class QLabel;
class QListWidget;
class QListWidgetItem;
class QPushButton;
class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace whorl {

class Actions;
class Document;
class EditorState;
class MessageBar;
class ParamForm;

/// What panels share: the document, the state, the actions, and where sentences go.
struct PanelContext {
    Document& document;
    EditorState& state;
    Actions& actions;
    MessageBar& messages;
};

/// Settings of the picked brush.
class ToolPanel : public QWidget {
    Q_OBJECT

public:
    explicit ToolPanel(PanelContext context, QWidget* parent = nullptr);

private:
    void refresh();
    PanelContext m_context;
    ParamForm* m_form;
    QLabel* m_title;
    QLabel* m_tip;
    QPushButton* m_makeMap;
};

/// Groups, and all parameters of the active one.
class HairPanel : public QWidget {
    Q_OBJECT

public:
    explicit HairPanel(PanelContext context, QWidget* parent = nullptr);

private:
    void refresh();
    void add();
    void remove();
    void rename(QListWidgetItem* item);
    PanelContext m_context;
    QListWidget* m_list;
    QToolButton* m_remove;
    Cow<std::vector<Group>> m_seen;
    bool m_filling = false;
};

/// Counts of the whole groom, and placing guides.
class GroomPanel : public QWidget {
    Q_OBJECT

public:
    explicit GroomPanel(PanelContext context, QWidget* parent = nullptr);
};

/// The groom's maps.
class MapsPanel : public QWidget {
    Q_OBJECT

public:
    explicit MapsPanel(PanelContext context, QWidget* parent = nullptr);
    /// Reads an image into a new map.
    void load(const QString& file, bool colour);
    /// Writes the chosen map.
    void save(const QString& file);

private:
    void refresh();
    void add();
    void remove();
    void flip();
    void paint();
    void rename(QListWidgetItem* item);
    std::string current() const;
    PanelContext m_context;
    QListWidget* m_list;
    QWidget* m_buttons;
    MapSet m_seen;
    bool m_filling = false;
};

/// The parts of the mesh: which are seen, which grow hair.
class PartsPanel : public QWidget {
    Q_OBJECT

public:
    explicit PartsPanel(PanelContext context, QWidget* parent = nullptr);

private:
    void refresh();
    void toggled(QTreeWidgetItem* item, int column);
    PanelContext m_context;
    QTreeWidget* m_tree;
    Cow<SurfaceMesh> m_seenMesh;
    Cow<std::vector<PartSettings>> m_seen;
    bool m_filling = false;
};

/// Shading, shadow and light of the view.
class ViewPanel : public QWidget {
    Q_OBJECT

public:
    explicit ViewPanel(PanelContext context, QWidget* parent = nullptr);
};

/// All steps, and a jump to any of them.
class HistoryPanel : public QWidget {
    Q_OBJECT

public:
    explicit HistoryPanel(PanelContext context, QWidget* parent = nullptr);
};

/// A scroll area without frame around `content`.
QWidget* scrolled(QWidget* content);

}  // namespace whorl
