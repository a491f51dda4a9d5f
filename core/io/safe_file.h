// SPDX-License-Identifier: Apache-2.0
// Files that are either the old ones or the new ones, whatever happens in between.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace whorl {

/// Writes a temporary file beside `file`, syncs it, renames it over `file`, syncs the folder. On any failure the old
/// file is as it was, the temporary is gone and the sentence says cause and bytes. Symbolic links are followed, the
/// permissions of the old file are kept, temporaries of crashed programs are swept. One thread at a time.
class SafeFile {
public:
    static Result<SafeFile> create(const std::filesystem::path& file);
    SafeFile(SafeFile&&) noexcept;
    SafeFile& operator=(SafeFile&&) noexcept;
    ~SafeFile();  ///< not committed: the temporary is removed

    /// Gathers small pieces, so a fault may show at a later call. After a fault every further call fails.
    Result<void> write(const void* data, std::size_t bytes);
    std::uint64_t written() const { return m_written; }
    /// Writes out and syncs what was gathered; the temporary's path, to read it back before `commit`.
    Result<std::filesystem::path> complete();
    Result<void> commit();

private:
    SafeFile() = default;
    Result<void> flush();
    Error fail(int error);
    void abandon();

    std::filesystem::path m_target;
    std::filesystem::path m_temporary;
    std::vector<std::uint8_t> m_gathered;
    int m_descriptor = -1;
    bool m_replaces = false;
    std::uint64_t m_written = 0;
};

/// The whole file; refused above `maxBytes`, for folders, devices and pipes.
Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& file, std::uint64_t maxBytes);

/// Its first bytes, fewer when it is shorter. The same refusals, any size.
Result<std::vector<std::uint8_t>> readFileStart(const std::filesystem::path& file, std::size_t bytes);

/// For tests: called before every write, sync and rename; returns an errno to fail with, or 0. Empty: off.
enum class FileStep { Open, Write, Sync, Rename, SyncFolder };
void setFileFault(std::function<int(FileStep)> fault);

/// Removes temporaries that a crash left beside `file`: those of its name that no living process holds.
void sweepOrphans(const std::filesystem::path& file);

}  // namespace whorl
