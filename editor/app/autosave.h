// SPDX-License-Identifier: Apache-2.0
// Keeps a journal of unsaved work, in the background.
#pragma once

#include "core/io/journal.h"
#include "editor/app/latest_job.h"

#include <QObject>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>

namespace whorl {

class Document;

/// Writes the groom to a journal after 60 s or 20 steps of unsaved work, whichever comes first.
class Autosave : public QObject {
    Q_OBJECT

public:
    static constexpr int seconds = 60;
    static constexpr int steps = 20;

    Autosave(Document& document, std::filesystem::path folder, QObject* parent = nullptr);
    ~Autosave() override;

    /// The work is saved or given up: removes the journal.
    void discard();
    /// Writes now if there is unsaved work.
    void writeNow();
    /// Waits for a write in progress.
    void wait() { m_job.wait(); }
    /// The journal's file; empty while there is none.
    std::filesystem::path file() const;

Q_SIGNALS:
    void failed(const QString& sentence);

private:
    /// Used by the job's thread only; the window waits for the job before it touches this.
    struct Place {
        std::optional<Journal> journal;
    };
    void documentChanged();

    Document& m_document;
    std::filesystem::path m_folder;
    std::shared_ptr<Place> m_place = std::make_shared<Place>();
    QTimer m_timer;
    std::uint64_t m_written = 0;  // revision that the journal holds
    bool m_retry = false;         // the last write failed: the timer tries again
    bool m_complained = false;
    LatestJob m_job;
};

}  // namespace whorl
