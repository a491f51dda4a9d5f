// SPDX-License-Identifier: Apache-2.0
#include "core/io/safe_file.h"

#include "core/io/file_steps.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <utility>

namespace whorl {
namespace {

constexpr std::size_t gatherBytes = std::size_t{1} << 18;

/// A write beyond the size limit shall be an error to report, not the end of the program.
void ignoreSizeSignal() {
    static const bool done = [] {
        struct sigaction action {};
        if (sigaction(SIGXFSZ, nullptr, &action) == 0 && action.sa_handler == SIG_DFL) {
            action.sa_handler = SIG_IGN;
            sigaction(SIGXFSZ, &action, nullptr);
        }
        return true;
    }();
    (void)done;
}

/// All bytes, or an errno.
int writeAll(int descriptor, const std::uint8_t* data, std::size_t bytes) {
    while (bytes > 0) {
        if (const int fault = fileFault(FileStep::Write)) return fault;
        const ssize_t done = ::write(descriptor, data, std::min<std::size_t>(bytes, std::size_t{1} << 24));
        if (done < 0) {
            if (errno == EINTR) continue;
            return errno;
        }
        data += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return 0;
}

int syncFile(int descriptor) {
    if (const int fault = fileFault(FileStep::Sync)) return fault;
    while (fsync(descriptor) != 0) {
        if (errno == EINTR) continue;
        // File systems without sync have nothing better to offer.
        return errno == EINVAL || errno == ENOSYS || errno == ENOTSUP ? 0 : errno;
    }
    return 0;
}

/// Opens a fresh temporary and locks it, so that sweepOrphans of other programs leaves it alone.
int openTemporary(const std::filesystem::path& target, mode_t mode, std::filesystem::path& temporary) {
    if (const int fault = fileFault(FileStep::Open)) {
        errno = fault;
        return -1;
    }
    for (int attempt = 0; attempt < 20; ++attempt) {
        temporary = target.parent_path() / temporaryName(target.filename().string());
        const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor < 0) {
            if (errno == EEXIST || errno == EINTR) continue;
            return -1;
        }
        const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        struct stat status {};
        // A sweep may have come between open and lock; then this one is gone or about to be.
        if (locked && fstat(descriptor, &status) == 0 && status.st_nlink > 0) return descriptor;
        close(descriptor);
    }
    errno = EBUSY;
    return -1;
}

}  // namespace

Result<SafeFile> SafeFile::create(const std::filesystem::path& file) {
    ignoreSizeSignal();
    const std::string name = file.string();
    std::error_code pathError;
    SafeFile safe;
    safe.m_target = linkTarget(std::filesystem::absolute(file, pathError));
    if (pathError || safe.m_target.empty())
        return Error{name + " can not be saved: its symbolic links lead nowhere. Choose another name."};
    if (safe.m_target.filename().empty() || safe.m_target.filename() == "." || safe.m_target.filename() == "..")
        return Error{name + " can not be saved: it is not the name of a file. Choose another name."};

    struct stat old {};
    mode_t mode = 0666;
    if (::stat(safe.m_target.c_str(), &old) == 0) {
        if (!S_ISREG(old.st_mode))
            return Error{name + " can not be saved: a folder or device has that name. Choose another name."};
        if (access(safe.m_target.c_str(), W_OK) != 0)
            return Error{name + " can not be saved: it is read-only. Save under another name, or allow writing to it."};
        safe.m_replaces = true;
        mode = 0600;
    } else if (errno != ENOENT) {
        const int error = errno;
        return Error{name + " can not be saved: " + fileCause(error) + ". " + fileAdvice(error)};
    }

    sweepOrphans(safe.m_target);
    safe.m_descriptor = openTemporary(safe.m_target, mode, safe.m_temporary);
    if (safe.m_descriptor < 0) {
        const int error = errno;
        return Error{name + " can not be saved: " + fileCause(error) + "; no byte was written. " + fileAdvice(error)};
    }
    if (safe.m_replaces) {
        // Not allowed to give the file to the old owner or group: then it is ours, with the same permissions.
        if (fchown(safe.m_descriptor, old.st_uid, old.st_gid) != 0) (void)errno;
        if (fchmod(safe.m_descriptor, old.st_mode & 0777) != 0) return safe.fail(errno);
    }
    return Result<SafeFile>(std::move(safe));
}

SafeFile::SafeFile(SafeFile&& other) noexcept {
    *this = std::move(other);
}

SafeFile& SafeFile::operator=(SafeFile&& other) noexcept {
    if (this == &other) return *this;
    abandon();
    m_target = std::move(other.m_target);
    m_temporary = std::move(other.m_temporary);
    m_gathered = std::move(other.m_gathered);
    m_descriptor = std::exchange(other.m_descriptor, -1);
    m_replaces = other.m_replaces;
    m_written = other.m_written;
    other.m_gathered.clear();
    return *this;
}

SafeFile::~SafeFile() {
    abandon();
}

void SafeFile::abandon() {
    if (m_descriptor < 0) return;
    unlink(m_temporary.c_str());
    close(m_descriptor);
    m_descriptor = -1;
    m_gathered.clear();
}

Error SafeFile::fail(int error) {
    std::string text = m_target.string() + " could not be saved: " + fileCause(error) + " (" +
                       std::to_string(m_written) + " bytes were to be written so far";
    struct statvfs disk {};
    if ((error == ENOSPC || error == EDQUOT) && m_descriptor >= 0 && fstatvfs(m_descriptor, &disk) == 0)
        text += ", " + std::to_string(std::uint64_t{disk.f_bavail} * disk.f_frsize) + " are free";
    text += m_replaces ? "). The old file is as it was. " : "). ";
    text += fileAdvice(error);
    abandon();
    return Error{std::move(text)};
}

Result<void> SafeFile::flush() {
    if (m_descriptor < 0) return Error{m_target.string() + " could not be saved: writing failed before."};
    const int error = writeAll(m_descriptor, m_gathered.data(), m_gathered.size());
    m_gathered.clear();
    if (error) return fail(error);
    return {};
}

Result<void> SafeFile::write(const void* data, std::size_t bytes) {
    if (m_descriptor < 0) return Error{m_target.string() + " could not be saved: writing failed before."};
    m_written += bytes;
    const auto* from = static_cast<const std::uint8_t*>(data);
    if (m_gathered.size() + bytes < gatherBytes) {
        m_gathered.insert(m_gathered.end(), from, from + bytes);
        return {};
    }
    if (auto flushed = flush(); !flushed) return flushed;
    if (const int error = writeAll(m_descriptor, from, bytes)) return fail(error);
    return {};
}

Result<std::filesystem::path> SafeFile::complete() {
    if (auto flushed = flush(); !flushed) return flushed.error();
    if (const int error = syncFile(m_descriptor)) return fail(error);
    return m_temporary;
}

Result<void> SafeFile::commit() {
    if (auto completed = complete(); !completed) return completed.error();
    if (const int fault = fileFault(FileStep::Rename)) return fail(fault);

    // A second name for the old file, until the folder is synced: the way back if that fails.
    std::filesystem::path way = m_target.parent_path() / temporaryName(m_target.filename().string());
    const bool hasWay = m_replaces && link(m_target.c_str(), way.c_str()) == 0;
    if (rename(m_temporary.c_str(), m_target.c_str()) != 0) {
        const int error = errno;
        if (hasWay) unlink(way.c_str());
        return fail(error);
    }
    if (const int error = syncFolder(m_target.parent_path())) {
        if (hasWay) {
            rename(way.c_str(), m_target.c_str());
        } else if (!m_replaces) {
            unlink(m_target.c_str());
        } else {
            const std::string name = m_target.string();
            abandon();
            return Error{name + " was saved, but may not survive a power cut: " + fileCause(error) + ". " +
                         fileAdvice(error)};
        }
        return fail(error);
    }
    if (hasWay) unlink(way.c_str());
    close(m_descriptor);
    m_descriptor = -1;
    return {};
}

namespace {

/// A regular file, open for reading.
struct OpenedFile {
    int descriptor = -1;
    std::uint64_t size = 0;

    OpenedFile() = default;
    OpenedFile(OpenedFile&& other) noexcept : descriptor(std::exchange(other.descriptor, -1)), size(other.size) {}
    OpenedFile& operator=(OpenedFile&&) = delete;
    ~OpenedFile() {
        if (descriptor >= 0) close(descriptor);
    }
};

Result<OpenedFile> openFile(const std::string& name) {
    OpenedFile file;
    // Without O_NONBLOCK a pipe would wait for a writer.
    file.descriptor = open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status {};
    if (file.descriptor < 0 || fstat(file.descriptor, &status) != 0)
        return Error{name + " can not be read: " + fileCause(errno) + "."};
    if (!S_ISREG(status.st_mode)) return Error{name + " can not be read: it is not a file."};
    file.size = static_cast<std::uint64_t>(status.st_size);
    return Result<OpenedFile>(std::move(file));
}

Result<std::vector<std::uint8_t>> readBytes(const OpenedFile& file, std::size_t size, const std::string& name) {
    std::vector<std::uint8_t> bytes(size);
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = read(file.descriptor, bytes.data() + done, std::min<std::size_t>(size - done, 1 << 30));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return Error{name + " can not be read: " + fileCause(errno) + "."};
        if (got == 0) return Error{name + " became shorter while it was read. Try again."};
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

}  // namespace

Result<std::vector<std::uint8_t>> readFile(const std::filesystem::path& file, std::uint64_t maxBytes) {
    const std::string name = file.string();
    const auto opened = openFile(name);
    if (!opened) return opened.error();
    if (opened->size > maxBytes)
        return Error{name + " has " + std::to_string(opened->size) + " bytes; the most that can be read is " +
                     std::to_string(maxBytes) + "."};
    return readBytes(*opened, static_cast<std::size_t>(opened->size), name);
}

Result<std::vector<std::uint8_t>> readFileStart(const std::filesystem::path& file, std::size_t bytes) {
    const std::string name = file.string();
    const auto opened = openFile(name);
    if (!opened) return opened.error();
    return readBytes(*opened, static_cast<std::size_t>(std::min<std::uint64_t>(opened->size, bytes)), name);
}

void sweepOrphans(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path target = linkTarget(std::filesystem::absolute(file, error));
    const std::string name = target.filename().string();
    std::filesystem::directory_iterator entry(target.parent_path(), error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::filesystem::path candidate = entry->path();
        if (!isTemporaryOf(candidate.filename().string(), name)) continue;
        const int descriptor = open(candidate.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
        if (descriptor < 0) continue;
        struct stat held {
        }, named{};
        const bool orphan = fstat(descriptor, &held) == 0 && S_ISREG(held.st_mode) &&
                            flock(descriptor, LOCK_EX | LOCK_NB) == 0 && lstat(candidate.c_str(), &named) == 0 &&
                            named.st_ino == held.st_ino && named.st_dev == held.st_dev;
        if (orphan) unlink(candidate.c_str());
        close(descriptor);
    }
}

}  // namespace whorl
