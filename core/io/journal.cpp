// SPDX-License-Identifier: Apache-2.0
#include "core/io/journal.h"

#include "core/base/hash.h"
#include "core/io/file_steps.h"
#include "core/io/safe_file.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <utility>

// A journal is NAME.journal: magic "WHORLJNL", u32 version, u32 length of the document's path, the path, u64 checksum
// of all that, then the bytes of a document. NAME.lock beside it is locked while a program works with it; saving
// replaces the journal, so the journal itself could not carry the lock.

namespace whorl {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "WHORLJNL";
constexpr std::uint32_t version = 1;
constexpr std::uint32_t maxPath = 64 * 1024;
constexpr std::uint64_t maxJournal = std::uint64_t{16} << 30;
constexpr const char* journalSuffix = ".journal";
constexpr const char* lockSuffix = ".lock";

fs::path lockOf(const fs::path& journal) {
    return fs::path(journal).replace_extension(lockSuffix);
}

/// The locked file, -1 when somebody else holds it or -2 for other faults (errno). Made when it is not there.
int takeLock(const fs::path& lock) {
    const int descriptor = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
    if (descriptor < 0) return -2;
    const bool held = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    struct stat status {};
    // Between open and lock another program may have removed the file as a leftover.
    if (!held && fstat(descriptor, &status) == 0 && status.st_nlink > 0) return descriptor;
    close(descriptor);
    return -1;
}

struct Lock {
    int descriptor;
    explicit Lock(const fs::path& journal) : descriptor(takeLock(lockOf(journal))) {}
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock() {
        if (descriptor >= 0) close(descriptor);
    }
    /// A folder that can not be written to has no locks that anybody holds.
    bool isFree() const { return descriptor != -1; }
};

std::vector<std::uint8_t> header(const fs::path& document) {
    const std::string path = document.string();
    std::vector<std::uint8_t> bytes(magic.begin(), magic.end());
    const auto put = [&](const void* data, std::size_t size) {
        const auto* from = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), from, from + size);
    };
    const auto length = static_cast<std::uint32_t>(path.size());
    put(&version, sizeof version);
    put(&length, sizeof length);
    put(path.data(), path.size());
    const std::uint64_t checksum = hashBytes(bytes.data(), bytes.size());
    put(&checksum, sizeof checksum);
    return bytes;
}

struct Header {
    fs::path document;
    std::size_t bytes = 0;
};

Result<Header> parseHeader(std::span<const std::uint8_t> bytes, const std::string& name) {
    std::uint32_t found = 0, length = 0;
    if (bytes.size() < 24 || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
        return Error{name + " is not a journal of Whorl."};
    std::memcpy(&found, bytes.data() + 8, 4);
    std::memcpy(&length, bytes.data() + 12, 4);
    if (found > version) return Error{name + " was made by a newer Whorl. Open it with that version."};
    if (length > maxPath || bytes.size() < std::size_t{length} + 24)
        return Error{name + " is broken: it is cut short."};
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, bytes.data() + 16 + length, 8);
    if (hashBytes(bytes.data(), std::size_t{length} + 16) != checksum)
        return Error{name + " is broken: the checksum of its beginning is wrong."};
    return Header{fs::path(std::string(reinterpret_cast<const char*>(bytes.data()) + 16, length)),
                  std::size_t{length} + 24};
}

std::string localTime(const fs::path& file) {
    struct stat status {};
    std::tm parts{};
    char text[64] = "";
    if (::stat(file.c_str(), &status) == 0 && localtime_r(&status.st_mtime, &parts))
        std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
    return text;
}

/// Removes locks of journals that were never written or were discarded, if nobody holds them.
void sweepLocks(const fs::path& folder) {
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const fs::path path = entry->path();
        const fs::path journal = fs::path(path).replace_extension(journalSuffix);
        if (path.extension() != lockSuffix || fs::exists(journal)) continue;
        const Lock lock(journal);
        if (lock.descriptor >= 0 && !fs::exists(journal)) unlink(path.c_str());
    }
}

}  // namespace

Result<Journal> Journal::create(const fs::path& folder, const fs::path& document) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return Error{folder.string() + " can not be made: " + fileCause(error.value()) +
                     ". Unsaved work can not be kept there; save often."};
    fs::permissions(folder, fs::perms::owner_all, error);
    sweepLocks(folder);
    Journal journal;
    journal.m_document = document.empty() ? fs::path() : fs::absolute(document, error);
    if (journal.m_document.string().size() > maxPath) return Error{"The path of the document is too long."};
    for (int attempt = 0; attempt < 20; ++attempt) {
        // A fresh random name; an existing journal is never taken over.
        const std::string name = temporaryName("journal");
        journal.m_file = folder / ("groom" + fs::path(name).replace_extension(journalSuffix).string());
        if (fs::exists(journal.m_file)) continue;
        journal.m_lock = takeLock(lockOf(journal.m_file));
        if (journal.m_lock >= 0) return Result<Journal>(std::move(journal));
        if (journal.m_lock == -2) break;
    }
    const int cause = errno;
    journal.m_lock = -1;
    return Error{folder.string() + " can not keep unsaved work: " + fileCause(cause) + ". Save often."};
}

Journal::Journal(Journal&& other) noexcept {
    *this = std::move(other);
}

Journal& Journal::operator=(Journal&& other) noexcept {
    std::swap(m_file, other.m_file);
    std::swap(m_document, other.m_document);
    std::swap(m_lock, other.m_lock);
    return *this;
}

Journal::~Journal() {
    if (m_lock < 0) return;
    std::error_code error;
    if (!fs::exists(m_file, error) && !error) unlink(lockOf(m_file).c_str());
    close(m_lock);
}

Result<void> Journal::write(const Groom& groom, Progress& progress) {
    if (m_lock < 0) return Error{"This journal was discarded."};
    auto bytes = documentBytes(groom, progress);
    if (!bytes) return bytes.error();
    auto safe = SafeFile::create(m_file);
    if (!safe) return safe.error();
    const std::vector<std::uint8_t> start = header(m_document);
    if (auto done = safe->write(start.data(), start.size()); !done) return done;
    if (auto done = safe->write(bytes->data(), bytes->size()); !done) return done;
    if (progress.cancelled()) return cancelledError();
    return safe->commit();
}

void Journal::discard() {
    if (m_lock < 0) return;
    unlink(m_file.c_str());
    unlink(lockOf(m_file).c_str());
    close(m_lock);
    m_lock = -1;
}

std::vector<Recovery> findRecoveries(const fs::path& folder) {
    std::vector<Recovery> found;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const fs::path path = entry->path();
        if (path.extension() != journalSuffix || !entry->is_regular_file(error)) continue;
        if (!Lock(path).isFree()) continue;
        const auto start = readFileStart(path, maxPath + 24);
        const auto head = start ? parseHeader(*start, path.string()) : Result<Header>(start.error());
        // A damaged one is offered as well: opening it tells what is wrong.
        found.push_back({path, head ? head->document : fs::path(), localTime(path)});
    }
    std::sort(found.begin(), found.end(), [](const Recovery& a, const Recovery& b) {
        return a.when != b.when ? a.when > b.when : a.journal < b.journal;
    });
    return found;
}

Result<OpenedDocument> openRecovery(const Recovery& recovery, Progress& progress) {
    const std::string name = recovery.journal.string();
    const auto bytes = readFile(recovery.journal, maxJournal);
    if (!bytes) return bytes.error();
    const auto head = parseHeader(*bytes, name);
    if (!head) return head.error();
    return documentFromBytes(std::span(*bytes).subspan(head->bytes), name, progress);
}

void deleteRecovery(const Recovery& recovery) {
    const Lock lock(recovery.journal);
    if (!lock.isFree()) return;
    sweepOrphans(recovery.journal);
    unlink(recovery.journal.c_str());
    unlink(lockOf(recovery.journal).c_str());
}

fs::path journalFolder() {
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state && *state == '/') return fs::path(state) / "whorl" / "journals";
    const char* home = std::getenv("HOME");
    if (!home || *home != '/') {
        const passwd* user = getpwuid(getuid());
        home = user ? user->pw_dir : "/tmp";
    }
    return fs::path(home) / ".local" / "state" / "whorl" / "journals";
}

}  // namespace whorl
