// SPDX-License-Identifier: Apache-2.0
#include "editor/app/files.h"

#include "core/io/open.h"
#include "editor/app/document.h"
#include "editor/app/progress_task.h"
#include "editor/app/widgets/message_bar.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>

namespace whorl {
namespace {

QString sentenceOf(const Error& error) {
    return QString::fromStdString(error.message);
}

QString folderOf(const Document& document) {
    if (!document.file().empty()) return textOf(document.file().parent_path());
    return QSettings().value("folder").toString();
}

}  // namespace

Files::Files(Document& document, MessageBar& messages, QWidget& window)
    : QObject(&window), m_document(document), m_messages(messages), m_window(window) {}

bool Files::openAsked(bool meshesOnly) {
    const QString meshes = tr("Meshes (*.glb *.gltf *.obj *.ply)");
    const QString all = tr("All that Whorl opens (*.whorl groom.json *.glb *.gltf *.obj *.ply)");
    QString file = QFileDialog::getOpenFileName(&m_window, meshesOnly ? tr("New from a mesh") : tr("Open"),
                                                folderOf(m_document), meshesOnly ? meshes : all + ";;" + meshes);
    if (file.isEmpty()) return false;
    // A package is a folder; its groom.json stands for it.
    const QFileInfo info(file);
    if (info.fileName() == "groom.json") file = info.path();
    return open(pathOf(file));
}

bool Files::open(const std::filesystem::path& file) {
    return openAs(file, fileKind(file) == FileKind::Document ? Opened::Document : Opened::Import);
}

bool Files::openSample(const std::filesystem::path& file) {
    return openAs(file, Opened::Sample);
}

bool Files::openAs(const std::filesystem::path& file, Opened kind) {
    if (!mayDiscard()) return false;
    const QString name = textOf(file.filename());
    SurfaceCache& surfaces = m_document.surfaces();
    Result<OpenedDocument> opened =
        runWithProgress<OpenedDocument>(&m_window, tr("Opening %1").arg(name), [&](Progress& progress) {
            Result<OpenedDocument> result = openGroom(file, progress);
            // Rays and nearest points are prepared here, so that the window does not stand still for them.
            if (result) (void)surfaces.get(result->groom.mesh);
            return result;
        });
    if (!opened) {
        if (!opened.error().cancelled) m_messages.say(MessageBar::Kind::Error, sentenceOf(opened.error()));
        return false;
    }
    m_restored.reset();
    Q_EMIT journalObsolete();
    m_lock.reset();
    m_readOnly.clear();
    m_copyOnly = false;
    const bool document = kind == Opened::Document;
    if (document) m_lock = lock(file);
    m_document.reset(std::move(opened->groom),
                     document && !m_copyOnly ? std::filesystem::absolute(file) : std::filesystem::path());
    // A sample can be opened again: only work on it is unsaved.
    if (kind == Opened::Import || m_copyOnly) m_document.markUnsaved();
    if (kind != Opened::Sample) {
        remember(file);
        QSettings().setValue("folder", textOf(std::filesystem::absolute(file).parent_path()));
    }
    tell(tr("Opened %1.").arg(name), opened->problems);
    return true;
}

std::unique_ptr<QLockFile> Files::lock(const std::filesystem::path& file) {
    const QFileInfo info(textOf(file));
    auto held = std::make_unique<QLockFile>(info.dir().filePath('.' + info.fileName() + ".lock"));
    held->setStaleLockTime(0);
    if (held->tryLock(0)) {
        if (!info.isWritable()) m_readOnly = tr("%1 may not be written.").arg(info.fileName());
        return held;
    }
    if (held->error() == QLockFile::LockFailedError) {
        qint64 pid = 0;
        QString host;
        QString program;
        held->getLockInfo(&pid, &host, &program);
        m_copyOnly = true;
        m_readOnly = tr("%1 is open in another window of Whorl%2; this is a copy without a name.")
                         .arg(info.fileName(), host.isEmpty() ? QString() : tr(" on %1").arg(host));
    } else {
        m_readOnly = tr("The folder of %1 may not be written.").arg(info.fileName());
    }
    return nullptr;
}

void Files::tell(const QString& done, const Problems& problems) {
    QStringList details;
    for (const std::string& problem : problems) details.push_back(QString::fromStdString(problem));
    if (!m_readOnly.isEmpty()) {
        m_messages.say(MessageBar::Kind::Warning, tr("%1 Save it under another name.").arg(m_readOnly), details);
    } else if (details.size() == 1) {
        m_messages.say(MessageBar::Kind::Warning, done + ' ' + details.front());
    } else if (!details.isEmpty()) {
        m_messages.say(MessageBar::Kind::Warning,
                       tr("%1 %2 things were repaired or left out.").arg(done).arg(details.size()), details);
    } else {
        m_messages.say(MessageBar::Kind::Info, done);
    }
}

bool Files::save() {
    if (!m_document.hasGroom()) return false;
    if (m_document.file().empty() || !m_readOnly.isEmpty()) return saveAs();
    return saveTo(m_document.file());
}

bool Files::saveAs() {
    if (!m_document.hasGroom()) return false;
    const QString start = m_document.file().empty() ? folderOf(m_document) + "/groom.whorl" : textOf(m_document.file());
    const QString file = QFileDialog::getSaveFileName(&m_window, tr("Save as"), start, tr("Whorl documents (*.whorl)"));
    return !file.isEmpty() && saveTo(pathOf(file));
}

bool Files::saveTo(std::filesystem::path file) {
    if (file.extension() != ".whorl") file += ".whorl";
    file = std::filesystem::absolute(file);
    const QString name = textOf(file.filename());
    m_document.revert();
    std::unique_ptr<QLockFile> newLock;
    const bool sameFile = file == m_document.file() && m_lock;
    if (!sameFile) {
        const QString reason = std::exchange(m_readOnly, {});
        const bool copy = std::exchange(m_copyOnly, false);
        newLock = lock(file);
        const bool taken = std::exchange(m_copyOnly, copy);
        m_readOnly = reason;
        if (taken) {
            m_messages.say(MessageBar::Kind::Error,
                           tr("%1 is open in another window of Whorl; choose another name.").arg(name));
            return false;
        }
    }
    const Groom groom = m_document.committed();
    const Result<void> saved = runWithProgress<void>(
        &m_window, tr("Saving %1").arg(name), [&](Progress& progress) { return saveDocument(groom, file, progress); });
    if (!saved) {
        if (!saved.error().cancelled) m_messages.say(MessageBar::Kind::Error, sentenceOf(saved.error()));
        return false;
    }
    if (!sameFile) m_lock = std::move(newLock);
    m_readOnly.clear();
    m_copyOnly = false;
    m_document.markSaved(file);
    if (m_restored) deleteRecovery(*m_restored);
    m_restored.reset();
    Q_EMIT journalObsolete();
    remember(file);
    m_messages.say(MessageBar::Kind::Info, tr("Saved %1.").arg(name));
    return true;
}

bool Files::mayDiscard() {
    m_document.revert();
    if (!m_document.hasGroom() || m_document.clean()) return true;
    QMessageBox question(QMessageBox::NoIcon, tr("Unsaved work"),
                         tr("<b>Save the changes to %1?</b>").arg(m_document.shownName().toHtmlEscaped()),
                         QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &m_window);
    question.setObjectName("unsaved_question");
    question.setInformativeText(tr("Without saving they are lost."));
    question.setDefaultButton(QMessageBox::Save);
    switch (question.exec()) {
        case QMessageBox::Save:
            return save();
        case QMessageBox::Discard:
            return true;
        default:
            return false;
    }
}

bool Files::restore(const Recovery& recovery) {
    Result<OpenedDocument> opened = runWithProgress<OpenedDocument>(
        &m_window, tr("Restoring"), [&](Progress& progress) { return openRecovery(recovery, progress); });
    if (!opened) {
        m_messages.say(MessageBar::Kind::Error, sentenceOf(opened.error()));
        return false;
    }
    m_lock.reset();
    m_readOnly.clear();
    m_copyOnly = false;
    if (!recovery.document.empty()) m_lock = lock(recovery.document);
    m_document.reset(std::move(opened->groom), m_copyOnly ? std::filesystem::path() : recovery.document);
    m_document.markUnsaved();
    m_restored = recovery;
    tell(tr("Restored the work of %1; save it to keep it.").arg(QString::fromStdString(recovery.when)),
         opened->problems);
    return true;
}

QStringList Files::recent() const {
    return QSettings().value("recent").toStringList();
}

void Files::clearRecent() {
    QSettings().remove("recent");
    Q_EMIT recentChanged();
}

void Files::remember(const std::filesystem::path& file) {
    const QString text = textOf(std::filesystem::absolute(file).lexically_normal());
    QStringList list = recent();
    list.removeAll(text);
    list.prepend(text);
    while (list.size() > maxRecent) list.removeLast();
    QSettings().setValue("recent", list);
    Q_EMIT recentChanged();
}

}  // namespace whorl
