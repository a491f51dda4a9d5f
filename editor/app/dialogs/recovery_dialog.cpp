// SPDX-License-Identifier: Apache-2.0
#include "editor/app/dialogs/dialogs.h"
#include "editor/app/document.h"
#include "editor/app/files.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QVBoxLayout>

namespace whorl {

RecoveryDialog::RecoveryDialog(std::vector<Recovery> found, Files& files, QWidget* parent)
    : QDialog(parent), m_found(std::move(found)), m_files(files), m_list(new QListWidget(this)) {
    setObjectName("recovery_dialog");
    setWindowTitle(tr("Unsaved work was found"));
    auto* text =
        new QLabel(tr("Whorl ended before this work was saved. Restored work stays safe until you save it."), this);
    text->setWordWrap(true);
    m_list->setObjectName("recovery_list");
    m_list->setAccessibleName(tr("Unsaved work"));
    auto* buttons = new QDialogButtonBox(this);
    auto* restore = buttons->addButton(tr("Restore"), QDialogButtonBox::AcceptRole);
    restore->setObjectName("recovery_restore");
    auto* later = buttons->addButton(tr("Later"), QDialogButtonBox::RejectRole);
    later->setObjectName("recovery_later");
    auto* remove = buttons->addButton(tr("Delete"), QDialogButtonBox::DestructiveRole);
    remove->setObjectName("recovery_delete");
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(text);
    layout->addWidget(m_list);
    layout->addWidget(buttons);
    resize(520, 260);
    connect(restore, &QPushButton::clicked, this, [this] {
        const int row = m_list->currentRow();
        if (row >= 0 && m_files.restore(m_found[static_cast<std::size_t>(row)])) accept();
    });
    connect(later, &QPushButton::clicked, this, &QDialog::reject);
    connect(remove, &QPushButton::clicked, this, [this] {
        const int row = m_list->currentRow();
        if (row < 0) return;
        QMessageBox sure(QMessageBox::NoIcon, tr("Delete unsaved work"), tr("Delete this work for good?"),
                         QMessageBox::Yes | QMessageBox::No, this);
        sure.setObjectName("recovery_sure");
        sure.setDefaultButton(QMessageBox::No);
        if (sure.exec() != QMessageBox::Yes) return;
        deleteRecovery(m_found[static_cast<std::size_t>(row)]);
        m_found.erase(m_found.begin() + row);
        m_found.empty() ? reject() : fill();
    });
    fill();
}

void RecoveryDialog::fill() {
    m_list->clear();
    for (const Recovery& recovery : m_found) {
        const QString name = recovery.document.empty() ? tr("Work without a name") : textOf(recovery.document);
        m_list->addItem(tr("%1, %2").arg(QString::fromStdString(recovery.when), name));
    }
    m_list->setCurrentRow(0);
}

}  // namespace whorl
