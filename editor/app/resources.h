// SPDX-License-Identifier: Apache-2.0
// Where the program's own files are.
#pragma once

#include <QString>
#include <filesystem>
#include <vector>

namespace whorl {

/// The sample grooms that came with the program, by name: beside an installed program, or in its build tree.
std::vector<std::filesystem::path> sampleFiles();
/// "Long coat" for ".../long_coat.whorl".
QString sampleName(const std::filesystem::path& file);

}  // namespace whorl
