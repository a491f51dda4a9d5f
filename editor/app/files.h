// SPDX-License-Identifier: Apache-2.0
// Opening and saving: files, locks, recent files, the question about unsaved work.
#pragma once

#include "core/io/journal.h"
#include "core/model/groom.h"

#include <QLockFile>
#include <QObject>
#include <QStringList>
#include <filesystem>
#include <memory>
#include <optional>

class QWidget;

namespace whorl {

class Document;
class MessageBar;

class Files : public QObject {
    Q_OBJECT

public:
    static constexpr int maxRecent = 10;

    Files(Document& document, MessageBar& messages, QWidget& window);

    /// With a file dialog. False when nothing was opened.
    bool openAsked(bool meshesOnly);
    /// A document, package or mesh; asks about unsaved work first. Problems go to the message bar.
    bool open(const std::filesystem::path& file);
    /// The same for a groom that came with the program: as work without a name, so that saving never overwrites it.
    bool openSample(const std::filesystem::path& file);
    /// Saves under the document's name; asks for one when it has none or may not be written.
    bool save();
    bool saveAs();
    bool saveTo(std::filesystem::path file);
    /// Offers to save unsaved work. False: the artist wants to go on with it.
    bool mayDiscard();
    /// Takes over a journal's work. It stays on disk until the work is saved.
    bool restore(const Recovery& recovery);

    QStringList recent() const;
    void clearRecent();
    /// Why the document's file may not be written, or empty.
    const QString& readOnlyReason() const { return m_readOnly; }

Q_SIGNALS:
    void recentChanged();
    /// The work is saved, or was given up for other work: journals of it are no longer needed.
    void journalObsolete();

private:
    enum class Opened : std::uint8_t { Document, Import, Sample };
    bool openAs(const std::filesystem::path& file, Opened kind);
    void remember(const std::filesystem::path& file);
    /// Locks `file`; sets m_readOnly when it is someone else's or may not be written.
    std::unique_ptr<QLockFile> lock(const std::filesystem::path& file);
    void tell(const QString& done, const Problems& problems);

    Document& m_document;
    MessageBar& m_messages;
    QWidget& m_window;
    std::unique_ptr<QLockFile> m_lock;
    QString m_readOnly;
    bool m_copyOnly = false;  // someone else has the file open
    std::optional<Recovery> m_restored;
};

}  // namespace whorl
