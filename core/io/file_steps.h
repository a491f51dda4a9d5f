// SPDX-License-Identifier: Apache-2.0
// The single steps that safe files and packages are made of, each with its place for a fault in tests.
#pragma once

#include "core/io/safe_file.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace whorl {

/// The errno that a test wants this step to fail with, or 0. Any thread.
int fileFault(FileStep step);

/// "no space left on the device" and so on.
std::string fileCause(int error);
/// What to do about it, one sentence: "Free some space on that disk or save elsewhere."
std::string fileAdvice(int error);

/// Syncs the entries of a folder; 0 or an errno. A folder or file system that can not be synced counts as synced.
int syncFolder(const std::filesystem::path& folder);

/// Where a chain of symbolic links ends; a link that points nowhere yet gives the place where it points. An empty path
/// for a circle of links.
std::filesystem::path linkTarget(const std::filesystem::path& file);

/// A short name for something temporary that belongs to `name`; the same start for the same name, at most 120 bytes
/// however long `name` is.
std::string temporaryStart(const std::string& name);
/// The same with a random end: a fresh name at every call.
std::string temporaryName(const std::string& name);
bool isTemporaryOf(const std::string& candidate, const std::string& name);

}  // namespace whorl
