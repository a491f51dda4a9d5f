// SPDX-License-Identifier: Apache-2.0
// A groom from any file that can start one.
#pragma once

#include "core/io/document.h"

#include <filesystem>

namespace whorl {

enum class FileKind { Document, Package, Mesh, HairCurves, Unknown };
FileKind fileKind(const std::filesystem::path& file);

/// Opens a document, a package or a mesh (a new groom on it).
Result<OpenedDocument> openGroom(const std::filesystem::path& file, Progress& progress);

}  // namespace whorl
