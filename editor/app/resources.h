// SPDX-License-Identifier: Apache-2.0
// Where the program's own files are.
#pragma once

#include <filesystem>

namespace whorl {

/// The folder "resources": $WHORL_RESOURCES, the installed one beside the program, or that of the source tree that the
/// program was built in. Empty when there is none.
std::filesystem::path resourceFolder();
/// The sample groom that a newcomer sees first, or empty.
std::filesystem::path sampleFile();

}  // namespace whorl
