// SPDX-License-Identifier: Apache-2.0
#include "editor/app/widgets/message_bar.h"

#include "editor/app/icons.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

namespace whorl {

MessageBar::MessageBar(QWidget* parent)
    : QFrame(parent),
      m_text(new QLabel(this)),
      m_more(new QPushButton(tr("Details…"), this)),
      m_close(new QToolButton(this)),
      m_timer(new QTimer(this)) {
    setObjectName("message_bar");
    setAccessibleName(tr("Messages"));
    m_text->setObjectName("message_text");
    m_text->setWordWrap(true);
    m_text->setTextFormat(Qt::PlainText);
    m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_more->setObjectName("message_details");
    m_close->setObjectName("message_close");
    m_close->setAccessibleName(tr("Close the message"));
    m_close->setIcon(icon("close"));
    m_close->setAutoRaise(true);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(12, 6, 6, 6);
    layout->addWidget(m_text, 1);
    layout->addWidget(m_more);
    layout->addWidget(m_close);
    m_timer->setSingleShot(true);
    m_timer->setInterval(7000);
    connect(m_timer, &QTimer::timeout, this, &QWidget::hide);
    connect(m_close, &QToolButton::clicked, this, &QWidget::hide);
    connect(m_more, &QPushButton::clicked, this, &MessageBar::showDetails);
    hide();
}

void MessageBar::say(Kind kind, const QString& sentence, const QStringList& details) {
    const char* colour = kind == Kind::Error ? "#b5493f" : kind == Kind::Warning ? "#c28a35" : "#5b8f76";
    // The stripe carries the colour; the words carry the meaning.
    setStyleSheet(
        QString("#message_bar { border: none; border-left: 5px solid %1; background: palette(button); }").arg(colour));
    m_text->setText(sentence);
    m_details = details;
    m_more->setVisible(!details.isEmpty());
    setAccessibleDescription(sentence);
    show();
    kind == Kind::Info ? m_timer->start() : m_timer->stop();
}

QString MessageBar::sentence() const {
    return m_text->text();
}

void MessageBar::showDetails() {
    auto* dialog = new QDialog(window());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setObjectName("details_dialog");
    dialog->setWindowTitle(tr("Details"));
    auto* list = new QListWidget(dialog);
    list->setObjectName("details_list");
    list->setAccessibleName(tr("What was found"));
    list->setWordWrap(true);
    list->addItems(m_details);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::close);
    auto* layout = new QVBoxLayout(dialog);
    layout->addWidget(new QLabel(m_text->text(), dialog));
    layout->addWidget(list);
    layout->addWidget(buttons);
    dialog->resize(560, 320);
    dialog->show();
}

}  // namespace whorl
