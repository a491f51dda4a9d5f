// SPDX-License-Identifier: Apache-2.0
// A bar over the viewport that says in a sentence what happened, without stopping anyone.
#pragma once

#include <QFrame>
#include <QStringList>

class QLabel;
class QPushButton;
class QTimer;
class QToolButton;

namespace whorl {

class MessageBar : public QFrame {
    Q_OBJECT

public:
    enum class Kind { Info, Warning, Error };

    explicit MessageBar(QWidget* parent = nullptr);

    /// `details`: sentences for the Details button. Infos go away by themselves; warnings and errors stay.
    void say(Kind kind, const QString& sentence, const QStringList& details = {});
    QString sentence() const;
    const QStringList& details() const { return m_details; }

private:
    void showDetails();

    QLabel* m_text;
    QPushButton* m_more;
    QToolButton* m_close;
    QTimer* m_timer;
    QStringList m_details;
};

}  // namespace whorl
