// SPDX-License-Identifier: Apache-2.0
#include "core/io/spill_file.h"

#include "core/io/file_steps.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace whorl {
namespace {

constexpr std::size_t gatherBytes = std::size_t{1} << 18;

Error failed(const std::filesystem::path& target, int error) {
    return {target.string() + " can not be saved: " + fileCause(error) + " while its parts were collected. " +
            fileAdvice(error)};
}

}  // namespace

Result<SpillFile> SpillFile::create(const std::filesystem::path& target) {
    SpillFile spill;
    spill.m_target = target;
    std::filesystem::path folder = target.parent_path();
    if (folder.empty()) folder = ".";
    if (const int fault = fileFault(FileStep::Open)) return failed(target, fault);
    std::string name = (folder / ".whorl-spill-XXXXXX").string();
    spill.m_descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (spill.m_descriptor < 0) return failed(target, errno);
    unlink(name.c_str());
    return Result<SpillFile>(std::move(spill));
}

SpillFile::SpillFile(SpillFile&& other) noexcept {
    *this = std::move(other);
}

SpillFile& SpillFile::operator=(SpillFile&& other) noexcept {
    std::swap(m_target, other.m_target);
    std::swap(m_gathered, other.m_gathered);
    std::swap(m_written, other.m_written);
    std::swap(m_descriptor, other.m_descriptor);
    return *this;
}

SpillFile::~SpillFile() {
    if (m_descriptor >= 0) close(m_descriptor);
}

Result<void> SpillFile::write(const void* data, std::size_t bytes) {
    const auto* from = static_cast<const std::uint8_t*>(data);
    m_gathered.insert(m_gathered.end(), from, from + bytes);
    m_written += bytes;
    return m_gathered.size() >= gatherBytes ? flush() : Result<void>{};
}

Result<void> SpillFile::flush() {
    std::size_t done = 0;
    while (done < m_gathered.size()) {
        if (const int fault = fileFault(FileStep::Write)) return failed(m_target, fault);
        const ssize_t step = ::write(m_descriptor, m_gathered.data() + done, m_gathered.size() - done);
        if (step < 0 && errno == EINTR) continue;
        if (step < 0) return failed(m_target, errno);
        done += static_cast<std::size_t>(step);
    }
    m_gathered.clear();
    return {};
}

Result<void> SpillFile::moveTo(SafeFile& file) {
    if (Result<void> flushed = flush(); !flushed) return flushed;
    std::vector<std::uint8_t> buffer(gatherBytes);
    for (std::uint64_t at = 0; at < m_written;) {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), m_written - at));
        const ssize_t step = pread(m_descriptor, buffer.data(), wanted, static_cast<off_t>(at));
        if (step < 0 && errno == EINTR) continue;
        if (step <= 0) return failed(m_target, step < 0 ? errno : EIO);
        if (Result<void> copied = file.write(buffer.data(), static_cast<std::size_t>(step)); !copied) return copied;
        at += static_cast<std::uint64_t>(step);
    }
    return {};
}

}  // namespace whorl
