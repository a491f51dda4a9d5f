// SPDX-License-Identifier: Apache-2.0
// Bytes that wait on the disk until the file that they belong to knows where they go.
#pragma once

#include "core/io/safe_file.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace whorl {

/// A nameless file in the folder of `target`: nothing of it is left, however the program ends. Formats that put counts
/// or whole arrays before others collect each array in one, so that hair can be written without being held.
class SpillFile {
public:
    static Result<SpillFile> create(const std::filesystem::path& target);
    SpillFile(SpillFile&& other) noexcept;
    SpillFile& operator=(SpillFile&& other) noexcept;
    ~SpillFile();

    Result<void> write(const void* data, std::size_t bytes);
    std::uint64_t written() const { return m_written; }
    /// Appends all that was written to `file`. Once, at the end.
    Result<void> moveTo(SafeFile& file);

private:
    SpillFile() = default;
    Result<void> flush();

    std::filesystem::path m_target;
    std::vector<std::uint8_t> m_gathered;
    std::uint64_t m_written = 0;
    int m_descriptor = -1;
};

}  // namespace whorl
