// SPDX-License-Identifier: Apache-2.0
// Leaving out metadata: the parsers behind it are slow on some files, and nothing in it changes a texel.
#include "core/io/worker/answer.h"

#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace whorl::image_worker {
namespace {

struct Range {
    std::uint64_t begin = 0, end = 0;
};

bool look(std::uint64_t at, void* to, std::size_t bytes) {
    return ::pread(STDIN_FILENO, to, bytes, static_cast<off_t>(at)) == static_cast<ssize_t>(bytes);
}

// Chunks of text and Exif. Stops at the first chunk that does not fit; libpng then says what is wrong with it.
std::vector<Range> pngMetadata(std::uint64_t size) {
    std::vector<Range> out;
    std::uint8_t head[8];
    for (std::uint64_t at = 8; at + 12 <= size && look(at, head, sizeof head);) {
        const std::uint64_t length = std::uint64_t{head[0]} << 24 | std::uint64_t{head[1]} << 16 |
                                     std::uint64_t{head[2]} << 8 | std::uint64_t{head[3]};
        const std::uint64_t end = at + 12 + length;
        if (end > size) break;
        const std::string_view name(reinterpret_cast<const char*>(head + 4), 4);
        if (name == "tEXt" || name == "zTXt" || name == "iTXt" || name == "eXIf") out.push_back({at, end});
        at = end;
    }
    return out;
}

// APP1 (Exif, XMP) and APP13 (Photoshop, IPTC) before the first scan.
std::vector<Range> jpegMetadata(std::uint64_t size) {
    std::vector<Range> out;
    std::uint8_t head[4];
    for (std::uint64_t at = 2; at + 4 <= size && look(at, head, sizeof head);) {
        constexpr std::uint8_t startOfScan = 0xda, app1 = 0xe1, app13 = 0xed;
        const std::uint64_t length = std::uint64_t{head[2]} << 8 | std::uint64_t{head[3]};
        const std::uint64_t end = at + 2 + length;
        if (head[0] != 0xff || head[1] < 0xc0 || head[1] == startOfScan || length < 2 || end > size) break;
        if (head[1] == app1 || head[1] == app13) out.push_back({at, end});
        at = end;
    }
    return out;
}

bool append(int to, Range range) {
    auto at = static_cast<off_t>(range.begin);
    const auto end = static_cast<off_t>(range.end);
    while (at < end) {
        const ssize_t sent = ::sendfile(to, STDIN_FILENO, &at, static_cast<std::size_t>(end - at));
        if (sent <= 0) return false;
    }
    return true;
}

}  // namespace

bool leaveOutMetadata(const std::string& plugin) {
    struct stat file {};
    if (fstat(STDIN_FILENO, &file) != 0 || !S_ISREG(file.st_mode)) return true;
    const auto size = static_cast<std::uint64_t>(file.st_size);
    std::vector<Range> dropped;
    if (plugin == "png") dropped = pngMetadata(size);
    if (plugin == "jpeg") dropped = jpegMetadata(size);
    if (dropped.empty()) return true;

    const int copy = memfd_create("whorl-image", MFD_CLOEXEC);
    if (copy < 0) return false;
    std::uint64_t from = 0;
    bool ok = true;
    for (const Range& range : dropped) {
        ok = ok && append(copy, {from, range.begin});
        from = range.end;
    }
    ok = ok && append(copy, {from, size}) && lseek(copy, 0, SEEK_SET) == 0 && dup2(copy, STDIN_FILENO) >= 0;
    ::close(copy);
    return ok;
}

}  // namespace whorl::image_worker
