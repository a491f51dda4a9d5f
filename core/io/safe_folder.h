// SPDX-License-Identifier: Apache-2.0
// Folders that are either the old ones or the new ones, as safe_file.h does it for files.
#pragma once

#include "core/base/result.h"

#include <filesystem>

namespace whorl {

/// A temporary folder beside `folder` to fill, then to put in its place as a whole. On any failure the old folder is as
/// it was and the temporary is gone. One thread at a time.
class SafeFolder {
public:
    /// Sweeps what crashed programs left of that name. Symbolic links are followed.
    static Result<SafeFolder> create(const std::filesystem::path& folder);
    SafeFolder(SafeFolder&&) noexcept;
    SafeFolder& operator=(SafeFolder&&) noexcept;
    ~SafeFolder();  ///< not committed: the temporary is removed

    /// Where to write the new files.
    const std::filesystem::path& path() const { return m_temporary; }
    /// Puts it in place. The old folder is removed with all that is in it.
    Result<void> commit();

private:
    SafeFolder() = default;
    Error fail(int error);
    void abandon();

    std::filesystem::path m_target;
    std::filesystem::path m_temporary;
    int m_lock = -1;
    bool m_replaces = false;
};

/// Puts back an old folder that a crash left under another name, on disks where two folders can not change places in
/// one step. Nothing happens when `folder` is there.
void restoreFolder(const std::filesystem::path& folder);

}  // namespace whorl
