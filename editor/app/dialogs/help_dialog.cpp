// SPDX-License-Identifier: Apache-2.0
#include "editor/app/actions.h"
#include "editor/app/dialogs/dialogs.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QMessageBox>
#include <QTextBrowser>
#include <QVBoxLayout>

namespace whorl {

QString helpPage(const Actions& actions) {
    QString page = "<h1>" + QObject::tr("Keys and tools") + "</h1>";
    QString category;
    for (const ActionInfo& row : actions.table()) {
        if (row.category != category) {
            if (!category.isEmpty()) page += "</table>";
            category = row.category;
            page += "<h2>" + category.toHtmlEscaped() + "</h2><table width='100%' cellpadding='3'>";
        }
        page += QString("<tr><td width='24%'><b>%1</b></td><td width='24%'>%2</td><td>%3</td></tr>")
                    .arg(Actions::plainText(row).toHtmlEscaped(), actions.shownShortcut(row).toHtmlEscaped(),
                         row.tip.toHtmlEscaped());
    }
    return page + "</table>";
}

HelpDialog::HelpDialog(const Actions& actions, QWidget* parent) : QDialog(parent) {
    setObjectName("help_dialog");
    setWindowTitle(tr("Keys and tools"));
    auto* text = new QTextBrowser(this);
    text->setObjectName("help_text");
    text->setAccessibleName(tr("Keys and tools"));
    text->setHtml(helpPage(actions));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(text);
    layout->addWidget(buttons);
    resize(820, 700);
}

void showAbout(QWidget* parent) {
    QMessageBox::about(parent, QObject::tr("About Whorl"),
                       QObject::tr("<h2>Whorl %1</h2><p>Interactive hair grooming.</p><p>Apache License 2.0.</p>")
                           .arg(QApplication::applicationVersion()));
}

}  // namespace whorl
