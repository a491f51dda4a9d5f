// SPDX-License-Identifier: Apache-2.0
// Files that are either the old ones or the new ones, whatever happens in between.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace whorl {

/// Writes a temporary file beside `file`, syncs it, renames it over `file`, syncs the folder. On any failure the old
/// file is as it was, the temporary is gone and the sentence says cause and bytes. Symbolic links are followed.
class SafeFile {
public:
    static Result<SafeFile> create(const std::filesystem::path& file);
    SafeFile(SafeFile&&) noexcept;
    SafeFile& operator=(SafeFile&&) noexcept;
    ~SafeFile();  ///< not committed: the temporary is removed

    Result<void> write(const void* data, std::size_t bytes);
    std::uint64_t written() const { return m_written; }
    Result<void> commit();

private:
    SafeFile() = default;
    std::filesystem::path m_target;
    std::filesystem::path m_temporary;
    int m_descriptor = -1;
    std::uint64_t m_written = 0;
};

/// The whole file; refused above `maxBytes`, for folders, devices and pipes.
Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& file, std::uint64_t maxBytes);

/// For tests: called before every write, sync and rename; returns an errno to fail with, or 0. Empty: off.
enum class FileStep { Open, Write, Sync, Rename, SyncFolder };
void setFileFault(std::function<int(FileStep)> fault);

/// Removes temporaries that a crash left beside `file`.
void sweepOrphans(const std::filesystem::path& file);

}  // namespace whorl
