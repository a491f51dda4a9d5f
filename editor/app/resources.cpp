// SPDX-License-Identifier: Apache-2.0
#include "editor/app/resources.h"

#include "editor/app/document.h"

#include <QCoreApplication>
#include <algorithm>
#include <vector>

namespace whorl {

std::filesystem::path resourceFolder() {
    if (const QString given = qEnvironmentVariable("WHORL_RESOURCES"); !given.isEmpty()) return pathOf(given);
    std::error_code error;
    std::filesystem::path folder = pathOf(QCoreApplication::applicationDirPath());
    const std::filesystem::path installed = folder / ".." / "share" / "whorl";
    if (std::filesystem::is_directory(installed, error)) return installed;
    // In a build tree the program is a few folders below the source.
    for (int level = 0; level < 5 && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
        if (std::filesystem::is_directory(folder / "resources" / "samples", error)) return folder / "resources";
    }
    return {};
}

std::filesystem::path sampleFile() {
    std::error_code error;
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(resourceFolder() / "samples", error)) {
        if (entry.path().extension() == ".whorl") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found.empty() ? std::filesystem::path() : found.front();
}

}  // namespace whorl
