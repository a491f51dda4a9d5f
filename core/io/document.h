// SPDX-License-Identifier: Apache-2.0
// NAME.whorl: the artist's document.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/model/groom.h"

#include <filesystem>
#include <span>

namespace whorl {

struct OpenedDocument {
    Groom groom;
    Problems problems;  ///< unknown keys, repaired values; one sentence each
};

/// One container: magic "WHORLDOC", version, chunks of zstd-compressed bytes each with a 64-bit checksum, and a JSON
/// manifest. Atomic (SafeFile), read back and compared by digest after writing. The same groom gives the same bytes.
Result<void> saveDocument(const Groom& groom, const std::filesystem::path& file, Progress& progress);

/// Refuses other files, newer versions, broken checksums and sizes that the file can not hold.
Result<OpenedDocument> openDocument(const std::filesystem::path& file, Progress& progress);

/// Container bytes in memory: what saveDocument writes. For journals, tests and fuzzing.
std::vector<std::uint8_t> documentBytes(const Groom& groom);
Result<std::vector<std::uint8_t>> documentBytes(const Groom& groom, Progress& progress);
/// `name` is the file for the sentences.
Result<OpenedDocument> documentFromBytes(std::span<const std::uint8_t> bytes, const std::string& name);
Result<OpenedDocument> documentFromBytes(std::span<const std::uint8_t> bytes, const std::string& name,
                                         Progress& progress);

/// True when the file begins as a document does.
bool isDocument(const std::filesystem::path& file);

}  // namespace whorl
