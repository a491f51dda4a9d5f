// SPDX-License-Identifier: Apache-2.0
// What the actions of the menus Edit, Groom, Tools and View do.
#pragma once

#include <QObject>

class QWidget;

namespace whorl {

class Actions;
class Document;
class EditorState;
class MessageBar;
class Viewport;

/// Undo and redo, and edits of the whole groom.
class GroomActions : public QObject {
    Q_OBJECT

public:
    GroomActions(Document& document, EditorState& state, Actions& actions, MessageBar& messages, QWidget& window);

    /// Spreads `count` guides; `keep`: beside those that are there.
    bool placeGuides(int count, bool keep);
    void placeGuidesOnVertices();
    /// Gives every guide the group that the group map has at its root.
    void regroupGuides();
    void clearGuides();
    void clearPartings();
    /// Guides of the active group along the groom's field; placed first when there are none.
    void growAlong();
    void strokesFromGuides();
    void removeStroke();
    void clearStrokes();
    /// Picks the paint brush with the density map of the active group; makes the map when there is none.
    void paintDensity();
    void newSeed();

private:
    void refresh();
    Document& m_document;
    EditorState& m_state;
    Actions& m_actions;
    MessageBar& m_messages;
    QWidget& m_window;
};

/// Tools, brush size, what the view shows, where it looks from.
class ViewActions : public QObject {
    Q_OBJECT

public:
    /// `viewport` may be null.
    ViewActions(EditorState& state, Actions& actions, Viewport* viewport, QWidget& window);

private:
    void refresh();
    EditorState& m_state;
    Actions& m_actions;
};

}  // namespace whorl
