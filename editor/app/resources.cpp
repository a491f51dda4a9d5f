// SPDX-License-Identifier: Apache-2.0
#include "editor/app/resources.h"

#include "editor/app/document.h"

#include <QCoreApplication>
#include <algorithm>

namespace whorl {

std::vector<std::filesystem::path> sampleFiles() {
    const std::filesystem::path program = pathOf(QCoreApplication::applicationDirPath());
    std::vector<std::filesystem::path> found;
    for (const auto& folder : {program / ".." / "share" / "whorl" / "samples", program / ".." / "samples"}) {
        std::error_code error;
        for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            if (entry->path().extension() == ".whorl") found.push_back(entry->path().lexically_normal());
        }
        if (!found.empty()) break;
    }
    std::sort(found.begin(), found.end());
    return found;
}

QString sampleName(const std::filesystem::path& file) {
    QString name = textOf(file.stem()).replace('_', ' ');
    if (!name.isEmpty()) name[0] = name[0].toUpper();
    return name;
}

}  // namespace whorl
