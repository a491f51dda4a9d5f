// SPDX-License-Identifier: Apache-2.0
#include "core/io/import/raw_mesh.h"
#include "core/io/plain_text.h"
#include "core/io/safe_file.h"

#include <algorithm>
#include <system_error>

namespace whorl::import {

Error meshError(const std::string& name, const std::string& reason, const std::string& advice) {
    return {plainText(name) + ": " + plainText(reason, 400) + "; " + advice + "."};
}

std::string counted(std::uint64_t count, const char* thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string UniqueNames::make(std::string_view wanted, std::string_view otherwise) {
    std::string name = plainText(wanted, 120);
    if (name.find_first_not_of(' ') == std::string::npos) name = otherwise;
    std::string candidate = name;
    auto [entry, isNew] = m_used.try_emplace(name, 2u);
    while (!isNew) {
        candidate = name + " " + std::to_string(entry->second++);
        isNew = m_used.try_emplace(candidate, 2u).second;
    }
    return candidate;
}

Neighbours::Neighbours(const std::filesystem::path& meshFile) {
    std::error_code failure;
    const auto real = std::filesystem::canonical(meshFile, failure);
    if (!failure) m_folder = real.parent_path();
}

Result<std::filesystem::path> Neighbours::find(std::string_view reference) const {
    namespace fs = std::filesystem;
    if (m_folder.empty()) return Error{"files beside a mesh are not read here"};
    if (reference.empty()) return Error{"its name is empty"};
    if (reference.size() > 4096) return Error{"its name is too long"};
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    if (std::any_of(reference.begin(), reference.end(), control)) return Error{"its name has control characters"};
    if (reference.find(':') != reference.npos) return Error{"only files can be used, no addresses"};
    if (reference.front() == '/' || reference.find('\\') != reference.npos) {
        return Error{"only files in the folder of the mesh can be used"};
    }
    std::error_code failure;
    // The links as written, first: the mesh's folder may itself be reached through a link, its contents must not leave
    // it.
    const fs::path real = fs::canonical(m_folder / fs::path(reference), failure);
    const auto inside = std::mismatch(m_folder.begin(), m_folder.end(), real.begin(), real.end());
    if (failure) return Error{"there is no such file in the folder of the mesh"};
    if (inside.first != m_folder.end()) return Error{"it points outside the folder of the mesh"};
    if (!fs::is_regular_file(fs::symlink_status(real, failure))) return Error{"it is no ordinary file"};
    return real;
}

Result<std::vector<std::uint8_t>> Neighbours::read(std::string_view reference, std::uint64_t maxBytes) const {
    const auto file = find(reference);
    if (!file) return file.error();
    auto bytes = readFile(*file, maxBytes);
    if (!bytes) return Error{"it can not be read or is larger than " + std::to_string(maxBytes >> 20) + " MiB"};
    return bytes;
}

}  // namespace whorl::import
