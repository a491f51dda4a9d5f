// SPDX-License-Identifier: Apache-2.0
// The open document: the current groom, its history and its file.
#pragma once

#include "core/model/groom.h"
#include "core/surface/surface.h"

#include <QObject>
#include <QUndoStack>
#include <filesystem>
#include <memory>
#include <optional>

namespace whorl {

/// Everything that changes a groom goes through `preview`, `commit` and `revert`. Listeners keep the parts of the groom
/// that they saw last and ask `sameAs`. GUI thread only.
class Document : public QObject {
    Q_OBJECT

public:
    static constexpr std::size_t defaultUndoBytes = std::size_t{512} << 20;

    explicit Document(QObject* parent = nullptr);
    ~Document() override;

    /// What is shown: the preview while there is one.
    const Groom& groom() const { return m_preview ? *m_preview : m_groom; }
    /// Without the preview: what saving writes.
    const Groom& committed() const { return m_groom; }
    bool hasGroom() const { return !m_groom.mesh->triangles.empty(); }
    bool previewing() const { return m_preview.has_value(); }
    /// Of the shown mesh; null while there is no mesh.
    std::shared_ptr<const Surface> surface() const;
    SurfaceCache& surfaces() const { return m_surfaces; }

    /// Shows `groom` without a step in the history, until `commit` or `revert`.
    void preview(Groom groom);
    /// Makes the preview one step of the history. Nothing happens without a preview or when it changed nothing.
    void commit(const QString& text, const QString& mergeKey = {});
    /// Drops the preview.
    void revert();
    /// Preview and commit in one.
    void edit(Groom after, const QString& text, const QString& mergeKey = {});

    /// Starts anew with another groom and an empty history. `file` is empty for work without a name.
    void reset(Groom groom, const std::filesystem::path& file);
    void markSaved(const std::filesystem::path& file);
    /// The groom has no saved file that equals it (new or recovered work).
    void markUnsaved();
    bool clean() const { return m_history.isClean(); }
    const std::filesystem::path& file() const { return m_file; }
    /// "head.whorl", or "Untitled".
    QString shownName() const;

    void undo();
    void redo();
    QUndoStack& history() { return m_history; }
    /// The oldest steps are forgotten when the history keeps more than this; the newest step always stays.
    void setUndoBytes(std::size_t bytes);
    std::size_t bytesInHistory() const;
    /// Counts every change of the committed groom.
    std::uint64_t revision() const { return m_revision; }

    /// For EditGroom: makes `groom` current without touching the history.
    void show(const Groom& groom);

Q_SIGNALS:
    /// The shown groom, the file name or the saved state changed.
    void changed();

private:
    void trimHistory();

    Groom m_groom;
    std::optional<Groom> m_preview;
    QUndoStack m_history;
    mutable SurfaceCache m_surfaces;
    std::filesystem::path m_file;
    std::size_t m_undoBytes = defaultUndoBytes;
    std::uint64_t m_revision = 0;
    bool m_rebuilding = false;
};

/// Qt's text for a path, and back.
QString textOf(const std::filesystem::path& path);
std::filesystem::path pathOf(const QString& text);

}  // namespace whorl
