// SPDX-License-Identifier: Apache-2.0
#include "core/io/file_steps.h"

#include "core/base/hash.h"
#include "core/base/random.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <system_error>

namespace whorl {
namespace {

constexpr std::string_view temporarySuffix = ".whorl-tmp";

std::mutex faultMutex;
std::function<int(FileStep)> faultFunction;
std::atomic<bool> faultSet{false};

std::uint64_t freshNumber() {
    std::uint64_t number = 0;
    if (getrandom(&number, sizeof number, GRND_NONBLOCK) == static_cast<ssize_t>(sizeof number)) return number;
    static std::atomic<std::uint64_t> counter{0};
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    return mix64(static_cast<std::uint64_t>(now) ^ (static_cast<std::uint64_t>(getpid()) << 32)) + ++counter;
}

}  // namespace

void setFileFault(std::function<int(FileStep)> fault) {
    const std::lock_guard lock(faultMutex);
    faultFunction = std::move(fault);
    faultSet = static_cast<bool>(faultFunction);
}

int fileFault(FileStep step) {
    if (!faultSet) return 0;
    const std::lock_guard lock(faultMutex);
    return faultFunction ? faultFunction(step) : 0;
}

std::string fileCause(int error) {
    switch (error) {
        case ENOSPC:
            return "no space left on the disk";
        case EDQUOT:
            return "your disk quota is used up";
        case EFBIG:
            return "the size limit for files was reached";
        case EROFS:
            return "the disk is read-only";
        case EACCES:
        case EPERM:
            return "permission denied";
        case ENOENT:
            return "the folder or file does not exist";
        case ENOTDIR:
            return "a part of the path is not a folder";
        case ENAMETOOLONG:
            return "the name is too long for this disk";
        case EIO:
            return "the disk reported a fault";
        case EMFILE:
        case ENFILE:
            return "too many files are open";
        default:
            return std::generic_category().message(error);
    }
}

std::string fileAdvice(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "Free some space there or save elsewhere.";
        case EFBIG:
            return "Raise the limit or save elsewhere.";
        case EROFS:
        case EACCES:
        case EPERM:
            return "Save in a folder that you may write to.";
        case ENOENT:
        case ENOTDIR:
            return "Choose a folder that exists.";
        case ENAMETOOLONG:
            return "Choose a shorter name.";
        case EIO:
            return "Save on another disk.";
        default:
            return "Try again or save elsewhere.";
    }
}

int syncFolder(const std::filesystem::path& folder) {
    if (const int fault = fileFault(FileStep::SyncFolder)) return fault;
    const std::string path = folder.empty() ? "." : folder.string();
    const int descriptor = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return 0;  // a folder that may be written but not read
    int error = 0;
    while (fsync(descriptor) != 0) {
        if (errno == EINTR) continue;
        if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP && errno != EROFS) error = errno;
        break;
    }
    close(descriptor);
    return error;
}

std::filesystem::path linkTarget(const std::filesystem::path& file) {
    std::filesystem::path target = file;
    std::error_code error;
    for (int links = 0; links < 40; ++links) {
        if (!std::filesystem::is_symlink(std::filesystem::symlink_status(target, error))) return target;
        const std::filesystem::path next = std::filesystem::read_symlink(target, error);
        if (error) return target;
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return {};
}

std::string temporaryStart(const std::string& name) {
    std::size_t length = std::min<std::size_t>(name.size(), 64);
    // Never in the middle of a UTF-8 character: some file systems refuse such names.
    while (length > 0 && length < name.size() && (static_cast<unsigned char>(name[length]) & 0xc0) == 0x80) --length;
    return "." + name.substr(0, length) + "." + hexDigest(hashBytes(name.data(), name.size())) + ".";
}

std::string temporaryName(const std::string& name) {
    return temporaryStart(name) + hexDigest(freshNumber()) + std::string(temporarySuffix);
}

bool isTemporaryOf(const std::string& candidate, const std::string& name) {
    const std::string start = temporaryStart(name);
    return candidate.size() == start.size() + 16 + temporarySuffix.size() && candidate.starts_with(start) &&
           candidate.ends_with(temporarySuffix);
}

}  // namespace whorl
