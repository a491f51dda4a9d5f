// SPDX-License-Identifier: Apache-2.0
// The autosave journal: what a crash would have lost.
#pragma once

#include "core/io/document.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace whorl {

/// One a running program and document, locked while in use. Holds whole grooms, written atomically; a crash leaves the
/// newest one to be offered at the next start. Never overwrites another's journal.
class Journal {
public:
    /// `document` may be empty (unnamed work); `folder` is where journals live (see journalFolder()).
    static Result<Journal> create(const std::filesystem::path& folder, const std::filesystem::path& document);
    Journal(Journal&&) noexcept;
    Journal& operator=(Journal&&) noexcept;
    ~Journal();  ///< keeps the file: only `discard` removes it

    Result<void> write(const Groom& groom, Progress& progress);
    /// The work is saved or given up: removes the journal.
    void discard();
    const std::filesystem::path& file() const { return m_file; }

private:
    Journal() = default;
    std::filesystem::path m_file;
    std::filesystem::path m_document;
    int m_lock = -1;
};

/// A journal that no running program holds: work to offer, newest first.
struct Recovery {
    std::filesystem::path journal;
    std::filesystem::path document;  ///< empty for unnamed work
    std::string when;                ///< local time of the last write
};
std::vector<Recovery> findRecoveries(const std::filesystem::path& folder);
Result<OpenedDocument> openRecovery(const Recovery& recovery, Progress& progress);
/// Only after the artist said so.
void deleteRecovery(const Recovery& recovery);

/// $XDG_STATE_HOME/whorl/journals or ~/.local/state/whorl/journals.
std::filesystem::path journalFolder();

}  // namespace whorl
