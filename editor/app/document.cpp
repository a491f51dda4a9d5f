// SPDX-License-Identifier: Apache-2.0
#include "editor/app/document.h"

#include "editor/app/edit_groom.h"

#include <QFile>
#include <vector>

namespace whorl {

Document::Document(QObject* parent) : QObject(parent) {
    connect(&m_history, &QUndoStack::cleanChanged, this, [this] {
        if (!m_rebuilding) Q_EMIT changed();
    });
}

Document::~Document() {
    // The stack's last signals must not reach a document that is half gone.
    m_history.disconnect(this);
}

std::shared_ptr<const Surface> Document::surface() const {
    if (groom().mesh->triangles.empty()) return nullptr;
    return m_surfaces.get(groom().mesh);
}

void Document::preview(Groom groom) {
    m_preview = std::move(groom);
    Q_EMIT changed();
}

void Document::commit(const QString& text, const QString& mergeKey) {
    if (!m_preview) return;
    Groom after = std::move(*m_preview);
    m_preview.reset();
    if (after.sameAs(m_groom)) {
        Q_EMIT changed();
        return;
    }
    Groom before = m_groom;
    m_history.push(new EditGroom(*this, std::move(before), std::move(after), text, mergeKey));
    trimHistory();
}

void Document::revert() {
    if (!m_preview) return;
    m_preview.reset();
    Q_EMIT changed();
}

void Document::edit(Groom after, const QString& text, const QString& mergeKey) {
    m_preview = std::move(after);
    commit(text, mergeKey);
}

void Document::reset(Groom groom, const std::filesystem::path& file) {
    m_preview.reset();
    m_rebuilding = true;
    m_history.clear();
    m_history.setClean();
    m_rebuilding = false;
    m_groom = std::move(groom);
    m_file = file;
    ++m_revision;
    Q_EMIT changed();
}

void Document::markSaved(const std::filesystem::path& file) {
    m_file = file;
    m_history.setClean();
    Q_EMIT changed();
}

void Document::markUnsaved() {
    m_history.resetClean();
    Q_EMIT changed();
}

QString Document::shownName() const {
    return m_file.empty() ? tr("Untitled") : textOf(m_file.filename());
}

void Document::undo() {
    revert();
    m_history.undo();
}

void Document::redo() {
    revert();
    m_history.redo();
}

void Document::setUndoBytes(std::size_t bytes) {
    m_undoBytes = bytes;
    trimHistory();
}

std::size_t Document::bytesInHistory() const {
    std::size_t bytes = 0;
    for (int i = 0; i < m_history.count(); ++i) bytes += static_cast<const EditGroom*>(m_history.command(i))->bytes();
    return bytes;
}

void Document::show(const Groom& groom) {
    if (m_rebuilding) return;
    m_preview.reset();
    m_groom = groom;
    ++m_revision;
    Q_EMIT changed();
}

void Document::trimHistory() {
    // QUndoStack limits steps, not bytes, and can not drop its oldest step: so the rest is pushed again. Going down to
    // three quarters makes that rare.
    if (m_history.index() != m_history.count() || m_history.count() < 2) return;
    std::size_t bytes = bytesInHistory();
    if (bytes <= m_undoBytes) return;
    int first = 0;
    while (first < m_history.count() - 1 && bytes > m_undoBytes / 4 * 3) {
        bytes -= static_cast<const EditGroom*>(m_history.command(first))->bytes();
        ++first;
    }
    const int clean = m_history.cleanIndex() - first;
    std::vector<EditGroom*> kept;
    for (int i = first; i < m_history.count(); ++i) {
        kept.push_back(static_cast<const EditGroom*>(m_history.command(i))->restored());
    }
    m_rebuilding = true;
    m_history.clear();
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (static_cast<int>(i) == clean) m_history.setClean();
        m_history.push(kept[i]);
    }
    if (clean == m_history.count()) m_history.setClean();
    if (clean < 0) m_history.resetClean();
    m_rebuilding = false;
    Q_EMIT changed();
}

QString textOf(const std::filesystem::path& path) {
    return QFile::decodeName(QByteArray::fromStdString(path.string()));
}

std::filesystem::path pathOf(const QString& text) {
    return QFile::encodeName(text).toStdString();
}

}  // namespace whorl
