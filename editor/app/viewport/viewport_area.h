// SPDX-License-Identifier: Apache-2.0
// The middle of the window: messages, the viewport, and what is there when nothing can be drawn or is open.
#pragma once

#include <QWidget>

class QLabel;
class QStackedLayout;
class QVBoxLayout;

namespace whorl {

class Actions;
class Document;
class EditorState;
class MessageBar;
class Viewport;

class ViewportArea : public QWidget {
    Q_OBJECT

public:
    ViewportArea(Document& document, EditorState& state, Actions& actions, QWidget* parent = nullptr);

    /// Null when this machine can not draw.
    Viewport* viewport() { return m_viewport; }
    MessageBar& messages() { return *m_messages; }
    /// Why there is no viewport; empty when there is one.
    const QString& problem() const { return m_problem; }

protected:
    void resizeEvent(QResizeEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void showProblem(const QString& sentence);
    QWidget* makeWelcome(Actions& actions);
    void placeWelcome();
    void placeMessages();

    Document& m_document;
    MessageBar* m_messages;
    QWidget* m_stack;
    QStackedLayout* m_pages;
    QLabel* m_problemPage;
    QWidget* m_welcome;
    Viewport* m_viewport = nullptr;
    QString m_problem;
};

}  // namespace whorl
