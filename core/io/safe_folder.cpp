// SPDX-License-Identifier: Apache-2.0
#include "core/io/safe_folder.h"

#include "core/io/file_steps.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

namespace whorl {
namespace {

namespace fs = std::filesystem;

fs::path targetOf(const fs::path& folder) {
    std::error_code error;
    fs::path path = fs::absolute(folder, error).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
    return linkTarget(path);
}

/// Where the old folder waits while the new one takes its name, if they can not change places in one step.
fs::path waitingPlace(const fs::path& target) {
    return target.parent_path() / (temporaryStart(target.filename().string()) + "old");
}

void removeAll(const fs::path& folder) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
}

/// Opens and locks; -1 when somebody holds it or it is gone.
int lockFolder(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0) return -1;
    struct stat status {};
    const bool held = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!held && fstat(descriptor, &status) == 0 && status.st_nlink > 0) return descriptor;
    close(descriptor);
    return -1;
}

void sweepFolders(const fs::path& target) {
    std::error_code error;
    fs::directory_iterator entry(target.parent_path(), error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const fs::path path = entry->path();
        if (!isTemporaryOf(path.filename().string(), target.filename().string())) continue;
        const int descriptor = lockFolder(path);
        if (descriptor < 0) continue;
        removeAll(path);
        close(descriptor);
    }
}

/// Lets two folders change places. 0 or an errno.
int exchange(const fs::path& one, const fs::path& other) {
    if (const int fault = fileFault(FileStep::Rename)) return fault;
    return renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0 ? 0 : errno;
}

int move(const fs::path& from, const fs::path& to) {
    if (const int fault = fileFault(FileStep::Rename)) return fault;
    return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace

Result<SafeFolder> SafeFolder::create(const fs::path& folder) {
    const std::string name = folder.string();
    SafeFolder safe;
    safe.m_target = targetOf(folder);
    if (safe.m_target.empty() || safe.m_target.filename().empty())
        return Error{name + " can not be written: it is not the name of a folder. Choose another name."};
    restoreFolder(safe.m_target);
    struct stat old {};
    if (::stat(safe.m_target.c_str(), &old) == 0) {
        if (!S_ISDIR(old.st_mode))
            return Error{name + " can not be written: a file has that name. Choose another name."};
        safe.m_replaces = true;
    } else if (errno != ENOENT) {
        const int error = errno;
        return Error{name + " can not be written: " + fileCause(error) + ". " + fileAdvice(error)};
    }
    sweepFolders(safe.m_target);
    int error = fileFault(FileStep::Open);
    for (int attempt = 0; attempt < 20 && error == 0; ++attempt) {
        safe.m_temporary = safe.m_target.parent_path() / temporaryName(safe.m_target.filename().string());
        if (mkdir(safe.m_temporary.c_str(), 0777) != 0) {
            if (errno != EEXIST) error = errno;
            continue;
        }
        safe.m_lock = lockFolder(safe.m_temporary);
        if (safe.m_lock < 0) continue;
        if (safe.m_replaces && fchmod(safe.m_lock, (old.st_mode & 0777) | 0700) != 0) return safe.fail(errno);
        return Result<SafeFolder>(std::move(safe));
    }
    if (error == 0) error = EBUSY;
    return Error{name + " can not be written: " + fileCause(error) + ". " + fileAdvice(error)};
}

SafeFolder::SafeFolder(SafeFolder&& other) noexcept {
    *this = std::move(other);
}

SafeFolder& SafeFolder::operator=(SafeFolder&& other) noexcept {
    if (this == &other) return *this;
    abandon();
    m_target = std::move(other.m_target);
    m_temporary = std::move(other.m_temporary);
    m_lock = std::exchange(other.m_lock, -1);
    m_replaces = other.m_replaces;
    return *this;
}

SafeFolder::~SafeFolder() {
    abandon();
}

void SafeFolder::abandon() {
    if (m_lock < 0) return;
    removeAll(m_temporary);
    close(m_lock);
    m_lock = -1;
}

Error SafeFolder::fail(int error) {
    abandon();
    return Error{m_target.string() + " could not be written: " + fileCause(error) + ". " +
                 (m_replaces ? "The old one is as it was. " : "") + fileAdvice(error)};
}

Result<void> SafeFolder::commit() {
    if (m_lock < 0) return Error{m_target.string() + " could not be written: writing failed before."};
    if (const int error = syncFolder(m_temporary)) return fail(error);
    const fs::path parent = m_target.parent_path();
    if (!m_replaces) {
        if (const int error = move(m_temporary, m_target)) return fail(error);
        if (const int error = syncFolder(parent)) {
            ::rename(m_target.c_str(), m_temporary.c_str());
            return fail(error);
        }
        close(m_lock);
        m_lock = -1;
        return {};
    }
    fs::path old = m_temporary;
    int error = exchange(m_temporary, m_target);
    const bool twoSteps = error == EINVAL || error == ENOSYS || error == ENOTSUP;
    if (twoSteps) {
        old = waitingPlace(m_target);
        removeAll(old);
        error = move(m_target, old);
        if (error == 0 && (error = move(m_temporary, m_target)) != 0) ::rename(old.c_str(), m_target.c_str());
    }
    if (error != 0) return fail(error);
    if ((error = syncFolder(parent)) != 0) {
        if (twoSteps) {
            ::rename(m_target.c_str(), m_temporary.c_str());
            ::rename(old.c_str(), m_target.c_str());
        } else {
            renameat2(AT_FDCWD, m_temporary.c_str(), AT_FDCWD, m_target.c_str(), RENAME_EXCHANGE);
        }
        return fail(error);
    }
    removeAll(old);
    close(m_lock);
    m_lock = -1;
    return {};
}

void restoreFolder(const fs::path& folder) {
    const fs::path target = targetOf(folder);
    if (target.empty()) return;
    std::error_code error;
    const fs::path waiting = waitingPlace(target);
    if (!fs::is_directory(fs::symlink_status(waiting, error))) return;
    if (!fs::exists(fs::symlink_status(target, error))) ::rename(waiting.c_str(), target.c_str());
}

}  // namespace whorl
